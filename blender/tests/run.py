"""run.py TVG_BLENDER.ZIP TEST: runs TEST.py of this folder in Blender with the packed add-on; ends with 77 where there is no
Blender. `cancelling` wants a window: Xvfb gives one."""
import shutil
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
archive, test = sys.argv[1:]
windowed = test == "cancelling"


def skip(why):
    print("SKIPPED:", why)
    sys.exit(77)


for program in ["blender"] + ["xvfb-run"] * windowed:
    if shutil.which(program) is None:
        skip(f"there is no {program}")
with tempfile.TemporaryDirectory(prefix="tvg-addon-") as folder:
    zipfile.ZipFile(archive).extractall(folder)
    # A Python of the caller's own, ahead in the path, would be taken for Blender's.
    environment = {"PATH": "/usr/local/bin:/usr/bin:/bin", "HOME": folder, "TVG_BLENDER": folder, "PYTHONPATH": str(HERE),
                   "PYTHONDONTWRITEBYTECODE": "1"}
    command = ["blender", "--factory-startup", "--python-use-system-env", "--python-exit-code", "1"]
    if windowed:
        command = ["xvfb-run", "-a", *command, "--enable-event-simulate", "--window-geometry", "0", "0", "320", "240"]
    else:
        command.append("--background")
    done = subprocess.run(
        [*command, "--python", str(HERE / f"{test}.py")],
        env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=150,
    )
    print(done.stdout)
    if "No module named 'numpy'" in done.stdout:
        skip("Blender's Python has no numpy")
    sys.exit(0 if done.returncode == 0 and "all of it passed" in done.stdout else 1)
