#!/usr/bin/env python3
"""Streams that break one rule of format-spec/tvg.md each, with every checksum right that is not the rule's own.

    python3 negative_streams.py FOLDER

writes them to FOLDER/NAME.tvg, and FOLDER/negative.txt: for each its name, the error (§8.4) that a decoder names
first, the section that is broken, and how many frames are neither withheld nor reported lost (§8.3). The stream that
they are made from has 6 frames. The streams of the table of §3.4 are named after the state and the chunk.
"""
import os
import sys

import negative_animated
import negative_basis
import negative_chunks
import negative_gops
import negative_levels
import negative_lossless
import negative_properties
import negative_pyramid

def cases():
    """Name, error, section, frames and bytes of each stream."""
    yield from negative_chunks.cases()
    yield from negative_gops.cases()
    yield from negative_pyramid.cases()
    yield from negative_lossless.cases()
    yield from negative_basis.cases()
    yield from negative_levels.cases()
    yield from negative_properties.cases()
    yield from negative_animated.cases()

def main(arguments):
    if len(arguments) != 1:
        print("usage: negative_streams.py FOLDER", file=sys.stderr)
        return 2
    lines = ["# stream error section frames"]
    for name, error, section, frames, data in cases():
        lines.append(f"{name} {error.replace(' ', '-')} §{section} {frames}")
        with open(os.path.join(arguments[0], name + ".tvg"), "wb") as file:
            file.write(data)
    with open(os.path.join(arguments[0], "negative.txt"), "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")
    return 0

if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
