"""Differences of two runs with the same random numbers."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from . import _stilb
from ._stilb import InputError
from .estimates import Estimate, Numbers, combined
from .results import Reading, Result
from .shares import BySensor

__all__ = ["Pair", "PairedReading", "paired"]


class PairedReading:
    """The readings of a sensor in one run minus those in another, replicate by replicate."""

    def __init__(self, after: Reading, before: Reading) -> None:
        self._after = after
        self._before = before

    @property
    def name(self) -> str:
        """The sensor's name."""
        return self._after.name

    @property
    def unit(self) -> str:
        """Such as "lx"."""
        return self._after.unit

    @property
    def value(self) -> Numbers:
        """The differences of the values."""
        return self._after.value - self._before.value

    @property
    def replicates(self) -> Numbers:
        """The differences in each replicate, (R, ...)."""
        return self._after.replicates - self._before.replicates

    @property
    def standard_error(self) -> Numbers:
        """The standard errors of the differences."""
        replicates = self.replicates
        return np.asarray(replicates.std(0, ddof=1) / np.sqrt(len(replicates)))

    def interval(self) -> tuple[Numbers, Numbers]:
        """Lower and upper ends of the 95 % intervals of the differences.

        What the intervals of the readings have beyond Student's t, for rare light and for patches, is added to the side to
        which it moves the difference.
        """
        confidence = max(self._after._key.confidence, self._before._key.confidence)
        t = _stilb.statistics.student_t_quantile((1 + confidence) / 2, len(self.replicates) - 1)
        own = t * self.standard_error
        (above_after, below_after), (above_before, below_before) = (
            _margins(reading, t) for reading in (self._after, self._before))
        return (self.value - own - below_after - above_before, self.value + own + above_after + below_before)

    @cached_property
    def mean(self) -> Estimate:
        """The difference of the means."""
        return self._difference("mean")

    @cached_property
    def minimum(self) -> Estimate:
        """The difference of the smallest readings, wherever they are."""
        return self._difference("minimum")

    @cached_property
    def maximum(self) -> Estimate:
        """The difference of the largest readings, wherever they are."""
        return self._difference("maximum")

    @cached_property
    def uniformity(self) -> Estimate:
        """The difference of the uniformities."""
        return self._difference("uniformity")

    @cached_property
    def diversity(self) -> Estimate:
        """The difference of the diversities."""
        return self._difference("diversity")

    def _difference(self, statistic: str) -> Estimate:
        after: Estimate = getattr(self._after, statistic)
        before: Estimate = getattr(self._before, statistic)
        (residuals,) = before._errors.residuals.values()
        in_same_run = before._errors._replace(residuals={self._after._key: residuals})
        return combined(after.value - before.value, after.unit, [(after._errors, 1.0), (in_same_run, -1.0)])

    def __repr__(self) -> str:
        return f"<{self.name}: difference of the means {self.mean}>"


class Pair(BySensor[PairedReading]):
    """The differences of the sensors that two runs have in common, by name."""

    def _absence(self, sensor: str) -> str:
        return f"the runs have no sensor {sensor!r} in common; they have"

    def __repr__(self) -> str:
        return "\n".join(f"{name}: {reading.mean}" for name, reading in self.items())


def paired(after: Result, before: Result) -> Pair:
    """The differences of two runs, `after` minus `before`, replicate by replicate.

    Runs with the same seed take the same random numbers, so that most of their errors are the same where the scenes are
    similar: the differences are then known much better than the values, best by method="path". The scenes may differ in
    anything but the sensors that are compared.
    """
    if after.seed != before.seed:
        raise InputError(f"the runs have the seeds {after.seed} and {before.seed}, so that their errors are independent: "
                         "subtract their estimates, or give both runs the same seed.")
    if after.replicates != before.replicates:
        raise InputError(f"the runs have {after.replicates} and {before.replicates} replicates, which do not belong together. "
                         "Measure the same sensors in both, without a time limit.")
    common = [name for name in after if name in before and after[name].shape == before[name].shape
              and after[name].unit == before[name].unit]
    if not common:
        raise InputError(f"the runs have no sensor of the same name and size in common: {', '.join(after)}; "
                         f"{', '.join(before)}.")
    return Pair({name: PairedReading(after[name], before[name]) for name in common})


def _margins(reading: Reading, t: float) -> tuple[Numbers, Numbers]:
    """What the intervals have beyond Student's t, above and below."""
    low, high = reading.interval()
    width = t * reading.standard_error
    return np.maximum(0, high - reading.value - width), np.maximum(0, reading.value - low - width)
