#!/usr/bin/env python3
"""What size buys which precision: the paper's Table 1, and rate-distortion curves with their plot.

    python3 rate_distortion.py sequences/ --plot curves.svg              # Table 1 of its chicken, curves of all it has
    python3 rate_distortion.py chicken.obj chicken.pc2 --table1          # 50 frames in one group, as the paper has it
    python3 rate_distortion.py crane.obj crane.pc2 --bits 7..13 --plot crane.svg

A folder has sequences as NAME.obj with NAME.pc2 (or NAME.npy). Without one it is $TVG_DATA_DIR or, where that is not
set, what tvg_corpus makes: the project's own sequences. Positions come from a PC2 cache or a NumPy array [frame,
vertex, 3]; faces from an OBJ file. The plot needs matplotlib.
"""
import argparse
import os
import pathlib
import shutil
import struct
import subprocess
import tempfile
from typing import Dict, List, Tuple

import numpy as np

import tvg

# Bits, the paper's file in KB, and shares of important vertices: the paper does not say which it marked. 15 % fits its
# file sizes best, 35 % is our default.
TABLE_1 = [
    ("13", 182.0, [None]),
    ("13:11", 154.8, [0.15, 0.35]),
    ("11", 140.6, [None]),
    ("11:9", 121.1, [0.15, 0.35]),
    ("9", 109.3, [None]),
    ("9:7", 91.1, [0.15, 0.35]),
    ("7", 76.7, [None]),
]
TABLE_1_FRAMES = 50
Rows = Dict[str, List[Dict[str, float]]]


def read_obj(path: str) -> Tuple[np.ndarray, np.ndarray]:
    """Vertices float32 [vertex, 3] and triangles [face, 3] of an OBJ file; polygons become fans."""
    vertices: List[List[float]] = []
    faces: List[List[int]] = []
    with open(path, encoding="utf-8", errors="replace") as file:
        for line in file:
            word, *rest = line.split() or [""]
            if word == "v":
                vertices.append([float(number) for number in rest[:3]])
            elif word == "f":
                corners = [int(corner.split("/")[0]) for corner in rest]
                corners = [corner - 1 if corner > 0 else len(vertices) + corner for corner in corners]
                faces += [[corners[0], corners[i], corners[i + 1]] for i in range(1, len(corners) - 1)]
    return np.array(vertices, np.float32), np.array(faces, np.int64).reshape(-1, 3)


def read_pc2(path: str) -> np.ndarray:
    """All frames of a PC2 cache, float32 [frame, vertex, 3]; they stay in the file until they are looked at."""
    with open(path, "rb") as file:
        signature, _, points, _, _, samples = struct.unpack("<12siiffi", file.read(32))
    if signature != b"POINTCACHE2\0":
        raise SystemExit(f"{path} is no PC2 cache")
    return np.memmap(path, dtype="<f4", mode="r", offset=32, shape=(samples, points, 3))


def row(positions: np.ndarray, faces: np.ndarray, **options: object) -> Dict[str, float]:
    """Size and error of a sequence on a lattice: bits per coordinate of the whole stream, and all metrics."""
    stream = tvg.encode(positions, faces, **options)
    errors = tvg.compare(positions, tvg.open(stream), faces)
    return {"bytes": len(stream), "bpc": 8 * len(stream) / positions.size, **vars(errors)}


def table_1(positions: np.ndarray, faces: np.ndarray, beside_paper: bool) -> None:
    """Prints the rows of Table 1, beside the paper's files where these are the paper's frames (KB of 1000 bytes)."""
    positions = positions[:TABLE_1_FRAMES]
    paper = " paper, KB | KB | ratio |" if beside_paper else " KB |"
    print(f"| bits | important |{paper} bits per coordinate | SNR, dB | KG, % |")
    print("|---" * (8 if beside_paper else 6) + "|")
    for bits, kilobytes, shares in TABLE_1:
        for share in shares:
            options = {} if share is None else {"importance": share}
            made = row(positions, faces, bits=bits, gop=len(positions), **options)
            size = made["bytes"] / 1000
            marked = "" if share is None else f"{100 * share:.0f} %"
            sizes = f"{kilobytes} | {size:.1f} | {size / kilobytes:.2f}" if beside_paper else f"{size:.1f}"
            print(
                f"| {bits} | {marked} | {sizes} | {made['bpc']:.3f} | {made['snr_db']:.1f} "
                f"| {made['kg_percent']:.4f} |",
                flush=True,
            )


def curves(positions: np.ndarray, faces: np.ndarray, bits: range) -> Rows:
    """Sizes and errors of both modes at so many bits, which are printed too."""
    print("| mode | bits | bytes | bits per coordinate | RMS, % of the diagonal | KG, % |\n|---|---|---|---|---|---|")
    found: Rows = {"elp": [], "basis": []}
    for mode, rows in found.items():
        for number in bits:
            made = row(positions, faces, bits=number, mode=mode)
            made["rms_percent"] = 100 * made["rms_coordinate_error"] / made["diagonal"]
            rows.append(made)
            print(
                f"| {mode} | {number} | {made['bytes']} | {made['bpc']:.3f} | {made['rms_percent']:.5f} "
                f"| {made['kg_percent']:.4f} |",
                flush=True,
            )
    return found


