#!/usr/bin/env python3
"""run.py SECTION PROJECT BUILD [PREFIX]: types what a section of docs/first_minutes.md says, word for word, in an empty
folder, and looks at what came of it. Prints how long that took; a reader has five minutes. PREFIX is where the project was
installed; without it, that is the system. TVG_KEEP names a folder for what was made. Exit status 77: something is missing
that the section stands on.
"""
from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import urllib.request
from pathlib import Path
from typing import Callable, Dict, List, NamedTuple, Tuple

import outcomes
from page import steps_of

HERE = Path(__file__).resolve().parent
BUDGET = 300  # seconds
SKIPPED = 77
NETWORK = ("http_proxy", "https_proxy", "no_proxy", "node_extra_ca_certs", "ssl_cert_file", "ssl_cert_dir")
SERVER = "http.server"  # the command that goes on until the page is closed


class Section(NamedTuple):
    heading: str
    needs: Tuple[str, ...]  # programs
    probe: str  # a command that fails where something else is missing
    outcome: Callable[[Path, str], None]


SECTIONS = {
    "shell": Section("In the shell", (), "true", outcomes.shell),
    "python": Section("Python", (), "python3 -c 'import setuptools, ensurepip, numpy, pip, wheel'", outcomes.python),
    "blender": Section("Blender", ("blender",), "/usr/bin/python3 -c 'import numpy'", outcomes.blender),
    "c": Section("C", ("cc", "pkg-config"), "true", outcomes.c),
    "cpp": Section("C++", ("c++", "cmake", "pkg-config"), "true", outcomes.cpp),
    "three": Section("three.js", ("node", "npm"), "npm view three version", outcomes.three),
}


def skip(why: str) -> None:
    print(f"SKIPPED: {why}")
    sys.exit(SKIPPED)


def stage(folder: Path, project: Path, build: Path) -> Path:
    """What the page calls $TVG: the project's folder with the builds where the page has them, and nothing written to it."""
    staged = folder / "project"
    (staged / "build").mkdir(parents=True)
    made = shutil.ignore_patterns("__pycache__", "build", "*.egg-info")
    shutil.copytree(project / "python", staged / "python", ignore=made)
    shutil.copyfile(project / "LICENSE", staged / "LICENSE")
    for name, target in (("web", project / "web"), ("build/release", build), ("build/wasm", project / "build/wasm")):
        (staged / name).symlink_to(target)
    return staged


def environment(home: Path, project: Path, prefix: str) -> Dict[str, str]:
    """A fresh user's; with a prefix also what an installation under /usr has by itself."""
    kept = {key: value for key, value in os.environ.items() if key.lower() in NETWORK}
    path = "/usr/local/bin:/usr/bin:/bin"
    for name in ("node", "npm"):  # which may come from elsewhere
        found = shutil.which(name)
        if found:
            path += ":" + str(Path(found).parent)
    chosen = {**kept, "PATH": path, "HOME": str(home), "LANG": "C.UTF-8", "TVG": str(project)}
    npmrc = Path.home() / ".npmrc"
    if npmrc.exists():
        chosen["NPM_CONFIG_USERCONFIG"] = str(npmrc)
    if prefix:
        libraries = sorted({str(found.parent) for found in Path(prefix).glob("lib/**/libtvg.so")})
        chosen.update(
            PATH=f"{prefix}/bin:{path}",
            CMAKE_PREFIX_PATH=prefix,
            LD_LIBRARY_PATH=":".join(libraries),
            PKG_CONFIG_PATH=":".join(f"{library}/pkgconfig" for library in libraries),
        )
    return chosen


def type_in(commands: str, folder: Path, env: Dict[str, str], seconds: float) -> str:
    """Runs commands as a shell does that stops at the first that fails."""
    done = subprocess.run(
        ["sh", "-ex"], input=commands, cwd=folder, env=env, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
        timeout=seconds,
    )
    print(done.stdout, end="")
    if done.returncode != 0:
        sys.exit(f"failed with status {done.returncode}")
    return done.stdout


def open_page(command: str, folder: Path, env: Dict[str, str]) -> None:
    """Starts the server that the page ends with, and looks at what it serves in a browser."""
    port = next(word for word in command.split() if word.isdigit())
    server = subprocess.Popen(["sh", "-c", "exec " + command], cwd=folder, env=env, start_new_session=True)
    try:
        address = f"http://127.0.0.1:{port}/"
        for _ in range(100):
            try:
                urllib.request.build_opener(urllib.request.ProxyHandler({})).open(address).close()
                break
            except OSError:
                if server.poll() is not None:
                    sys.exit(f"'{command}' ended by itself")
                time.sleep(0.1)
        look = ["node", HERE / "plays.mjs", address, folder / "played.png"]
        seen = subprocess.run(look, env={**os.environ, **env}, timeout=120)
    finally:
        os.killpg(server.pid, signal.SIGTERM)
        server.wait()
    if seen.returncode == SKIPPED:
        skip("no chromium, or no playwright-core (npm ci in web/): all was typed, and nobody looked at the page")
    if seen.returncode != 0:
        sys.exit("the page does not play")


def run(name: str, project: Path, build: Path, prefix: str) -> None:
    section = SECTIONS[name]
    steps = steps_of(project / "docs/first_minutes.md", section.heading)
    for program in section.needs:
        if shutil.which(program) is None:
            skip(f"there is no {program}")
    if name == "three" and not list(project.glob("build/wasm/tvg-*.tgz")):
        skip("the package for the web is not built (make web)")
    with tempfile.TemporaryDirectory(prefix="tvg-first-minutes-") as scratch:
        home, folder = Path(scratch) / "home", Path(scratch) / "own"
        home.mkdir()
        folder.mkdir()
        env = environment(home, stage(Path(scratch), project, build), prefix)
        quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
        if subprocess.run(["sh", "-c", section.probe], env=env, check=False, **quiet).returncode != 0:
            skip(f"this fails: {section.probe}")
        # Not the reader's first animation, so not a step of theirs.
        subprocess.run([build / "corpus/tvg_corpus", "hand", "-o", folder], check=True, stdout=subprocess.DEVNULL)
        start = time.monotonic()
        output: List[str] = []
        for step in steps:
            if step.file is not None:
                (folder / step.file).write_text(step.text, encoding="utf-8")
                continue
            lines = step.text.splitlines()
            server = lines.pop() if SERVER in lines[-1] else None
            output.append(type_in("\n".join(lines) + "\n", folder, env, BUDGET - (time.monotonic() - start)))
            if server is not None:
                open_page(server, folder, env)
        seconds = time.monotonic() - start
        section.outcome(folder, "".join(output))
        if os.environ.get("TVG_KEEP"):
            shutil.copytree(folder, os.environ["TVG_KEEP"], dirs_exist_ok=True)
    print(f"{section.heading}: {seconds:.1f} s of {BUDGET}")
    if seconds > BUDGET:
        sys.exit("that is more than five minutes")


if __name__ == "__main__":
    if len(sys.argv) not in (4, 5) or sys.argv[1] not in SECTIONS:
        sys.exit(f"{__doc__}Sections: {', '.join(SECTIONS)}")
    run(sys.argv[1], Path(sys.argv[2]).resolve(), Path(sys.argv[3]).resolve(), sys.argv[4] if len(sys.argv) == 5 else "")
