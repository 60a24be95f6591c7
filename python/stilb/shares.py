"""Readings by a part of the light, and in other states of the lamps."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, TypeVar

if TYPE_CHECKING:
    from .results import Reading

__all__ = ["Readings"]

R = TypeVar("R")


class BySensor(Mapping[str, R]):
    """Something of each sensor, by its name."""

    def __init__(self, by_sensor: Mapping[str, R]) -> None:
        self._by_sensor = dict(by_sensor)

    def _absence(self, sensor: str) -> str:
        """What is said of a sensor that is missing, before those that are there."""
        raise NotImplementedError

    def __getitem__(self, sensor: str) -> R:
        if sensor not in self._by_sensor:
            raise KeyError(f"{self._absence(sensor)}: {', '.join(self._by_sensor)}")
        return self._by_sensor[sensor]

    def __iter__(self) -> Iterator[str]:
        return iter(self._by_sensor)

    def __len__(self) -> int:
        return len(self._by_sensor)


class Readings(BySensor["Reading"]):
    """The readings of the sensors by a light, a group of lights or a number of reflections, or in a light scene."""

    name: str
    power_w: float | None  # of the lamps in a light scene, where it is known

    def __init__(self, name: str, readings: Mapping[str, Reading], power_w: float | None = None) -> None:
        super().__init__(readings)
        self.name = name
        self.power_w = power_w

    def _absence(self, sensor: str) -> str:
        return f"{self.name} has no readings of a sensor {sensor!r}; it has"

    def __repr__(self) -> str:
        return f"<stilb.Readings {self.name}: {', '.join(f'{sensor} {reading.mean}' for sensor, reading in self.items())}>"


class ByName(dict[str, Readings]):
    """`Readings` by their names. `absent`: what a key that is missing is told, where there are none at all."""

    def __init__(self, readings: Mapping[str, Readings], absent: str) -> None:
        super().__init__(readings)
        self._absent = absent

    def __missing__(self, name: str) -> Readings:
        raise KeyError(f"there is no {name!r}; there are: {', '.join(self)}" if self else self._absent)
