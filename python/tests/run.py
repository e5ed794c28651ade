#!/usr/bin/env python3
"""run.py TEST...: runs test_TEST.py of this folder; exit status 77 where numpy is missing, as ctest wants it.

The package is taken from ../src and its library from TVG_LIBRARY; TVG_TOOL names a tvg to compare with.
"""
import importlib.util
import os
import pathlib
import sys
import unittest

HERE = pathlib.Path(__file__).resolve().parent
# Debian's numpy belongs to Debian's interpreter, which another may stand before.
DEBIAN = "/usr/bin/python3"


def main():
    if importlib.util.find_spec("numpy") is None:
        if os.path.exists(DEBIAN) and not os.environ.get("TVG_PYTHON_TRIED"):
            os.environ["TVG_PYTHON_TRIED"] = "1"
            os.execv(DEBIAN, [DEBIAN, *sys.argv])
        print(f"SKIPPED: {sys.executable} has no numpy (Debian: python3-numpy)")
        return 77
    sys.dont_write_bytecode = True
    os.environ["PYTHONDONTWRITEBYTECODE"] = "1"
    os.environ["PYTHONPATH"] = str(HERE.parent / "src")  # of the programs that tests run, too
    sys.path[:0] = [str(HERE.parent / "src"), str(HERE)]
    suite = unittest.defaultTestLoader.loadTestsFromNames([f"test_{name}" for name in sys.argv[1:]])
    return 0 if unittest.TextTestRunner(verbosity=1).run(suite).wasSuccessful() else 1


if __name__ == "__main__":
    sys.exit(main())
