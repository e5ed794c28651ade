#!/usr/bin/env python3
"""An animated mesh of Blender's goes out in its formats, through `tvg encode` and `tvg decode`, and back into
Blender, which has to see what it saw before: positions within half a step, the rest the same.

    round_trips.py TVG cache|obj|ply|gltf

Ends with status 77 (skipped) where there is no Blender. Where Node.js finds gltf-validator (NODE_PATH), our .glb has
to pass it.
"""

import glob
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile

FRAMES = 12
RATE = "25"
BITS = 13
UV_BITS = 12
SKIPPED = 77
HERE = os.path.dirname(os.path.abspath(__file__))

VALIDATE = """
const validator = require('gltf-validator'), fs = require('fs');
validator.validateBytes(new Uint8Array(fs.readFileSync(process.argv[1]))).then(report => {
  for (const m of report.issues.messages) if (m.severity < 2) console.log(m.code, m.message, m.pointer);
  process.exit(report.issues.numErrors + report.issues.numWarnings > 0 ? 1 : 0);
});
"""


def run(command, environment=None):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=environment)
    if "skipped: " in done.stdout:
        print(done.stdout[done.stdout.index("skipped: ") :].splitlines()[0])
        sys.exit(SKIPPED)
    if done.returncode != 0:
        sys.exit("%s\n%s\nended with status %d" % (" ".join(command), done.stdout[-4000:], done.returncode))
    return done.stdout


def blender(*arguments):
    # Blender takes the modules of the first Python in PATH, which has to be the one of the system that it is from.
    folder = os.path.dirname(shutil.which("blender"))
    environment = dict(os.environ, PATH=folder + os.pathsep + os.environ["PATH"])
    run(
        ["blender", "-b", "--factory-startup", "--python-exit-code", "1", "--python"]
        + [os.path.join(HERE, "in_blender.py"), "--"]
        + [str(argument) for argument in arguments],
        environment,
    )


def look(kind, files, out):
    blender("look", kind, FRAMES, *files, out)
    with open(out) as file:
        return json.load(file)


