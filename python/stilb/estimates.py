"""Numbers with their errors, and arithmetic with them."""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Mapping
from functools import cached_property
from typing import Any, NamedTuple, cast

import numpy as np
from numpy.typing import NDArray

from . import _stilb
from ._stilb import InputError

__all__ = ["Errors", "Estimate", "ResultWarning", "RunKey"]

Numbers = NDArray[np.float64]


class ResultWarning(UserWarning):
    """A warning about a scene or its result, or that a run ended before it reached the error that was asked for."""


class RunKey(NamedTuple):
    """A run, as far as the errors of its numbers are concerned."""

    token: str
    seed: int
    confidence: float  # nominal, of its intervals


class Margin(NamedTuple):
    """What an interval has beyond Student's t: for rare light, the error of patches, and the selection of a minimum."""

    slope: float
    below: float
    above: float


class Errors(NamedTuple):
    """What the error of a number consists of."""

    residuals: Mapping[RunKey, Numbers]  # by how much the replicates of each run differ from the value, to first order
    margins: Mapping[tuple[str, str], Margin]  # of each number of a run that it was computed from

    @classmethod
    def of_statistic(cls, estimate: _stilb.Estimate, key: RunKey, name: str, residuals: Numbers) -> Errors:
        """Of a number of a run with this name."""
        own = {key: residuals}
        half_width = _half_width(own, key.confidence)
        margin = Margin(1.0, max(0.0, estimate.value - estimate.lower - half_width),
                        max(0.0, estimate.upper - estimate.value - half_width))
        return cls(own, {(key.token, name): margin})


class Estimate:
    """A number with its standard error and its 95 % interval.

    Estimates of runs add, subtract, multiply and divide, with one another and with numbers, and the results are estimates.
    Errors of one result are correlated, which the replicates tell. Results with different seeds are independent. The errors
    of two results with the same seed are correlated in ways that differ from sensor to sensor: `stilb.paired` has their
    difference, and arithmetic refuses them.

    `format(estimate, ".1f")` formats the value alone.
    """

    value: float
    standard_error: float
    interval: tuple[float, float]
    unit: str

    def __init__(self, value: float, standard_error: float, interval: tuple[float, float], unit: str,
                 errors: Callable[[], Errors]) -> None:
        self.value = value
        self.standard_error = standard_error
        self.interval = interval
        self.unit = unit
        self._make_errors = errors

    def __float__(self) -> float:
        return self.value

    def __format__(self, spec: str) -> str:
        return format(self.value, spec) if spec else repr(self)

    def __repr__(self) -> str:
        low, high = self.interval
        return f"{with_error(self.value, (high - low) / 2)} {self.unit}".rstrip()

    def __reduce__(self) -> tuple[Any, ...]:
        return _restored, (self.value, self.standard_error, self.interval, self.unit, self._errors)

    @cached_property
    def _errors(self) -> Errors:
        return self._make_errors()

    def __neg__(self) -> Estimate:
        return combined(-self.value, self.unit, [(self._errors, -1.0)])

    def __add__(self, other: Estimate | float) -> Estimate:
        return cast(Estimate, _calculated(operator.add, self, other))

    def __radd__(self, other: Estimate | float) -> Estimate:
        return cast(Estimate, _calculated(operator.add, other, self))

    def __sub__(self, other: Estimate | float) -> Estimate:
        return cast(Estimate, _calculated(operator.sub, self, other))

    def __rsub__(self, other: Estimate | float) -> Estimate:
        return cast(Estimate, _calculated(operator.sub, other, self))

    def __mul__(self, other: Estimate | float) -> Estimate:
        return cast(Estimate, _calculated(operator.mul, self, other))

    def __rmul__(self, other: Estimate | float) -> Estimate:
        return cast(Estimate, _calculated(operator.mul, other, self))

    def __truediv__(self, other: Estimate | float) -> Estimate:
        return cast(Estimate, _calculated(operator.truediv, self, other))

    def __rtruediv__(self, other: Estimate | float) -> Estimate:
        return cast(Estimate, _calculated(operator.truediv, other, self))


def _restored(value: float, standard_error: float, interval: tuple[float, float], unit: str, errors: Errors) -> Estimate:
    return Estimate(value, standard_error, interval, unit, lambda: errors)


