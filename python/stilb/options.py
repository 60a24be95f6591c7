"""The options of runs, as the C++ library describes them. python/make_stubs.py writes their types."""

from __future__ import annotations

import textwrap
from typing import Any, TypedDict

from . import _stilb

__all__ = ["DESCRIPTION", "Limits", "options"]

MEANINGS = {key: meaning for key, _, meaning in _stilb.described_options()}
DESCRIPTION = "\n".join(
    textwrap.fill(meaning, 124, initial_indent=f"    {key:9} ", subsequent_indent=14 * " ")
    for key, meaning in MEANINGS.items())

Limits = TypedDict("Limits", {key: Any for key in MEANINGS}, total=False)  # type: ignore[misc]


def options(scene: _stilb.Scene, limits: Limits) -> _stilb.Options:
    """The options of the scene's section `run`, with these instead where they are given, as on the command line."""
    given = {name: value for name, value in limits.items() if value is not None}
    unknown = given.keys() - MEANINGS
    if unknown:
        raise TypeError(f"unknown argument {min(unknown)}; allowed: {', '.join(MEANINGS)}")
    chosen = scene.options()
    if "paths" in given:
        chosen.error = chosen.time = None
    for name, value in given.items():
        setattr(chosen, name, value)
    return chosen
