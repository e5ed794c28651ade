#!/usr/bin/env python3
"""Runs the reference decoder of format-spec on all conformance streams, and holds it against the text it was written from.

    python3 reference_test.py PROJECT [TEST...]
"""
import concurrent.futures
import os
import re
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
PROJECT = os.path.abspath(sys.argv[1]) if __name__ == "__main__" else os.environ["TVG_PROJECT"]
os.environ["TVG_PROJECT"] = PROJECT  # for the processes of a pool
sys.path.insert(0, os.path.join(PROJECT, "format-spec", "reference"))

import negative_base  # noqa: E402
import negative_streams  # noqa: E402
import random_streams  # noqa: E402
import tvg_reference as reference  # noqa: E402

STREAMS = os.path.join(PROJECT, "corpus", "conformance")

def stored(*names):
    with open(os.path.join(STREAMS, *names), "rb") as file:
        return file.read()

def lines(*names):
    """The lines of a list that are no comment, by their first word."""
    text = stored(*names).decode("utf-8").splitlines()
    return dict(line.split(" ", 1) for line in text if line and not line.startswith("#"))

def facts(path, lod=0):
    """What the reference says of the stream in a file, drawn as this lod."""
    try:
        return reference.decode(path, lod).facts()
    except reference.Invalid as error:
        return str(error)

def verdict(data):
    try:
        reference.Decoder(data).decode()
        return "valid"
    except reference.Invalid as error:
        return str(error).split(":")[0]

def table_of_the_text():
    """§3.4: for each state its cells, and the heads of the columns."""
    with open(os.path.join(PROJECT, "format-spec", "tvg.md"), encoding="utf-8") as file:
        section = file.read().split("### 3.4 ")[1].split("\n### ")[0]
    rows = [[cell.strip(" ").strip("`") for cell in line.strip("|").split("|")]
            for line in section.splitlines() if line.startswith("|") and not line.startswith("|--")]
    return {row[0]: tuple(row[1:]) for row in rows[1:]}, rows[0][1:]

class TheReference(unittest.TestCase):
    maxDiff = None

    def test_gives_the_digests_of_every_valid_stream(self):
        with concurrent.futures.ProcessPoolExecutor() as pool:
            for folder in ("", "random"):
                listed = lines(folder, "digests.txt")
                paths = {name: os.path.join(STREAMS, folder, name + ".tvg") for name in listed}
                found = dict(zip(listed, pool.map(facts, paths.values())))
                self.assertEqual(found, listed)
                files = {name[:-4] for name in os.listdir(os.path.join(STREAMS, folder)) if name.endswith(".tvg")}
                self.assertEqual(files, set(listed))

    def test_gives_the_digests_of_every_lod(self):
        with concurrent.futures.ProcessPoolExecutor() as pool:
            for folder in ("", "random"):
                listed = lines(folder, "lods.txt")
                names, lods = zip(*(name.split("@") for name in listed))
                paths = [os.path.join(STREAMS, folder, name + ".tvg") for name in names]
                self.assertEqual(dict(zip(listed, pool.map(facts, paths, map(int, lods)))), listed)

    def test_names_what_is_wrong_with_every_negative_stream(self):
        listed = lines("negative", "negative.txt")
        self.assertGreater(len(listed), 200)
        for name, expected in listed.items():
            error, section, _ = expected.split()
            self.assertEqual(verdict(stored("negative", name + ".tvg")), f"{error} {section}", name)

    def test_has_the_order_of_the_text(self):
        rows, columns = table_of_the_text()
        self.assertEqual(rows, reference.ORDER)
        self.assertEqual(columns, [c.decode() if isinstance(c, bytes) else c for c in reference.COLUMNS])

    def test_finds_every_section_it_names_in_the_text(self):
        with open(os.path.join(PROJECT, "format-spec", "tvg.md"), encoding="utf-8") as file:
            sections = set(re.findall(r"^#+ ([0-9.]*[0-9])\.? ", file.read(), re.MULTILINE))
        for name, expected in lines("negative", "negative.txt").items():
            self.assertIn(expected.split()[1].lstrip("§"), sections, name)

class TheOrderOfChunks(unittest.TestCase):
    def test_is_broken_by_a_negative_stream_for_each_cell_that_forbids(self):
        listed = lines("negative", "negative.txt")
        for state, cells in reference.ORDER.items():
            for column, cell in zip(reference.COLUMNS, cells):
                name = {b"GOP ": "gop", "no more bytes": "end"}.get(column)
                name = name or (column.decode().lower() if isinstance(column, bytes) else column)
                if cell not in reference.ORDER and cell != "complete":
                    self.assertEqual(listed[f"{state}_{name}"].split()[0], cell.replace(" ", "-"), (state, name))

    def test_allows_what_the_table_allows(self):
        for place, names in {"META": ("meta", "data", "ancillary"), "TAIL": ("ancillary",),
                             "GOP1": ("meta", "data", "ancillary")}.items():
            for name in names:
                data = negative_base.stream(before=(place, negative_base.extra(name)))
                self.assertEqual(verdict(data), "valid", (place, name))
        for kind, payload in ((b"MESH", negative_base.MESH), (b"MESH", negative_base.OTHER_MESH),
                              (b"PLAN", negative_base.PLAN)):
            data = negative_base.stream(before=("GOP1", negative_base.put_named(kind, payload)),
                                        **(negative_base.PLANES_HEAD if kind == b"PLAN" else {}))
            self.assertEqual(verdict(data), "valid", kind)
        for order in (("HEAD", "INDX", "TAIL"), ("HEAD", "MESH", "INDX", "TAIL")):
            self.assertEqual(verdict(negative_base.stream(order)), "valid", order)

class TheWriters(unittest.TestCase):
    def test_still_make_the_stored_negative_streams(self):
        with tempfile.TemporaryDirectory() as folder:
            negative_streams.main([folder])
            self.assertEqual(set(os.listdir(folder)), set(os.listdir(os.path.join(STREAMS, "negative"))))
            for name in os.listdir(folder):
                with open(os.path.join(folder, name), "rb") as file:
                    self.assertEqual(file.read(), stored("negative", name), name)

    def test_still_make_the_stored_random_streams(self):
        for name in lines("random", "digests.txt"):
            data = random_streams.RandomStream(int(name.split("_")[1])).write()
            self.assertEqual(data, stored("random", name + ".tvg"), name)

    def test_make_valid_streams_of_any_seed(self):
        for seed in (*range(1000, 1040), *range(2000, 2020), *range(3000, 3020), *range(4000, 4020), *range(5000, 5020)):
            self.assertEqual(verdict(random_streams.RandomStream(seed).write()), "valid", seed)

if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]] + sys.argv[2:])
