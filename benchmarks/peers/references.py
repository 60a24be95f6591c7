"""Converged references by two programs, and errors against them.

A reference is a pair of independent estimates, of Stilb (auto) and Mitsuba (path, multijitter). The square of an
error is the mean of (value - first)(value - second): its expectation is the true square whatever the noise of both,
which are independent of each other and of the value.
"""

import hashlib
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from programs import MitsubaSession, StilbSession, exported
from tasks import ROOT, Task

FOLDER = ROOT / "build/peers/references"
PARTS = 8  # runs of each program, whose spread is its error


@dataclass
class Estimate:
    values: np.ndarray
    rms: float  # standard error of a value, relative as in Reference.error()
    mean_error: float  # standard error of the mean of all values


@dataclass
class Reference:
    task: Task
    stilb: Estimate
    mitsuba: Estimate

    @property
    def values(self) -> np.ndarray:
        """The mean of both, weighted by their precision."""
        weights = [1 / max(e.rms, 1e-9) ** 2 for e in (self.stilb, self.mitsuba)]
        return np.average([self.stilb.values, self.mitsuba.values], axis=0, weights=weights)

    @property
    def norm(self) -> np.ndarray:
        return norm_of(self.task, self.values)

    def squared_error(self, values: np.ndarray) -> float:
        product = (values - self.stilb.values) * (values - self.mitsuba.values)
        return float(np.mean(product / self.norm**2))

    def bias(self, values: np.ndarray) -> float:
        """Return the relative error of the mean."""
        return float(values.mean() / self.mean - 1)

    @property
    def mean(self) -> float:
        a, b = self.stilb, self.mitsuba
        weights = [1 / max(e.mean_error, 1e-12) ** 2 for e in (a, b)]
        return float(np.average([a.values.mean(), b.values.mean()], weights=weights))

    @property
    def mean_error(self) -> float:
        """Relative standard error of `mean`."""
        return float(np.sum([1 / e.mean_error**2 for e in (self.stilb, self.mitsuba)]) ** -0.5 / self.mean)

    def agreement(self) -> str:
        a, b = self.stilb, self.mitsuba
        difference = a.values.mean() - b.values.mean()
        z = difference / np.hypot(a.mean_error, b.mean_error)
        return (f"stilb {a.values.mean():.5g} (rms error {100 * a.rms:.2g} %), mitsuba {b.values.mean():.5g} "
                f"({100 * b.rms:.2g} %), means differ by {100 * difference / b.values.mean():+.3f} %, z = {z:+.1f}")


def norm_of(task: Task, values: np.ndarray) -> np.ndarray:
    """Return the values that errors are divided by.

    These are the mean of a grid, each pixel (at least a tenth of the mean), or each reading.
    """
    if task.kind == "grid":
        return np.full_like(values, values.mean())
    return np.maximum(values, 0.1 * values.mean()) if task.kind == "picture" else values


def estimate(task: Task, session, seconds: float) -> Estimate:
    """PARTS runs that take about so much processor time together."""
    size = session.first_size
    while (run := session.run(size, 900)).seconds < seconds / PARTS / 6 and size < 1 << 40:
        size *= 4
    size = max(int(size * seconds / PARTS / run.seconds), 1)
    parts = np.array([session.run(size, 901 + i).values for i in range(PARTS)])
    session.close()
    values = parts.mean(axis=0)
    variance = parts.var(axis=0, ddof=1) / PARTS
    rms = np.sqrt(np.mean(variance / norm_of(task, values) ** 2))
    spread = parts.mean(axis=1).std(ddof=1) / np.sqrt(PARTS)
    # Few parts may agree by chance; the error of the mean is hardly below that of independent values.
    return Estimate(values, float(rms), float(max(spread, np.sqrt(variance.mean() / values.size))))


def fingerprint(task: Task, seconds: float) -> str:
    content = hashlib.sha256(f"{task} {seconds} {PARTS}".encode())
    for file in sorted(exported(task, "mitsuba").iterdir()):
        if file.suffix in (".xml", ".ply", ".pts", ".dat"):
            content.update(file.read_bytes())
    return content.hexdigest()[:16]


def reference(task: Task, seconds: float, threads: int) -> Reference:
    file = FOLDER / f"{task.name.replace(' ', '-')}-{fingerprint(task, seconds)}.npz"
    if not file.exists():
        both = {"stilb": estimate(task, StilbSession(task, "auto", threads), seconds),
                "mitsuba": estimate(task, MitsubaSession(task, "multijitter", "llvm_ad_rgb", threads), seconds)}
        FOLDER.mkdir(parents=True, exist_ok=True)
        np.savez(file, **{f"{name}_{key}": value for name, e in both.items() for key, value in vars(e).items()})
    stored = np.load(file)
    keys = "values", "rms", "mean_error"
    return Reference(task, *(Estimate(*(stored[f"{name}_{key}"] for key in keys)) for name in ("stilb", "mitsuba")))
