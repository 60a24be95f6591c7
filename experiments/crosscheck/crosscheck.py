#!/usr/bin/env python3
"""Compares Stilb's illuminances and luminances with those of Mitsuba 3 and Radiance.

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
from rays import Rays, fixed_rays
from scene import Scene, read_scene

ROOT = Path(__file__).resolve().parents[2]
PROGRAMS = {"mitsuba": with_mitsuba, "radiance": with_radiance}
LARGEST_Z = 4
ROUNDING = 1e-5
GONIOMETER_DISTANCE = 0.01  # m: how near the other programs look at its point


def run_stilb(program: Path, scene: Path, method: str, error: float, time_limit: float, threads: int) -> list:
    """All readings: those of luminance have a `direction`."""
    # Its --error is the half-width of the 95 % interval, about two standard errors.
    limits = ["--error", str(2 * error), "--time", str(time_limit), "--threads", str(threads)]
    command = [program, "measure", scene, "--json", "--quiet", "--method", method, *limits]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode not in (0, 3):
        sys.exit(done.stderr)
    sensors = json.loads(done.stdout)["sensors"]
    readings = [{"name": s["name"], "unit": s["unit"], **v} for s in sensors for v in s["values"]]
    if any(reading["value"] <= 0 for reading in readings):
        sys.exit(f"{scene}: a reading is 0: no relative error of it can be reached")
    return readings


def column(readings: list, key: str) -> np.ndarray:
    return np.array([reading[key] for reading in readings])


def look(readings: list) -> Rays:
    """Rays that see what the readings see."""
    starts, directions = [], []
    for reading in readings:
        position, direction = np.array(reading["position"]), np.array(reading["direction"])
        if "normal" in reading:  # of a goniometer: the direction is that of the light
            position, direction = position + GONIOMETER_DISTANCE * direction, -direction
        starts.append(position)
        directions.append(direction)
    return fixed_rays(np.array(starts), np.array(directions))


def refer(program, scene: Scene, readings: list, error: float):
    """Values and standard errors of the readings by another program; None where it cannot have the scene."""
    is_luminance = column(readings, "unit") == "cd/m2"
    values, errors = np.zeros(len(readings)), np.zeros(len(readings))
    for chosen in (is_luminance, ~is_luminance):
        part = [reading for reading, of_part in zip(readings, chosen) if of_part]
        if not part:
            continue
        if part[0]["unit"] == "cd/m2":
            result = program.luminance(scene, look(part), error)
        else:
            result = program.illuminance(scene, column(part, "position"), column(part, "normal"), error)
        if result is None:
            return None
        values[chosen], errors[chosen] = result
    return values, errors


def print_differences(places: list[str], measured: dict, references: dict) -> float:
    """One line for each program and method; returns the largest |z|."""
    print("| against | method | mean difference | largest abs z | mean z² | mean error |")
    print("|---|---|---|---|---|---|")
    largest = 0.0
    for program, (reference, reference_error) in references.items():
        for method, (value, error) in measured.items():
            both = np.hypot(error, reference_error)
            # A lamp seen directly has no error in any program; rounding differs.
            z = (value - reference) / np.maximum(both, ROUNDING * value)
            worst = int(np.argmax(np.abs(z)))
            largest = max(largest, abs(float(z[worst])))
            numbers = f"{np.mean(value / reference - 1):+.3%} | {abs(z[worst]):.1f} ({places[worst]})"
            print(f"| {program} | {method} | {numbers} | {np.mean(z**2):.2f} | {np.mean(both / value):.2%} |")
    sys.stdout.flush()
    return largest


def compare(scene: Path, arguments) -> float:
    """Prints a table of readings and one of methods; returns the largest |z|."""
    settings = arguments.error, arguments.time, arguments.threads
    by_method = {m: run_stilb(arguments.stilb, scene, m, *settings) for m in arguments.methods}
    measured = {m: (column(r, "value"), column(r, "standard_error")) for m, r in by_method.items()}
    readings = by_method[arguments.methods[0]]
    description, references = read_scene(scene), {}
    for program in arguments.programs:
        start = time.monotonic()
        if result := refer(PROGRAMS[program], description, readings, arguments.error):
            references[program] = result
            print(f"{scene.stem}: {program} took {time.monotonic() - start:.0f} s", file=sys.stderr)

    columns = {**measured, **references}
    print(f"\n### {scene.stem}\n\n| reading | unit | " + " | ".join(columns) + " |")
    print("|---" * (len(columns) + 2) + "|")
    places = [f"{reading['name']} {i}" for i, reading in enumerate(readings)]
    for i, reading in enumerate(readings):
        cells = [f"{value[i]:.2f} ± {error[i]:.2f}" for value, error in columns.values()]
        print(f"| {places[i]} | {reading['unit']} | " + " | ".join(cells) + " |")
    print()
    return print_differences(places, measured, references)


def main() -> None:
    raw = argparse.RawDescriptionHelpFormatter
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=raw)
    parser.add_argument("scenes", nargs="+", type=Path)
    parser.add_argument("--stilb", type=Path, default=ROOT / "build/release/stilb")
    parser.add_argument("--error", type=float, default=0.001, help="relative standard error (0.001)")
    parser.add_argument("--time", type=float, default=60, help="seconds for each method of Stilb (60)")
    parser.add_argument("--threads", type=int, default=0, help="of Stilb (all)")
    parser.add_argument("--methods", nargs="+", default=["auto", "local", "path"])
    parser.add_argument("--programs", nargs="+", default=list(PROGRAMS), choices=PROGRAMS)
    arguments = parser.parse_args()
    if max(compare(scene, arguments) for scene in arguments.scenes) > LARGEST_Z:
        sys.exit(f"there are differences of more than {LARGEST_Z} standard errors")


if __name__ == "__main__":
    main()
