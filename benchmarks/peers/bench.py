#!/usr/bin/env python3
"""Processor time of Stilb, Mitsuba and Radiance to a given error: make bench-peers runs this.

    make bench-peers SCENES="room hall"

Definitions and results: docs/performance.md.
"""

import argparse
import json
from dataclasses import asdict, dataclass

import numpy as np

import radiance
from programs import LONGEST_S, MitsubaSession, StilbSession, TakesTooLong
from references import Reference, reference
from tasks import ROOT, TASKS, Task

RESULTS = ROOT / "build/peers/results.json"
MOST_GROWTH = 16  # of the size from one run to the next
HEADER = ("| task | target | program | seconds | of these set-up | ratio | measured at | bias | z | memory [MB] |\n"
          "|---|---|---|---|---|---|---|---|---|---|")


@dataclass
class Row:
    task: str
    target: float
    program: str
    seconds: float  # to the target, with set-up
    set_up_s: float
    error: float  # of the runs from which `seconds` was derived
    size: int
    bias: float
    z: float
    memory_mb: float
    factor: float  # by which the time of the runs was scaled
    is_reached: bool

    @property
    def sign(self) -> str:
        return ">" if not self.is_reached else "" if 0.5 <= self.factor <= 2 else "~"


def sessions(task: Task, threads: int) -> dict:
    """Map the name of each program and method in tables to the function that opens a session of it."""
    contestants = {f"stilb {method}": lambda method=method: StilbSession(task, method, threads)
                   for method in ("auto", "path")}
    for sampler in ("independent", "multijitter"):
        contestants[f"mitsuba {sampler}"] = lambda s=sampler: MitsubaSession(task, s, "llvm_ad_rgb", threads)
    for settings in ("exact", "cached") if not radiance.lacks(task) else ():
        contestants[f"radiance {settings}"] = lambda s=settings: radiance.RadianceSession(task, s, threads)
    return contestants


def find_size(session, ref: Reference, target: float, most_s: float, size: int) -> int:
    """The size that about reaches the target, or the largest one within `most_s`."""
    # One run says little about the error of a single reading. Those of biased programs are long.
    pilots = max(int((4 if session.is_biased else 32) / ref.values.size**0.5), 1)
    while True:
        runs = [session.run(size, 1001 + i) for i in range(pilots)]
        growth = np.mean([ref.squared_error(run.values) for run in runs]) / target**2
        if growth <= 1.2 and (growth >= 0.7 or size <= session.first_size):
            return size
        if growth < 0.7:
            smaller = max(int(size * max(growth, 1 / MOST_GROWTH)), session.first_size)
            if smaller > 0.8 * size:
                return size
            return smaller
        growth = min(growth, MOST_GROWTH, most_s / runs[0].seconds)
        if growth < 1.2:
            return size
        size = max(int(size * growth), size + 1)


def row_of(task: Task, name: str, session, ref: Reference, target: float, size: int, seeds: int) -> Row:
    runs = [session.run(size, seed) for seed in range(2, 2 + seeds)]
    squared = max(np.mean([ref.squared_error(run.values) for run in runs]), 1e-16)
    biases = np.array([ref.bias(run.values) for run in runs])
    # Few seeds may agree by chance; the error of the mean is hardly below that of independent values.
    least = np.mean([np.std(run.values - ref.values) for run in runs]) / np.sqrt(ref.values.size) / ref.mean
    spread = np.hypot(max(biases.std(ddof=1), least) / np.sqrt(len(runs)), ref.mean_error)
    sampling = np.median([run.seconds for run in runs])
    factor = squared / target**2
    if session.is_biased:
        factor = 1.0  # its error does not fall with the number of samples alone
    elif size <= session.first_size:
        factor = max(factor, 1.0)  # no run is smaller
    set_up, is_reached = session.set_up_s(), not session.is_biased or squared <= 2 * target**2
    return Row(task.name, target, name, set_up + sampling * factor, set_up, float(np.sqrt(squared)), size,
               float(biases.mean()), float(biases.mean() / spread), session.memory_mb, float(factor), is_reached)


def rows_of(task: Task, ref: Reference, arguments) -> list[Row]:
    """Prints them as they come."""
    rows = []
    for name, open_session in sessions(task, arguments.threads).items():
        if arguments.programs and not any(name.startswith(wanted) for wanted in arguments.programs):
            continue
        session = open_session()
        size = session.first_size
        try:
            for target in task.targets:
                size = find_size(session, ref, target, arguments.limit, size)
                seeds = arguments.seeds or (min(task.seeds, 4) if session.is_biased else task.seeds)
                rows.append(row_of(task, name, session, ref, target, size, seeds))
                print(line_of(rows[-1], rows), flush=True)
        except TakesTooLong:
            print(f"| {task.name} | | {name} | a run takes more than {LONGEST_S} s | | | | | | |", flush=True)
        session.close()
    return rows


def line_of(row: Row, rows: list[Row]) -> str:
    base = next((r.seconds for r in rows if r.target == row.target and r.program == "stilb auto"), None)
    ratio = f"{row.seconds / base:.3g}" if base else ""
    return (f"| {row.task} | {100 * row.target:g} % | {row.program} | {row.sign}{row.seconds:.3g} | {row.set_up_s:.2g} | "
            f"{ratio} | {100 * row.error:.2g} % | {100 * row.bias:+.3f} % | {row.z:+.1f} | {row.memory_mb:.0f} |")


def main() -> None:
    raw = argparse.RawDescriptionHelpFormatter
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=raw)
    parser.add_argument("scenes", nargs="*", help="of these scenes only")
    parser.add_argument("--kinds", nargs="+", help="only grid, picture or readings")
    parser.add_argument("--programs", nargs="+", help="only those whose name begins so")
    parser.add_argument("--threads", type=int, default=2, help="of every program (2)")
    parser.add_argument("--seeds", type=int, help="runs from which a row is derived (3 to 12, by the kind of task)")
    parser.add_argument("--limit", type=float, default=8, help="processor seconds of a run (8)")
    parser.add_argument("--reference", type=float, default=16, help="processor seconds of each reference (16)")
    arguments = parser.parse_args()
    every = []
    for task in TASKS:
        if (arguments.scenes and task.scene not in arguments.scenes) or (
                arguments.kinds and task.kind not in arguments.kinds):
            continue
        ref = reference(task, arguments.reference, arguments.threads)
        print(f"\n{task.name}: {ref.agreement()}\n\n{HEADER}", flush=True)
        every += [asdict(row) for row in rows_of(task, ref, arguments)]
    RESULTS.write_text(json.dumps(every, indent=1))


if __name__ == "__main__":
    main()
