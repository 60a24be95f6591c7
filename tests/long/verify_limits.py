#!/usr/bin/env python3
"""Whether runs of all methods and sizes keep their time limits and end at Ctrl-C.

A run with --time T has to end within T + 10 % + 0.5 s, and within a second after Ctrl-C: with a result, or with
a message that there is none yet. Prints a table; ends with 1 where a run took longer. Wall times count, so the
machine should have nothing else to do.

    tests/long/verify_limits.py [METHOD ...]

The program is $STILB, or build/release/stilb.
"""

import os
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("STILB", str(ROOT / "build/release/stilb"))

METHODS = ["auto", "local", "double-local", "path", "radiosity", "ray-bundle", "particles"]
GRIDS = [(32, 16), (400, 200), (1000, 500)]
PICTURES = [(1152, 868), (3840, 2160)]
TIMES_S = [1, 5]
CTRL_C_AFTER_S = [0.3, 3]
"""Ctrl-C meets the set-up, and the sampling."""
MOST_AFTER_CTRL_C_S = 1
HUNG_S = 600

SCENE = """
[materials.wall]
type = "diffuse"
reflectance = [0.7, 0.6, 0.5]

[objects.room]
shape = "box"
min = [0, 0, 0]
max = [6, 4, 3]
material = "wall"

[objects.table]
shape = "box"
min = [2, 1, 0.7]
max = [4, 3, 0.74]
material = "wall"

[lights.bulb]
type = "point"
position = [3, 2, 2.5]
flux = 1000

[objects.panel]
shape = "rectangle"
corner = [1, 1, 2.95]
edge_u = [0, 0.6, 0]
edge_v = [0.6, 0, 0]
material = "wall"

[lights.panel]
type = "area"
object = "panel"
flux = 3000
"""


def grid(counts):
    return f"""
[sensors.floor]
type = "grid"
corner = [0.1, 0.1, 0]
edge_u = [5.8, 0, 0]
edge_v = [0, 3.8, 0]
count = [{counts[0]}, {counts[1]}]
"""


def camera(resolution):
    return f"""
[sensors.view]
type = "camera"
position = [0.2, 0.2, 1.6]
target = [4, 2, 1]
fov = 80
resolution = [{resolution[0]}, {resolution[1]}]
"""


def kinds_of_run():
    """Yields a run's name, its scene and its command."""
    methods = sys.argv[1:] or METHODS
    for counts in GRIDS:
        for method in methods:
            command = ["measure", "--method", method, "-o", "out.json"]
            yield f"{counts[0] * counts[1]} readings, {method}", SCENE + grid(counts), command
    for resolution in PICTURES:
        for method in methods:
            if method == "local":
                continue  # illuminance only
            name = f"{resolution[0] * resolution[1] / 1e6:.0f} megapixels, {method}"
            yield name, SCENE + camera(resolution), ["render", "--method", method, "-o", "out.exr"]
    yield "solution", SCENE + grid(GRIDS[0]), ["solve", "-o", "out.solution"]


def run(scene, command, ctrl_c_after_s=None):
    """Seconds of a run in a folder of its own, or from Ctrl-C to its end, and how it ended."""
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "room.toml").write_text(scene, encoding="utf-8")
        took_s, end = end_of(command, folder, ctrl_c_after_s)
        has_result = any(Path(folder).glob("out.*"))
    return took_s, end or ("a result" if has_result else "no result yet")


def end_of(command, folder, ctrl_c_after_s):
    """Seconds, and how the run ended where it did so wrongly."""
    start = time.monotonic()
    process = subprocess.Popen([PROGRAM, *command], cwd=folder, stdout=subprocess.DEVNULL,
                               stderr=subprocess.PIPE, text=True)
    try:
        if ctrl_c_after_s is not None:
            time.sleep(ctrl_c_after_s)
            start = time.monotonic()
            process.send_signal(signal.SIGINT)
        _, messages = process.communicate(timeout=HUNG_S)
    except subprocess.TimeoutExpired:
        process.kill()
        process.communicate()
        return HUNG_S, "killed"
    took_s = time.monotonic() - start
    if process.returncode < 0:
        return took_s, f"signal {-process.returncode}"
    if process.returncode not in (0, 3):
        raise RuntimeError(f"{' '.join(command)}: {messages}")
    return took_s, ""


def main():
    late = 0
    print(f"{'run':38} {'limit':>12} {'took':>8}   ended with")
    for name, scene, command in kinds_of_run():
        full = [command[0], "room.toml", *command[1:]]
        trials = [(f"--time {t}", t * 1.1 + 0.5, run(scene, [*full, "--time", str(t)])) for t in TIMES_S]
        trials += [("Ctrl-C", MOST_AFTER_CTRL_C_S, run(scene, [*full, "--time", "60"], after_s))
                   for after_s in CTRL_C_AFTER_S]
        for limit, most_s, (took_s, end) in trials:
            late += took_s > most_s
            print(f"{name:38} {limit:>12} {took_s:7.2f} s  {end}{'  LATE' if took_s > most_s else ''}", flush=True)
    print(f"{late} runs took too long")
    return 1 if late else 0


if __name__ == "__main__":
    sys.exit(main())
