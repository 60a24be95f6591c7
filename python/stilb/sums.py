"""The sums of runs, with what makes results of them."""

from __future__ import annotations

import copy
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from . import _stilb
from .options import Limits, options
from .results import Result

if TYPE_CHECKING:
    from .scene import Scene

__all__ = ["Sums"]


class Sums:
    """What a run has so far. Its scene is not changed by anyone else."""

    def __init__(self, scene: Scene, sensors: list[str], limits: Limits, state: _stilb.RunState | None = None) -> None:
        self.scene = scene
        self.sensors = sensors
        self.limits = limits
        self.state = state if state is not None else _stilb.RunState()
        self._built: _stilb.Scene | None = None

    def built(self) -> _stilb.Scene:
        """The scene in C++. It takes another form where its file is there no longer, which the state has to know."""
        built = self.scene._scene()
        if self._built is not None and built is not self._built and self.state.has_begun():
            self.state.adopt(built, options(built, self.limits), self.sensors)
        self._built = built
        return built

    def options(self) -> _stilb.Options:
        return options(self.built(), self.limits)

    def result(self, factors: Mapping[str, tuple[float, float, float]] | None = None) -> Result:
        """Of the samples so far, with the lamps dimmed by these factors."""
        made = _stilb.result_of(self.built(), self.state, self.options(), self.sensors, dict(factors or {}))
        return Result(made, seeds=self.seeds(), is_dimmed=True) if factors else self.wrapped(made)

    def wrapped(self, result: _stilb.Result) -> Result:
        """The result keeps a copy of the sums where it can be dimmed."""
        is_apart = self.options().by == "light" or bool(result.light_scenes)
        return Result(result, sums=self.adopted_by(copy.copy(self.scene)) if is_apart else None, seeds=self.seeds())

    def seeds(self) -> tuple[int, ...]:
        """Whose samples these are."""
        return tuple(self.state.seeds()) if self.state.has_begun() else (self.options().seed,)

    def copy(self) -> Sums:
        return Sums(self.scene, self.sensors, self.limits, self.state.copy())

    def adopted_by(self, scene: Scene) -> Sums:
        """The same run of a scene that is the same in another form, such as that of its file."""
        own = Sums(scene, self.sensors, self.limits, self.state.copy())
        if own.state.has_begun():
            own.state.adopt(own.built(), own.options(), own.sensors)
        return own

    def __deepcopy__(self, memo: dict[int, Any]) -> Sums:
        return self.copy()

    def __getstate__(self) -> dict[str, Any]:
        return {**self.__dict__, "state": self.state.bytes() if self.state.has_begun() else None, "_built": None}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        self.state = _stilb.RunState()
        if state["state"] is not None:
            self.state = _stilb.RunState.read(state["state"], "pickled run")
            self.state.adopt(self.built(), self.options(), self.sensors)  # it may have been that of a file
