"""What docs/first_minutes.md has its reader type: files and commands, section by section."""
from __future__ import annotations

import re
from pathlib import Path
from typing import List, NamedTuple, Optional


class Step(NamedTuple):
    """A fenced block: the text of a file, where `file` names one, or commands for a shell."""

    file: Optional[str]
    text: str


_HEADING = re.compile(r"^## (.+)$", re.MULTILINE)
_BLOCK = re.compile(r"(?:^`(?P<file>[^`\n]+)`:\n\n)?^```(?P<kind>\w*)\n(?P<text>.*?)^```$", re.MULTILINE | re.DOTALL)


def steps_of(page: Path, section: str) -> List[Step]:
    """The steps of the section under the heading `section`, as they stand there.

    Blocks of `sh` are typed; a block under a line that names a file is that file. Any other block is a mistake.
    """
    parts = _HEADING.split(page.read_text(encoding="utf-8"))
    sections = dict(zip(parts[1::2], parts[2::2]))
    if section not in sections:
        raise SystemExit(f"{page} has no section '{section}'; it has {', '.join(sections)}")
    steps = []
    for block in _BLOCK.finditer(sections[section]):
        if block["file"] is None and block["kind"] != "sh":
            raise SystemExit(f"{page}, section '{section}': a block that is neither a file nor commands:\n{block[0]}")
        steps.append(Step(block["file"], block["text"]))
    if not any(step.file is None for step in steps):
        raise SystemExit(f"{page}, section '{section}' has no commands")
    return steps
