"""Solutions: the light of a scene for all viewpoints and lamps."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import Path

from . import _stilb
from .progress import Progress, sink_of
from .results import Image, Run

__all__ = ["Solution", "load_solution"]


class Solution(Run):
    """The light on all surfaces of a scene, for each group of lights apart (docs/solution.md)."""

    def __init__(self, solution: _stilb.Solution) -> None:
        super().__init__(solution.summary())
        self._solution = solution

    @property
    def lights(self) -> list[str]:
        """The names of the lights, or groups of lights, that can be dimmed and coloured."""
        return self._solution.lights()

    def render(self, camera: str = "", *, lights: Mapping[str, float | Sequence[float]] | None = None,
               progress: Progress = None) -> Image:
        """A picture from the stored light. `lights`: a factor for each light, or three of them for red, green, blue."""
        factors = {name: _bands(factor) for name, factor in (lights or {}).items()}
        return Image(self._solution.render(camera, factors, sink_of(progress)))

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes a file for `stilb render --from` and `stilb view`. It refers to the scene's file: a scene that was built
        in code has to be saved first (`Scene.save`)."""
        self._solution.save(Path(path))


def load_solution(path: str | os.PathLike[str]) -> Solution:
    """Reads a solution's file, and the scene that it refers to."""
    return Solution(_stilb.Solution.load(Path(path)))


def _bands(factor: float | Sequence[float]) -> tuple[float, float, float]:
    red, green, blue = factor if isinstance(factor, Sequence) else (factor, factor, factor)
    return (float(red), float(green), float(blue))
