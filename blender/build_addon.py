#!/usr/bin/env python3
"""build_addon.py LIBRARY ZIP: packs the add-on with the Python package and the shared library, ready to be installed in
Blender's preferences."""
import sys
import zipfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
PACKAGE = HERE.parent / "python" / "src" / "tvg"


def main(library: Path, output: Path) -> None:
    partial = output.with_suffix(".partial")
    with zipfile.ZipFile(partial, "w", zipfile.ZIP_DEFLATED) as archive:
        for path in sorted((HERE / "tvg_blender").iterdir()):
            if path.is_file():
                archive.write(path, f"tvg_blender/{path.name}")
        for path in sorted(PACKAGE.iterdir()):
            if path.suffix in (".py", ".typed"):
                archive.write(path, f"tvg_blender/vendor/tvg/{path.name}")
        # Where the package looks first, whatever version stands in the file's own name.
        name = "libtvg.so" if ".so" in library.name else library.name
        archive.write(library.resolve(), f"tvg_blender/vendor/tvg/{name}")
        archive.write(HERE.parent / "LICENSE", "tvg_blender/LICENSE")
    partial.replace(output)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(Path(sys.argv[1]), Path(sys.argv[2]))
