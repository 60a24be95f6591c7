"""Readings as arrays of their values."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy as np
from numpy.typing import DTypeLike, NDArray

from .estimates import Numbers

__all__ = ["Values"]


class Values:
    """Something with values, which NumPy and indices take for them."""

    @property
    def value(self) -> Numbers:
        """The values."""
        raise NotImplementedError

    @property
    def shape(self) -> tuple[int, ...]:
        """The shape of the values."""
        return self.value.shape

    @property
    def size(self) -> int:
        """The number of readings."""
        return self.value.size

    def __len__(self) -> int:
        return len(self.value)

    def __getitem__(self, index: Any) -> Any:
        return self.value[index]

    def __array__(self, dtype: DTypeLike | None = None, copy: bool | None = None) -> NDArray[Any]:
        return np.array(self.value, dtype) if copy else np.asarray(self.value, dtype)

    def __array_function__(self, function: Callable[..., Any], types: Iterable[type], arguments: tuple[Any, ...],
                           named: Mapping[str, Any]) -> Any:
        """NumPy's functions have the values: without this, np.mean() would call the estimate `mean`."""
        return function(*map(_values, arguments), **{name: _values(argument) for name, argument in named.items()})


def _values(argument: Any) -> Any:
    """The argument with values in place of readings, also in lists."""
    if isinstance(argument, Values):
        return argument.value
    return type(argument)(map(_values, argument)) if type(argument) in (list, tuple) else argument
