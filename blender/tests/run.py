"""run.py TVG_BLENDER.ZIP: round_trip.py in Blender with the packed add-on; ends with 77 where there is no Blender."""
import shutil
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

blender = shutil.which("blender")
if blender is None:
    print("skipped: there is no Blender")
    sys.exit(77)
with tempfile.TemporaryDirectory(prefix="tvg-addon-") as folder:
    zipfile.ZipFile(sys.argv[1]).extractall(folder)
    # A Python of the caller's own, ahead in the path, would be taken for Blender's.
    environment = {"PATH": "/usr/local/bin:/usr/bin:/bin", "HOME": folder, "TVG_BLENDER": folder}
    script = Path(__file__).parent / "round_trip.py"
    done = subprocess.run(
        [blender, "--background", "--factory-startup", "--python-exit-code", "1",
         "--python", str(script)],
        env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=150,
    )
    print(done.stdout)
    if "No module named 'numpy'" in done.stdout:
        print("skipped: Blender's Python has no numpy")
        sys.exit(77)
    sys.exit(0 if done.returncode == 0 and "round trip passed" in done.stdout else 1)