class Places:
    """Vertices by where they are: those at one place, which files split along seams, are one."""

    def __init__(self, positions, tolerance):
        self.tolerance = tolerance
        self.positions = positions
        self.cells = {}
        for i, position in enumerate(positions):
            self.cells.setdefault(self.cell(position), []).append(i)

    def cell(self, position):
        return tuple(int(x // (4 * self.tolerance)) for x in position)

    def nearest(self, position):
        """The first vertex within the tolerance along each axis."""
        around = self.cell(position)
        found = [
            i
            for x in (-1, 0, 1)
            for y in (-1, 0, 1)
            for z in (-1, 0, 1)
            for i in self.cells.get((around[0] + x, around[1] + y, around[2] + z), [])
            if all(abs(a - b) <= self.tolerance for a, b in zip(position, self.positions[i]))
        ]
        if not found:
            sys.exit("no vertex of the original is within %g of %s" % (self.tolerance, position))
        return min(found)


def extent(frames):
    return max(
        max(p[axis] for frame in frames for p in frame) - min(p[axis] for frame in frames for p in frame)
        for axis in range(3)
    )


def by_corners(seen, place_of):
    """Faces by their vertices, each beginning with its first one, so that turned faces are the same."""
    faces = {}
    for face in seen["faces"]:
        vertices = [place_of[vertex] for vertex in face["vertices"]]
        first = vertices.index(min(vertices))
        turned = lambda values: values and values[first:] + values[:first]
        faces[tuple(turned(vertices))] = {
            "uv": turned(face["uv"]),
            "colours": turned(face["colours"]),
            "material": face["material"],
        }
    return faces


def expect_close(what, original, back, tolerance):
    if (original is None) != (back is None):
        sys.exit("%s: %s before, %s after" % (what, original, back))
    if original is None:
        return 0
    worst = max(abs(x - y) for a, b in zip(original, back) for x, y in zip(a, b))
    if worst > tolerance:
        sys.exit("%s are %g off, more than %g" % (what, worst, tolerance))
    return worst


def compare(original, back):
    # Float32 has about seven digits, and Blender reckons with them.
    float_error = 4e-6 * max(abs(x) for frame in original["frames"] for p in frame for x in p)
    tolerance = extent(original["frames"]) / 2**BITS / 2 + float_error
    places = Places(original["frames"][0], tolerance)
    of_original = [places.nearest(position) for position in original["frames"][0]]
    of_back = [places.nearest(position) for position in back["frames"][0]]
    if set(of_original) != set(of_back):
        sys.exit("%d places before, %d after" % (len(set(of_original)), len(set(of_back))))
    worst = 0
    for before, after in zip(original["frames"], back["frames"]):
        worst = max(worst, expect_close("positions", [before[i] for i in of_back], after, tolerance))
    before, after = by_corners(original, of_original), by_corners(back, of_back)
    if before.keys() != after.keys():
        sys.exit(
            "%d faces before, %d after, %d of them the same"
            % (len(before), len(after), len(before.keys() & after.keys()))
        )
    uv = colours = 0
    for corners, face in before.items():
        uv = max(uv, expect_close("texture coordinates", face["uv"], after[corners]["uv"], 0.5 / (2**UV_BITS - 1) + 1e-6))
        colours = max(colours, expect_close("colours", face["colours"], after[corners]["colours"], 0.75 / 255))
        if face["material"] != after[corners]["material"]:
            sys.exit("%s before, %s after" % (face["material"], after[corners]["material"]))
    if original["materials"].keys() != back["materials"].keys():
        sys.exit("materials %s before, %s after" % (original["materials"], back["materials"]))
    for name, colour in original["materials"].items():
        expect_close("base colours of " + name, [colour], [back["materials"][name]], 1e-5)
    print(
        "%d faces; positions %g (allowed %g), texture coordinates %g, colours %g off"
        % (len(before), worst, tolerance, uv, colours)
    )


def validate(path):
    if shutil.which("node") is None or subprocess.run(["node", "-e", "require('gltf-validator')"], stderr=subprocess.DEVNULL).returncode:
        print("no gltf-validator: set NODE_PATH to its folder to have the .glb judged")
        return
    run(["node", "-e", VALIDATE, path])
    print("gltf-validator finds no error and no warning")


def main():
    tvg, kind = sys.argv[1], sys.argv[2]
    if shutil.which("blender") is None:
        print("skipped: there is no Blender")
        sys.exit(SKIPPED)
    with tempfile.TemporaryDirectory() as folder:
        at = lambda *parts: os.path.join(folder, *parts)
        blender("make", kind, folder)
        os.mkdir(at("back"))
        options = []
        if kind == "cache":
            files, backs = [at("cache", "sheet.obj"), at("cache", "sheet.mdd")], [at("back", "sheet.obj"), at("back", "sheet.mdd")]
            output = backs[1]
        elif kind == "gltf":
            files, backs = [at("gltf", "sheet.glb")], [at("back", "sheet.glb")]
            output, options = backs[0], ["--fps", RATE]
        else:
            number = lambda path: int(re.search("[0-9]+", os.path.basename(path)).group())
            files = sorted(glob.glob(at(kind, "*." + kind)), key=number)
            output = at("back", "sheet_%04d." + kind)
            backs = [output % frame for frame in range(FRAMES)]
        original = look(kind, files, at("original.json"))
        print(run([tvg, "encode"] + files + options + ["-o", at("sheet.tvg"), "--bits", str(BITS), "--uv-bits", str(UV_BITS)]), end="")
        print(run([tvg, "decode", at("sheet.tvg"), "-o", output]), end="")
        if kind == "gltf":
            validate(output)
        compare(original, look(kind, backs, at("back.json")))


main()
