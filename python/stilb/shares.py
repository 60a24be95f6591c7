"""Readings by a part of the light, and in other states of the lamps."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .results import Reading

__all__ = ["Readings"]


class Readings(Mapping[str, "Reading"]):
    """The readings of the sensors by a light, a group of lights or a number of reflections, or in a light scene."""

    name: str
    power_w: float | None  # of the lamps in a light scene, where it is known

    def __init__(self, name: str, readings: Mapping[str, Reading], power_w: float | None = None) -> None:
        self.name = name
        self.power_w = power_w
        self._readings = dict(readings)

    def __getitem__(self, sensor: str) -> Reading:
        if sensor not in self._readings:
            raise KeyError(f"{self.name} has no readings of a sensor {sensor!r}; it has: {', '.join(self._readings)}")
        return self._readings[sensor]

    def __iter__(self) -> Iterator[str]:
        return iter(self._readings)

    def __len__(self) -> int:
        return len(self._readings)

    def __repr__(self) -> str:
        return f"<stilb.Readings {self.name}: {', '.join(f'{sensor} {reading.mean}' for sensor, reading in self.items())}>"


class ByName(dict[str, Readings]):
    """`Readings` by their names. `absent`: what a key that is missing is told, where there are none at all."""

    def __init__(self, readings: Mapping[str, Readings], absent: str) -> None:
        super().__init__(readings)
        self._absent = absent

    def __missing__(self, name: str) -> Readings:
        raise KeyError(f"there is no {name!r}; there are: {', '.join(self)}" if self else self._absent)
