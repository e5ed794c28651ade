"""python -m tvg info FILE...: what streams have, in a few lines, without decoding all frames."""
import sys
from typing import List

from .clip import open
from .errors import Error


def describe(path: str) -> str:
    """What a stream has."""
    with open(path) as clip:
        rate = "" if clip.fps is None else f", {clip.fps:g} frames per second"
        lines = [
            f"{path}: {len(clip)} frames of {clip.mesh.vertex_count} vertices, {len(clip.faces)} faces{rate}"
        ]
        gop = clip[0].gop if len(clip) else None
        if gop is not None and gop.mode == "lossless":
            lines.append("  mode lossless")
        elif gop is not None:
            lines.append(f"  mode {gop.mode}, steps {gop.fine_step:g} and {gop.coarse_step:g}")
        lines += [f"  {key}: {value}" for key, value in clip.metadata.items()]
        for attribute in clip.attributes.values():
            values = "animated" if attribute.animated else f"{len(attribute.values)} values"
            lines.append(
                f"  attribute {attribute.name!r}: {attribute.kind} of each {attribute.domain}, {values} of "
                f"{attribute.components}"
            )
        lines += [f"  data {name!r}: {len(content)} bytes" for name, content in clip.data.items()]
    return "\n".join(lines)


def main(arguments: List[str]) -> int:
    """The exit status."""
    if len(arguments) < 2 or arguments[0] != "info":
        print("usage: python -m tvg info FILE...", file=sys.stderr)
        return 2
    status = 0
    for path in arguments[1:]:
        try:
            print(describe(path))
        except (Error, OSError) as error:
            print(f"{path}: {error}" if isinstance(error, Error) else error, file=sys.stderr)
            status = 1
    return status


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
