"""Solutions: the light of a scene for all viewpoints and lamps."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import _stilb
from .progress import Progress, called
from .results import Image, Run, factors_of, warn_of

if TYPE_CHECKING:
    from .scene import Scene

__all__ = ["Solution", "load_solution"]


class Solution(Run):
    """The light on all surfaces of a scene, for each group of lights apart (docs/solution.md).

    Solutions can be pickled, with the precision of their files (about 1e-3).
    """

    _samples = "steps"

    def __init__(self, solution: _stilb.Solution, scene: Scene) -> None:
        super().__init__(solution.summary())
        self._solution = solution
        self._scene = scene

    def __copy__(self) -> Solution:
        return self

    def __deepcopy__(self, memo: dict[int, Any]) -> Solution:
        return self

    def __reduce__(self) -> tuple[Callable[..., Solution], tuple[Any, ...]]:
        return _restored, (self._scene, self._solution.state())

    @property
    def lights(self) -> list[str]:
        """The names of the lights, or groups of lights, that can be dimmed and coloured."""
        return self._solution.lights()

    def render(self, camera: str = "", *, lights: Mapping[str, float | Sequence[float]] | None = None,
               progress: Progress = None) -> Image:
        """A picture from the stored light. `lights`: a factor for each light, or three of them for red, green, blue."""
        factors = factors_of({} if lights is None else lights)
        image = called(progress, lambda sink: self._solution.render(camera, factors, sink), Image)
        warn_of(image, 3)
        return image

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes a file for `stilb render --from` and `stilb view`. It refers to the scene's file: a scene that was built
        in code has to be saved first (`Scene.save`)."""
        self._solution.save(Path(path))

    def __repr__(self) -> str:
        return f"<stilb.Solution of {self._scene.name!r}, lights: {', '.join(self.lights)}; {self._ending()}>"


def load_solution(path: str | os.PathLike[str]) -> Solution:
    """Reads a solution's file, and the scene that it refers to."""
    from .scene import Scene

    solution = _stilb.Solution.load(Path(path))
    return Solution(solution, Scene._of_file(solution.scene(), [], {}))


def _restored(scene: Scene, state: Any) -> Solution:
    return Solution(_stilb.Solution.restored(scene._scene(), state), scene)
