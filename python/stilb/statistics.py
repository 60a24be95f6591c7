"""Statistical tests of results: distances in standard errors, and their probabilities.

A z-score whose standard error comes from R replicates is a Student's t with R - 1 degrees of freedom: `equivalent_z`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Protocol

from ._stilb import statistics as _tests

__all__ = ["Chi2Result", "HasError", "chi2_test", "equivalent_z", "sidak_threshold_z", "student_t_quantile",
           "two_sided_p_of_t", "two_sided_p_of_z", "uniformity_p", "z_score"]

Chi2Result = _tests.Chi2Result


class HasError(Protocol):
    """Such as the mean of a reading."""

    value: float
    standard_error: float


def z_score(a: HasError, b: HasError | float) -> float:
    """The distance of two independent estimates, or from a value that is known exactly, in standard errors.

    Without any error: 0 if equal, else infinite.
    """
    other, error = (b, 0.0) if isinstance(b, float | int) else (b.value, b.standard_error)
    both = math.hypot(a.standard_error, error)
    if both > 0:
        return (a.value - other) / both
    return 0.0 if a.value == other else math.copysign(math.inf, a.value - other)


def two_sided_p_of_z(z: float) -> float:
    """The probability that a normal deviate is at least this far from 0."""
    return _tests.two_sided_p_of_z(z)


def two_sided_p_of_t(t: float, degrees_of_freedom: int) -> float:
    """The probability that Student's t is at least this far from 0."""
    return _tests.two_sided_p_of_t(t, degrees_of_freedom)


def equivalent_z(t: float, degrees_of_freedom: int) -> float:
    """The normal z with the same tail as this t."""
    return _tests.equivalent_z(t, degrees_of_freedom)


def student_t_quantile(probability: float, degrees_of_freedom: int) -> float:
    """The quantile of Student's t for this probability (between 0 and 1)."""
    return _tests.student_t_quantile(probability, degrees_of_freedom)


def sidak_threshold_z(family_error: float, comparisons: int) -> float:
    """The |z| that the largest of so many independent normal deviates exceeds with this probability."""
    return _tests.sidak_threshold_z(family_error, comparisons)


def chi2_test(observed: Sequence[float], expected: Sequence[float], least_expected: float = 5) -> Chi2Result:
    """Pearson's test of counts against expectations with the same total.

    Bins with expectations below `least_expected` are merged, smallest first.
    """
    return _tests.chi2_test(list(observed), list(expected), least_expected)


def uniformity_p(numbers: Sequence[float]) -> float:
    """Kolmogorov-Smirnov: the probability that numbers uniform in [0, 1] deviate from uniformity at least this much.

    For eight numbers or more.
    """
    return _tests.uniformity_p(list(numbers))
