"""Work on several machines, with the schedulers that people have: a real Slurm (slurmctld, slurmd and munge over
loopback) and GNU parallel. A job is killed, one is requeued, and the result has the bytes of one machine's.

    python3 cluster_test.py TVG TVG_CORPUS SCRIPTS slurm|parallel
"""

import hashlib
import os
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

SKIPPED = 77
PARTS = 6
DEADLINE_S = 120

# What stands for tvg in the PATH: parts named in `sleep` wait when they are made the first time, until somebody ends
# them; those in `die` end at once, as by a lack of memory.
WRAPPER = """#!/bin/bash
for word in sleep die; do
  for part in $(cat "{folder}/$word" 2>/dev/null); do
    case " $* " in
      *" --part $part "*)
        if mkdir "{folder}/$word.$part" 2>/dev/null; then
          [ $word = die ] && kill -9 $$
          sleep 300
        fi ;;
    esac
  done
done
exec "{tvg}" "$@"
"""


def run(command, **options):
    done = subprocess.run(command, capture_output=True, text=True, **options)
    if done.returncode != 0:
        sys.exit(f"{command}: {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout + done.stderr


def digest(path):
    return hashlib.sha256(Path(path).read_bytes()).hexdigest()


def wait_for(what, is_so):
    end = time.monotonic() + DEADLINE_S
    while not is_so():
        if time.monotonic() > end:
            sys.exit(f"{what}: not within {DEADLINE_S} s")
        time.sleep(0.2)


class Work:
    """A sequence, its plan, and the bytes that one machine makes of it."""

    def __init__(self, tvg, corpus, folder):
        self.folder = Path(folder)
        run([corpus, "hand", "--size", "300", "--frames", "36", "-o", folder])
        encoding = ["hand.obj", "hand.pc2", "--mode", "basis", "--period", "6"]
        run([tvg, "encode", *encoding, "-o", "one.tvg"], cwd=folder)
        run([tvg, "plan", *encoding, "--parts", str(PARTS), "-o", "hand.plan.json"], cwd=folder)
        (self.folder / "bin").mkdir()
        wrapper = self.folder / "bin/tvg"
        wrapper.write_text(WRAPPER.format(folder=folder, tvg=tvg))
        wrapper.chmod(0o755)
        self.environment = {**os.environ, "PATH": f"{self.folder}/bin:{os.environ['PATH']}"}

    def spoil(self, word, *parts):
        (self.folder / word).write_text(" ".join(map(str, parts)))

    def has_begun(self, word, part):
        return (self.folder / f"{word}.{part}").exists()

    def part(self, number):
        return self.folder / f"hand.part-{number}-of-{PARTS}.tvg"

    def check_whole(self):
        one, joined = digest(self.folder / "one.tvg"), digest(self.folder / "hand.tvg")
        print(f"one machine  sha256 {one}\nthe parts    sha256 {joined}")
        if one != joined:
            sys.exit("the bytes differ")


def try_slurm(work, scripts):
    if os.geteuid() != 0 or not all(map(shutil.which, ["slurmctld", "slurmd", "munged", "sbatch"])):
        print("skipped: root, slurm-wlm and munge are needed")
        return SKIPPED
    slurm = tempfile.mkdtemp(prefix="tvg-slurm-")
    started = subprocess.run([scripts / "local_slurm.sh", "start", slurm], capture_output=True, text=True)
    try:
        if started.returncode != 0:
            print(f"skipped: Slurm does not start here: {started.stdout}{started.stderr}")
            return SKIPPED
        work.environment["SLURM_CONF"] = f"{slurm}/slurm.conf"
        run_on_slurm(work, scripts)
        return 0
    finally:
        subprocess.run([scripts / "local_slurm.sh", "stop", slurm], check=False)
        shutil.rmtree(slurm, ignore_errors=True)


def run_on_slurm(work, scripts):
    def slurm(*command):
        return run(command, env=work.environment, cwd=work.folder)

    def submit():
        said = slurm(scripts / "slurm_encode.sh", "hand.plan.json")
        print(said, end="")
        return said.split("jobs ")[1].split("_")[0]

    def queue():
        return slurm("squeue", "--noheader", "--array", "--format=%i %j %T")

    work.spoil("sleep", 2)
    work.spoil("die", 4)
    array = submit()
    wait_for("part 2 runs", lambda: work.has_begun("sleep", 2))
    slurm("scontrol", "requeue", f"{array}_2")

    def has_settled():
        # Slurm holds what is requeued back for two minutes.
        if "PENDING" in queue():
            subprocess.run(["scontrol", "update", f"jobid={array}_2", "starttime=now"], env=work.environment,
                           capture_output=True, check=False)
        return queue() == ""

    # Part 4 died, so what joins is not run; part 2 is, from its beginning.
    wait_for("all that can run has", has_settled)
    there = [number for number in range(1, PARTS + 1) if work.part(number).exists()]
    if there != [1, 2, 3, 5, 6] or (work.folder / "hand.tvg").exists():
        sys.exit(f"parts {there} are there where one was killed")
    made = {number: work.part(number).stat().st_mtime_ns for number in there}
    submit()
    wait_for("the second run", lambda: queue() == "")
    if any(work.part(number).stat().st_mtime_ns != when for number, when in made.items()):
        sys.exit("parts that were whole were made again")
    work.check_whole()


def try_parallel(work):
    if not shutil.which("parallel"):
        print("skipped: GNU parallel is needed")
        return SKIPPED
    line = ["parallel", "--will-cite", "--joblog", "hand.joblog", "-j", "2", "--resume-failed",
            "tvg encode --plan hand.plan.json --part {} --threads 1", ":::", *map(str, range(1, PARTS + 1))]
    work.spoil("die", 3)
    first = subprocess.run(line, env=work.environment, cwd=work.folder, capture_output=True, text=True)
    if first.returncode != 1 or work.part(3).exists():
        sys.exit(f"a part was killed, and parallel ended with {first.returncode}")
    run(line, env=work.environment, cwd=work.folder)
    run(["tvg", "join", "--plan", "hand.plan.json"], env=work.environment, cwd=work.folder)
    work.check_whole()
    return 0


def main():
    tvg, corpus, scripts, scheduler = sys.argv[1:]
    with tempfile.TemporaryDirectory(prefix="tvg-cluster-") as folder:
        work = Work(tvg, corpus, folder)
        return try_slurm(work, Path(scripts)) if scheduler == "slurm" else try_parallel(work)


if __name__ == "__main__":
    sys.exit(main())
