"""Numbers with their errors, and arithmetic with them."""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Mapping
from functools import cached_property
from typing import Any, NamedTuple, NoReturn, TypeVar, cast

import numpy as np
from numpy.typing import NDArray

from . import _stilb
from ._stilb import InputError

__all__ = ["Errors", "Estimate", "Interval", "ResultWarning", "RunKey"]

Numbers = NDArray[np.float64]
End = TypeVar("End")  # a number, or an array


class ResultWarning(UserWarning):
    """A warning about a scene or its result, or that a run ended before it reached the error that was asked for."""


class RunKey(NamedTuple):
    """A run, as far as the errors of its numbers are concerned."""

    token: str
    seeds: tuple[int, ...]
    confidence: float  # nominal, of its intervals


class Margin(NamedTuple):
    """What an interval has beyond Student's t: for rare light, the error of patches, and the selection of a minimum."""

    slope: float
    below: float
    above: float
    is_of_rare_light: bool  # above, and alone


class Errors(NamedTuple):
    """What the error of a number consists of."""

    residuals: Mapping[RunKey, Numbers]  # by how much the replicates of each run differ from the value, to first order
    margins: Mapping[tuple[str, str], Margin]  # of each number of a run that it was computed from

    @classmethod
    def of_statistic(cls, estimate: _stilb.Estimate, key: RunKey, name: str, residuals: Numbers, *,
                     has_rare_light_alone: bool) -> Errors:
        """The errors of the number of a run that has this name. `has_rare_light_alone`: whether rare light alone makes its
        upper half-width larger than Student's t does."""
        own = {key: residuals}
        half_width = _half_width(own, key.confidence)
        margin = Margin(1.0, max(0.0, estimate.value - estimate.lower - half_width),
                        max(0.0, estimate.upper - estimate.value - half_width), has_rare_light_alone)
        return cls(own, {(key.token, name): margin})


class Interval(tuple[End, End]):
    """The lower and the upper end of a 95 % interval: `low, high = desk.mean.interval`. With another confidence, which is
    given as to a function, it is wider or narrower by the ratio of Student's t: `desk.mean.interval(0.99)`."""

    _value: Any
    _degrees: Callable[[], int]

    @classmethod
    def of(cls, low: End, high: End, value: End, degrees: Callable[[], int]) -> Interval[End]:
        """`degrees`: of freedom of Student's t."""
        made = cls((low, high))
        made._value, made._degrees = value, degrees
        return made

    def __call__(self, confidence: float = 0.95) -> tuple[End, End]:
        if confidence == 0.95:
            return self
        factor = _width_ratio(confidence, self._degrees())
        low, high = self
        return self._value - factor * (self._value - low), self._value + factor * (high - self._value)

    def __reduce__(self) -> tuple[Any, ...]:
        return tuple, (tuple(self),)


def _width_ratio(confidence: float, degrees: int) -> float:
    """The width of an interval of this confidence over that of a 95 % interval."""
    if not isinstance(confidence, float | int | np.floating) or not 0 < confidence < 1:
        raise InputError(f"confidence {confidence}: expected a probability between 0 and 1, such as 0.95.")
    if degrees < 1:
        return float("nan")
    own, usual = (_stilb.statistics.student_t_quantile((1 + level) / 2, degrees) for level in (confidence, 0.95))
    return own / usual


