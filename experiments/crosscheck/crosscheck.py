#!/usr/bin/env python3
"""Compares Stilb's illuminances with those of Mitsuba 3 and Radiance.

    python3 -m venv venv && venv/bin/pip install mitsuba pyradiance
    make build
    venv/bin/python experiments/crosscheck/crosscheck.py experiments/crosscheck/*.toml

Every scene is measured by Stilb's methods and by the other programs, where these can do it. Each reading has
a standard error; z is the difference over the root of the sum of both squared errors. Exit code 1 where
|z| > 4.
"""

import argparse
import json
import subprocess
import sys
import time
from pathlib import Path

import numpy as np

import with_mitsuba
import with_radiance
from scene import read_scene

ROOT = Path(__file__).resolve().parents[2]
PROGRAMS = {"mitsuba": with_mitsuba.illuminance, "radiance": with_radiance.illuminance}
LARGEST_Z = 4


def run_stilb(program: Path, scene: Path, method: str, error: float, time_limit: float) -> tuple:
    """Names, positions, normals, values and standard errors of all readings."""
    # Its --error is the half-width of the 95 % interval, about two standard errors.
    limits = ["--error", str(2 * error), "--time", str(time_limit)]
    command = [program, "measure", scene, "--json", "--quiet", "--method", method, *limits]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode not in (0, 3):
        sys.exit(done.stderr)
    readings = [(s["name"], v) for s in json.loads(done.stdout)["sensors"] for v in s["values"]]
    keys = ("position", "normal", "value", "standard_error")
    columns = [np.array([v[key] for _, v in readings]) for key in keys]
    if np.any(columns[2] <= 0):
        sys.exit(f"{scene}: a reading is 0: no relative error of it can be reached")
    return [name for name, _ in readings], *columns


def compare(scene: Path, arguments) -> float:
    """Prints a table of readings and one of methods; returns the largest |z|."""
    limits = arguments.error, arguments.time
    measured = {m: run_stilb(arguments.stilb, scene, m, *limits) for m in arguments.methods}
    names, positions, normals, *_ = measured[arguments.methods[0]]
    measured = {method: columns[3:] for method, columns in measured.items()}
    description, references = read_scene(scene), {}
    for program in arguments.programs:
        start = time.monotonic()
        if result := PROGRAMS[program](description, positions, normals, arguments.error):
            references[program] = result
            print(f"{scene.stem}: {program} took {time.monotonic() - start:.0f} s", file=sys.stderr)

    columns = {**measured, **references}
    print(f"\n### {scene.stem}\n\n| reading | " + " | ".join(f"{c} [lx]" for c in columns) + " |")
    print("|---" * (len(columns) + 1) + "|")
    for i, name in enumerate(names):
        cells = [f"{value[i]:.2f} ± {error[i]:.2f}" for value, error in columns.values()]
        print(f"| {name} {i} | " + " | ".join(cells) + " |")
    print("\n| against | method | mean difference | largest abs z | mean z² |\n|---|---|---|---|---|")
    largest = 0.0
    for program, (reference, reference_error) in references.items():
        for method, (value, error) in measured.items():
            z = (value - reference) / np.hypot(error, reference_error)
            difference = np.mean(value / reference - 1)
            largest = max(largest, float(np.max(np.abs(z))))
            numbers = f"{difference:+.3%} | {np.max(np.abs(z)):.1f} | {np.mean(z**2):.2f}"
            print(f"| {program} | {method} | {numbers} |")
    sys.stdout.flush()
    return largest


def main() -> None:
    raw = argparse.RawDescriptionHelpFormatter
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=raw)
    parser.add_argument("scenes", nargs="+", type=Path)
    parser.add_argument("--stilb", type=Path, default=ROOT / "build/release/stilb")
    parser.add_argument("--error", type=float, default=0.001, help="relative standard error (0.001)")
    parser.add_argument("--time", type=float, default=60, help="seconds for each method of Stilb (60)")
    parser.add_argument("--methods", nargs="+", default=["auto", "local", "path"])
    parser.add_argument("--programs", nargs="+", default=list(PROGRAMS), choices=PROGRAMS)
    arguments = parser.parse_args()
    if max(compare(scene, arguments) for scene in arguments.scenes) > LARGEST_Z:
        sys.exit(f"there are differences of more than {LARGEST_Z} standard errors")


if __name__ == "__main__":
    main()