def plot(found: Dict[str, Rows], path: str) -> None:
    """Draws the curves of all sequences, one below the other."""
    try:
        import matplotlib

        matplotlib.use("Agg")
        from matplotlib import pyplot
    except ImportError:
        print(f"{path} is not drawn: matplotlib is not installed (Debian: python3-matplotlib)")
        return
    figure, places = pyplot.subplots(
        len(found), figsize=(6, 4 * len(found)), layout="constrained", squeeze=False
    )
    for axes, (name, modes) in zip(places[:, 0], found.items()):
        for mode, rows in modes.items():
            axes.plot(
                [made["bpc"] for made in rows],
                [made["kg_percent"] for made in rows],
                "o-",
                label=f"mode {mode}",
            )
        axes.set(title=name, xlabel="bits per coordinate", ylabel="KG error, %", yscale="log")
        axes.grid(alpha=0.3)
        axes.legend()
    figure.savefig(path)
    print(f"{path}: the plot")


def bit_range(text: str) -> range:
    least, _, most = text.replace("..", "-").partition("-")
    try:
        return range(int(least), int(most or least) + 1)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text}: write a range as 7..13, or one number") from None


def sequences_in(folder: pathlib.Path) -> Dict[str, Tuple[str, str]]:
    """Mesh and positions of every sequence in a folder, by name."""
    found = {}
    for mesh in sorted(folder.glob("*.obj")):
        for cache in (mesh.with_suffix(".pc2"), mesh.with_suffix(".npy")):
            if cache.exists():
                found.setdefault(mesh.stem, (str(mesh), str(cache)))
    return found


def make_corpus(folder: str) -> None:
    """Lets tvg_corpus write two of the project's own sequences."""
    built = pathlib.Path(__file__).resolve().parents[2] / "build" / "release" / "corpus" / "tvg_corpus"
    program = os.environ.get("TVG_CORPUS") or shutil.which("tvg_corpus") or str(built)
    if not os.path.exists(program):
        raise SystemExit(
            "name a folder of sequences, or build tvg_corpus (make build), which makes the project's own; "
            "TVG_CORPUS may say where it is"
        )
    for name in ("cloth", "hand"):
        subprocess.run([program, name, "--size", "small", "-o", folder], check=True, stdout=subprocess.DEVNULL)


def read_sequence(mesh: str, positions: str) -> Tuple[np.ndarray, np.ndarray]:
    """Positions [frame, vertex, 3] and faces [face, 3] of two files."""
    read = np.load(positions, mmap_mode="r") if positions.endswith(".npy") else read_pc2(positions)
    return read, read_obj(mesh)[1]


def report(sequences: Dict[str, Tuple[str, str]], arguments: argparse.Namespace) -> None:
    """Prints Table 1 where it is asked for or a whole folder is, then curves of all."""
    if arguments.table1 or len(sequences) > 1:
        name = "chicken" if "chicken" in sequences else next(iter(sequences))
        positions, faces = read_sequence(*sequences[name])
        frames = min(TABLE_1_FRAMES, len(positions))
        print(f"Table 1: {name}, first {frames} frames, predictor elp\n")
        table_1(positions[: arguments.frames], faces, beside_paper=name == "chicken")
    if arguments.table1:
        return
    found = {}
    for name, files in sequences.items():
        positions, faces = read_sequence(*files)
        print(f"\n{name}: {positions.shape[1]} vertices, {len(positions[: arguments.frames])} frames\n")
        found[name] = curves(positions[: arguments.frames], faces, arguments.bits)
    if arguments.plot:
        plot(found, arguments.plot)


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument(
        "input", nargs="*", help="a folder of sequences; or an OBJ file and its positions (PC2, npy)"
    )
    parser.add_argument("--table1", action="store_true", help="the paper's table alone")
    parser.add_argument("--bits", type=bit_range, default=range(7, 14), help="of the curves: 7..13")
    parser.add_argument("--frames", type=int, help="the first so many frames alone")
    parser.add_argument("--plot", metavar="FILE.svg", help="draw the curves")
    arguments = parser.parse_args()
    inputs = arguments.input or [folder for folder in [os.environ.get("TVG_DATA_DIR", "")] if folder]
    with tempfile.TemporaryDirectory() as made:
        if not inputs:
            print("There is no folder of sequences: the project's own are used instead.\n")
            make_corpus(made)
            inputs = [made]
        if len(inputs) == 2:
            sequences = {pathlib.Path(inputs[0]).stem: (inputs[0], inputs[1])}
        elif len(inputs) == 1 and os.path.isdir(inputs[0]):
            sequences = sequences_in(pathlib.Path(inputs[0]))
        else:
            parser.error("name a folder of sequences, or an OBJ file and its positions")
        if not sequences:
            parser.error(f"{inputs[0]}: no NAME.obj with NAME.pc2 or NAME.npy beside it")
        report(sequences, arguments)


if __name__ == "__main__":
    main()