class Estimate:
    """A number with its standard error and its 95 % interval.

    Estimates of runs add, subtract, multiply and divide, with one another and with numbers, and the results are estimates.
    Errors of one result are correlated, which the replicates tell. Results with different seeds are independent. The errors
    of two results with the same seed are correlated in ways that differ from sensor to sensor: `stilb.paired` has their
    difference, and arithmetic refuses them.

    `low, high = estimate.interval`, and `estimate.interval(0.99)` has another confidence. `format(estimate, ".1f")` formats
    the value alone. Estimates have no order, no absolute value and are not rounded: `estimate.value` does and is.
    """

    value: float
    standard_error: float
    interval: Interval[float]
    unit: str

    def __init__(self, value: float, standard_error: float, interval: tuple[float, float], unit: str,
                 errors: Callable[[], Errors]) -> None:
        self.value = value
        self.standard_error = standard_error
        self.interval = Interval.of(*interval, value, lambda: _degrees(errors().residuals))
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

    def _has_no_order(self, other: object) -> NoReturn:
        raise TypeError("estimates have intervals, and no order. Compare their values (estimate.value), the ends of their "
                        "intervals (low, high = estimate.interval), or ask whether 0 lies in the interval of their difference.")

    __lt__ = __le__ = __gt__ = __ge__ = _has_no_order

    def __abs__(self) -> NoReturn:
        raise TypeError("an absolute value has no interval that is known from that of the estimate, as it is never below 0. "
                        "Take that of the value: abs(estimate.value).")

    def __round__(self, digits: int | None = None) -> NoReturn:
        raise TypeError('estimates are not rounded, as their intervals would no longer hold. Round the value, '
                        'round(estimate.value, 1), or format it, f"{estimate:.1f}".')


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
    low, high = value - half_width - _beyond(margins, -1.0), value + half_width + _beyond(margins, 1.0)
    return Estimate(value, _standard_error(residuals), (low, high), unit, lambda: Errors(residuals, margins))


def _beyond(margins: Mapping[tuple[str, str], Margin], side: float) -> float:
    """By how much all margins widen the upper side of an interval (1.0) or the lower one (-1.0).

    The errors of patches and of selections are biases, which add up. Independent runs miss rare light independently: its
    margins add up within each run, and in quadrature over the runs. A mean of runs is then never surer than the run that they
    are when they are merged: docs/statistics.md.
    """
    biases, rare = 0.0, dict[str, float]()
    for (token, _), margin in margins.items():
        is_above = margin.slope * side > 0
        own = abs(margin.slope) * (margin.above if is_above else margin.below)
        if margin.is_of_rare_light and is_above:
            rare[token] = rare.get(token, 0.0) + own
        else:
            biases += own
    return biases + math.hypot(*rare.values())


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
    for other in others:
        common = sorted({*key.seeds} & {*other.seeds})
        if key.token == other.token or not common:
            continue
        way_out = ("Use stilb.paired(after, before) for differences, or another seed for one of the runs."
                   if {*key.seeds} == {*other.seeds} else "Take runs without a common seed.")
        raise InputError(f"these numbers come from two runs with the same seed ({', '.join(map(str, common))}), so that their "
                         f"errors are correlated. {way_out}")


def _standard_error(residuals: Mapping[RunKey, Numbers]) -> float:
    return math.sqrt(sum(_variance(differences) for differences in residuals.values()))


def _variance(differences: Numbers) -> float:
    """Of the mean of the replicates."""
    return float(differences @ differences) / (len(differences) * (len(differences) - 1))


def _half_width(residuals: Mapping[RunKey, Numbers], confidence: float) -> float:
    """Student's t."""
    whole = sum(_variance(differences) for differences in residuals.values())
    if not whole > 0:
        return whole  # 0 or not a number
    return _stilb.statistics.student_t_quantile((1 + confidence) / 2, _degrees(residuals)) * math.sqrt(whole)


def _degrees(residuals: Mapping[RunKey, Numbers]) -> int:
    """The degrees of freedom; those of several runs by Welch and Satterthwaite."""
    runs = [(_variance(differences), len(differences) - 1) for differences in residuals.values()]
    spread = sum(variance**2 / degrees for variance, degrees in runs)
    if not spread > 0:
        return min(degrees for _, degrees in runs)
    return max(1, math.floor(sum(variance for variance, _ in runs) ** 2 / spread * (1 + 1e-9)))


def with_error(value: float, half_width: float) -> str:
    """The value with as many digits as two digits of its error have: 494.3 ± 1.1."""
    if not np.isfinite(half_width) or half_width <= 0 or not np.isfinite(value):
        return f"{value:.6g}"
    digits = 1 - int(np.floor(np.log10(half_width)))
    if digits < 0:
        value, half_width, digits = round(value, digits), round(half_width, digits), 0
    return f"{value:.{digits}f} ± {half_width:.{digits}f}"