def combined(value: float, unit: str, operands: list[tuple[Errors, float]]) -> Estimate:
    """A function of numbers with this value and these slopes, by the delta method as for sensors of type "derived":
    docs/statistics.md."""
    residuals: dict[RunKey, Numbers] = {}
    margins: dict[tuple[str, str], Margin] = {}
    for errors, slope in operands:
        for key, differences in errors.residuals.items():
            _require_known_correlation(key, residuals)
            residuals[key] = residuals.get(key, 0.0) + slope * differences
        for source, margin in errors.margins.items():
            before = margins[source].slope if source in margins else 0.0
            margins[source] = margin._replace(slope=before + slope * margin.slope)
    half_width = _half_width(residuals, max(key.confidence for key in residuals))
    below = half_width + sum(abs(m.slope) * (m.below if m.slope > 0 else m.above) for m in margins.values())
    above = half_width + sum(abs(m.slope) * (m.above if m.slope > 0 else m.below) for m in margins.values())
    return Estimate(value, _standard_error(residuals), (value - below, value + above), unit,
                    lambda: Errors(residuals, margins))


def _calculated(operation: Callable[[float, float], float], left: Any, right: Any) -> Any:
    """`left` or `right` may be a number."""
    if not all(isinstance(operand, Estimate | int | float | np.number) for operand in (left, right)):
        return NotImplemented
    a, b = float(left), float(right)
    value = operation(a, b)
    if operation is operator.mul:
        slopes = (b, a)
    elif operation is operator.truediv:
        slopes = (1 / b, -value / b)
    else:
        slopes = (1.0, 1.0 if operation is operator.add else -1.0)
    operands = [(operand._errors, slope) for operand, slope in zip((left, right), slopes, strict=True)
                if isinstance(operand, Estimate)]
    return combined(value, _unit(operation, left, right), operands)


def _unit(operation: Callable[[float, float], float], left: Any, right: Any) -> str:
    if operation in (operator.add, operator.sub):
        units = {operand.unit for operand in (left, right) if isinstance(operand, Estimate)}
        if len(units) > 1:
            raise InputError(f"{left} and {right} have different units, and no sum.")
        return units.pop()
    first, second = (operand.unit if isinstance(operand, Estimate) else "" for operand in (left, right))
    if operation is operator.mul:
        return f"{first} {second}".strip()
    if not second:
        return first
    return "" if first == second else f"{first or 1}/({second})"


def _require_known_correlation(key: RunKey, others: Mapping[RunKey, Numbers]) -> None:
    if any(key.seed == other.seed and key.token != other.token for other in others):
        raise InputError(f"these numbers come from two runs with the same seed ({key.seed}), so that their errors are "
                         "correlated. Use stilb.paired(after, before) for differences, or another seed for one of the runs.")


def _standard_error(residuals: Mapping[RunKey, Numbers]) -> float:
    return math.sqrt(sum(_variance(differences) for differences in residuals.values()))


def _variance(differences: Numbers) -> float:
    """Of the mean of the replicates."""
    return float(differences @ differences) / (len(differences) * (len(differences) - 1))


def _half_width(residuals: Mapping[RunKey, Numbers], confidence: float) -> float:
    """Student's t; of several runs with the degrees of freedom by Welch and Satterthwaite."""
    variances = [_variance(differences) for differences in residuals.values()]
    whole = sum(variances)
    if not whole > 0:
        return whole  # 0 or not a number
    spread = sum(variance**2 / (len(differences) - 1)
                 for variance, differences in zip(variances, residuals.values(), strict=True))
    degrees = max(1, math.floor(whole**2 / spread * (1 + 1e-9)))
    return _stilb.statistics.student_t_quantile((1 + confidence) / 2, degrees) * math.sqrt(whole)


def with_error(value: float, half_width: float) -> str:
    """The value with as many digits as two digits of its error have: 494.3 ± 1.1."""
    if not np.isfinite(half_width) or half_width <= 0 or not np.isfinite(value):
        return f"{value:.6g}"
    digits = 1 - int(np.floor(np.log10(half_width)))
    if digits < 0:
        value, half_width, digits = round(value, digits), round(half_width, digits), 0
    return f"{value:.{digits}f} ± {half_width:.{digits}f}"
