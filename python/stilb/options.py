"""The options of runs, as the C++ library describes them. python/make_stubs.py writes their types."""

from __future__ import annotations

import textwrap
from typing import Any, TypedDict

from . import _stilb
from ._stilb import InputError

__all__ = ["DESCRIPTION", "Limits", "SightLimits", "options"]

DESCRIBED = {key: described for key, *described in _stilb.described_options()}
MEANINGS = {key: meaning for key, (_, meaning, _) in DESCRIBED.items()}
DESCRIPTION = "\n".join(
    textwrap.fill(meaning, 124, initial_indent=f"    {key:10}  ", subsequent_indent=16 * " ")
    for key, meaning in MEANINGS.items())

# `Scene.luminance` has directions of its own: those of patches are in the section `run` there.
SightLimits = TypedDict("SightLimits", {key: Any for key in MEANINGS if key != "directions"}, total=False)  # type: ignore[misc]


class Limits(SightLimits, total=False):
    directions: str | None




def options(scene: _stilb.Scene, limits: SightLimits) -> _stilb.Options:
    """The options of the scene's section `run`, with these instead where they are given, as on the command line."""
    given = {name: value for name, value in limits.items() if value is not None}
    unknown = given.keys() - MEANINGS
    if unknown:
        raise TypeError(f"unknown argument {min(unknown)}; allowed: {', '.join(MEANINGS)}")
    chosen = scene.options()
    if "paths" in given:
        chosen.error = chosen.time = None
    for name, value in given.items():
        _set(chosen, name, value)
    return chosen


def _set(options: _stilb.Options, name: str, value: Any) -> None:
    kind, _, allowed = DESCRIBED[name]
    if kind == "int" and isinstance(value, float) and value.is_integer():
        value = int(value)  # 1e6, as in scene files
    try:
        setattr(options, name, value)
    except TypeError:
        raise InputError(f"{name}: {value!r} is not allowed. Allowed: {allowed}.") from None
