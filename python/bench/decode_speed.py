#!/usr/bin/env python3
"""How fast Python decodes beside C, in one run: the same stream in memory, the same library, every frame copied out.

    TVG_LIBRARY=build/release/libcodec/libtvg.so python3 python/bench/decode_speed.py crane.obj crane.pc2 [RUNS]

Needs a C compiler. Prints frames per second of decode_speed.c and of three ways in Python, and their ratios.
"""
import os
import pathlib
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent / "src"), str(HERE.parent / "examples")]

import rate_distortion  # noqa: E402
import tvg  # noqa: E402


def compiled(folder: str) -> str:
    """The program in C, linked against the library that Python uses."""
    library = pathlib.Path(os.environ["TVG_LIBRARY"]).resolve()
    program = os.path.join(folder, "decode_speed")
    include = HERE.parent.parent / "libcodec" / "include"
    command = ["cc", "-O2", "-std=c99", f"-I{include}", str(HERE / "decode_speed.c"), "-o", program]
    subprocess.run(command + [str(library), f"-Wl,-rpath,{library.parent}"], check=True)
    return program


def by_frame(stream: bytes) -> int:
    return sum(1 for _ in tvg.open(stream))


def by_frame_reused(stream: bytes) -> int:
    return sum(1 for _ in tvg.open(stream).frames(copy=False))


def at_once(stream: bytes) -> int:
    return len(tvg.open(stream).positions())


def seconds(way, stream: bytes) -> float:
    begin = time.process_time()
    way(stream)
    return time.process_time() - begin


def main() -> None:
    mesh, cache = sys.argv[1:3]
    runs = int(sys.argv[3]) if len(sys.argv) > 3 else 7
    faces, positions = rate_distortion.read_obj(mesh)[1], rate_distortion.read_pc2(cache)
    ways = [by_frame, by_frame_reused, at_once]
    for mode, options in (("elp", {"bits": 11}), ("basis", {"bits": 11, "mode": "basis"})):
        stream = tvg.encode(positions, faces, **options)
        with tempfile.TemporaryDirectory() as folder:
            program, path = compiled(folder), os.path.join(folder, "clip.tvg")
            pathlib.Path(path).write_bytes(stream)
            in_c, in_python = float("inf"), [float("inf")] * len(ways)
            for _ in range(runs):  # in turn, so that what else the machine does is the same to all
                output = subprocess.run([program, path, "3"], check=True, capture_output=True, text=True)
                in_c = min(in_c, float(output.stdout.split()[1]))
                in_python = [min(best, seconds(way, stream)) for best, way in zip(in_python, ways)]
        count = len(positions)
        print(f"{mode}: C {count / in_c:.0f} frames/s")
        for way, taken in zip(ways, in_python):
            print(f"  {way.__name__:16} {count / taken:7.0f} frames/s, {in_c / taken:.2f} of C")


if __name__ == "__main__":
    main()
