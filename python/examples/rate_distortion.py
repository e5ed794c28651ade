#!/usr/bin/env python3
"""What size buys which precision: the rows of the paper's Table 1, and a rate-distortion plot.

    python3 rate_distortion.py chicken.obj chicken.pc2 --table1             # 50 frames in one group, as the paper has it
    python3 rate_distortion.py crane.obj crane.pc2 --bits 7-13 --plot crane.svg

Positions come from a PC2 cache or a NumPy array [frame, vertex, 3]; faces from an OBJ file. The plot needs matplotlib.
"""
import argparse
import struct
from typing import Dict, List, Tuple

import numpy as np

import tvg

TABLE_1 = [("13", None), ("13:11", 0.15), ("13:11", 0.35), ("11", None), ("11:9", 0.15)]
TABLE_1 += [("11:9", 0.35), ("9", None), ("9:7", 0.15), ("9:7", 0.35), ("7", None)]


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


def table_1(positions: np.ndarray, faces: np.ndarray) -> None:
    print("| bits | important | KB | bits per coordinate | SNR, dB | KG, % |\n|---|---|---|---|---|---|")
    for bits, share in TABLE_1:
        options = {} if share is None else {"importance": share}
        made = row(positions, faces, bits=bits, gop=len(positions), **options)
        marked = "" if share is None else f"{share:.0%}".replace("%", " %")
        print(
            f"| {bits} | {marked} | {made['bytes'] / 1000:.1f} | {made['bpc']:.3f} | {made['snr_db']:.1f} "
            f"| {made['kg_percent']:.4f} |"
        )


def curves(positions: np.ndarray, faces: np.ndarray, bits: range) -> Dict[str, List[Dict[str, float]]]:
    print(
        "| mode | bits | bytes | bits per coordinate | RMS, % of the diagonal | KG, % |\n|---|---|---|---|---|---|"
    )
    found: Dict[str, List[Dict[str, float]]] = {"elp": [], "basis": []}
    for mode, rows in found.items():
        for number in bits:
            made = row(positions, faces, bits=number, mode=mode)
            made["rms_percent"] = 100 * made["rms_vertex_distance"] / made["diagonal"]
            rows.append(made)
            print(
                f"| {mode} | {number} | {made['bytes']} | {made['bpc']:.3f} | {made['rms_percent']:.5f} "
                f"| {made['kg_percent']:.4f} |",
                flush=True,
            )
    return found


def plot(found: Dict[str, List[Dict[str, float]]], path: str) -> None:
    try:
        import matplotlib

        matplotlib.use("Agg")
        from matplotlib import pyplot
    except ImportError:
        print(f"{path} is not drawn: matplotlib is not installed (Debian: python3-matplotlib)")
        return
    figure, axes = pyplot.subplots(figsize=(6, 4), layout="constrained")
    for mode, rows in found.items():
        axes.plot(
            [made["bpc"] for made in rows], [made["kg_percent"] for made in rows], "o-", label=f"mode {mode}"
        )
    axes.set(xlabel="bits per coordinate", ylabel="KG error, %", yscale="log")
    axes.grid(alpha=0.3)
    axes.legend()
    figure.savefig(path)
    print(f"{path}: the plot")


def bit_range(text: str) -> range:
    least, _, most = text.partition("-")
    return range(int(least), int(most or least) + 1)


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("mesh", help="an OBJ file: the faces")
    parser.add_argument("positions", help="a PC2 cache, or .npy with [frame, vertex, 3]")
    parser.add_argument(
        "--table1", action="store_true", help="the paper's rows, over the first 50 frames in one group"
    )
    parser.add_argument("--bits", type=bit_range, default=range(7, 14), help="of the curves: 7-13")
    parser.add_argument("--frames", type=int, help="the first so many frames alone")
    parser.add_argument("--plot", metavar="FILE.svg", help="draw the curves")
    arguments = parser.parse_args()
    faces = read_obj(arguments.mesh)[1]
    name = arguments.positions
    positions = np.load(name, mmap_mode="r") if name.endswith(".npy") else read_pc2(name)
    positions = positions[: arguments.frames or (50 if arguments.table1 else None)]
    if arguments.table1:
        table_1(positions, faces)
        return
    found = curves(positions, faces, arguments.bits)
    if arguments.plot:
        plot(found, arguments.plot)


if __name__ == "__main__":
    main()
