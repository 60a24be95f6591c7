"""Differences of two runs with the same random numbers."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from . import _stilb
from ._stilb import InputError
from ._wrong import wrong_type
from .estimates import Errors, Estimate, Interval, Numbers, combined
from .results import Reading, Result
from .shares import BySensor
from .values import Values

__all__ = ["Pair", "PairedReading", "difference", "paired"]


class PairedReading(Values):
    """The readings of a sensor in one run minus those in another, replicate by replicate.

    Intervals are Student's t over the differences of the replicates, as those of `stilb measure --vary`. What intervals of
    readings have beyond this, for rare light and for patches, concerns both runs alike, and is left out.
    """

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

    @property
    def interval(self) -> Interval[Numbers]:
        """Lower and upper ends of the 95 % intervals of the differences: `low, high = reading.interval`."""
        degrees = len(self.replicates) - 1
        confidence = max(self._after._key.confidence, self._before._key.confidence)
        half_width = _stilb.statistics.student_t_quantile((1 + confidence) / 2, degrees) * self.standard_error
        return Interval.of(self.value - half_width, self.value + half_width, self.value, lambda: degrees)

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
        return difference(self._after, self._before, statistic)

    def __repr__(self) -> str:
        return f"<{self.name}: difference of the means {self.mean}>"


class Pair(BySensor[PairedReading]):
    """The differences of the sensors that two runs have in common, by name."""

    def _absence(self, sensor: str) -> str:
        return f"the runs have no sensor {sensor!r} in common; they have"

    def __repr__(self) -> str:
        return "\n".join(f"{name}: {reading.mean}" for name, reading in self.items())


def difference(after: Reading, before: Reading, statistic: str) -> Estimate:
    """The difference of a statistic, with the error of the differences of its replicates."""
    a, b = (getattr(reading, statistic) for reading in (after, before))
    (own,), (other,) = (estimate._errors.residuals.values() for estimate in (a, b))
    key = after._key._replace(confidence=max(after._key.confidence, before._key.confidence))
    return combined(a.value - b.value, a.unit, [(Errors({key: own - other}, {}), 1.0)])


def paired(after: Result, before: Result) -> Pair:
    """The differences of two runs, `after` minus `before`, replicate by replicate.

    Runs with the same seed take the same random numbers, so that most of their errors are the same where the scenes are
    similar: the differences are then known much better than the values, best by method="path". The scenes may differ in
    anything but the sensors that are compared.
    """
    for name, result in (("after", after), ("before", before)):
        if not isinstance(result, Result):
            raise wrong_type(name, result, 'results of scene.measure(), as in stilb.paired(after, before)["desk"]')
    _require_same_seeds(after.seeds, before.seeds)
    if after.replicates != before.replicates:
        raise InputError(f"the runs have {after.replicates} and {before.replicates} replicates, which do not belong together. "
                         "Measure the same sensors in both, without a time limit.")
    common = [name for name in after if name in before and after[name].shape == before[name].shape
              and after[name].unit == before[name].unit]
    if not common:
        raise InputError(f"the runs have no sensor of the same name and size in common: {', '.join(after)}; "
                         f"{', '.join(before)}.")
    return Pair({name: PairedReading(after[name], before[name]) for name in common})


def _require_same_seeds(after: tuple[int, ...], before: tuple[int, ...]) -> None:
    if {*after} == {*before}:
        return
    one, other = (str(*seeds) if len(seeds) == 1 else str(seeds) for seeds in (after, before))
    if {*after} & {*before}:
        raise InputError(f"the runs have the seeds {one} and {other}, so that their errors are partly the same. Merge runs with "
                         "the same seeds for both.")
    raise InputError(f"the runs have the seeds {one} and {other}, so that their errors are independent: subtract their "
                     "estimates, or give both runs the same seed.")
