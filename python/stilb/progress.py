"""The progress of runs."""

from __future__ import annotations

import math
import sys
from collections.abc import Callable
from typing import Any

from ._stilb import Progress as ProgressReport

Progress = bool | Callable[[ProgressReport], Any] | None


def sink_of(progress: Progress) -> Callable[[ProgressReport], Any] | None:
    """The function that a run calls with its progress."""
    if progress is True:
        return _print
    return progress or None


def _print(report: ProgressReport) -> None:
    text = f"{report.elapsed_s:.1f} s"
    if report.stage:
        text = f"{report.stage}, {text}"
    if math.isfinite(report.error):
        text += f", error {100 * report.error:.2g} %"
    if math.isfinite(report.remaining_s):
        text += f", {report.remaining_s:.0f} s left"
    print(f"\r{text:<60}", end="", file=sys.stderr, flush=True)
