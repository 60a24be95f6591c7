"""Runs of the C++ library with their progress, and with their result where they are ended."""

from __future__ import annotations

import math
import sys
from collections.abc import Callable
from typing import Any, TypeVar

from . import _stilb
from ._stilb import Progress as ProgressReport
from ._wrong import wrong_type

Sink = Callable[[ProgressReport], Any]
Progress = bool | Sink | None

Raw = TypeVar("Raw")
Made = TypeVar("Made")


class _Line:
    """A line on stderr, which is written anew with each report."""

    def __init__(self) -> None:
        self._is_open = False

    def __call__(self, report: ProgressReport) -> None:
        text = f"{report.elapsed_s:.1f} s"
        if report.stage:
            text = f"{report.stage}, {text}"
        if math.isfinite(report.error):
            text += f", error {100 * report.error:.2g} %"
        if math.isfinite(report.remaining_s):
            text += f", {report.remaining_s:.0f} s left"
        print(f"\r{text:<60}", end="", file=sys.stderr, flush=True)
        self._is_open = True

    def end(self) -> None:
        if self._is_open:
            print(file=sys.stderr, flush=True)


def require_progress(progress: object) -> None:
    if not (progress is None or callable(progress) or isinstance(progress, bool)):
        raise wrong_type("progress", progress, "True, or a function that gets a stilb.Progress")


def called(progress: Progress, run: Callable[[Sink | None], Raw], wrap: Callable[[Raw], Made]) -> Made:
    """What `wrap` makes of the result of a run.

    Where Ctrl-C or the function of progress ends the run by an exception, this has an attribute `result`: the result so far,
    or None.
    """
    require_progress(progress)
    line = _Line() if progress is True else None
    try:
        return wrap(run(line or (None if isinstance(progress, bool) else progress)))
    except BaseException as error:
        if isinstance(getattr(error, "result", None), _stilb.Summary | _stilb.Solution):
            error.result = wrap(error.result)  # type: ignore[attr-defined]
        raise
    finally:
        if line:
            line.end()
