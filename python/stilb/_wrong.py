"""Error messages for arguments of a wrong type."""

from __future__ import annotations

from collections.abc import Iterable
from typing import cast

from ._stilb import InputError


def wrong_type(what: str, value: object, allowed: str) -> InputError:
    """`what`: the argument, or the place of the value."""
    return InputError(f"{what}: found a value of type {type(value).__name__}. Allowed: {allowed}.")


def names_of(what: str, names: object, known: Iterable[str]) -> list[str]:
    """A list of names, or one name. `known`: for the message."""
    given: list[object] = list(names) if isinstance(names, Iterable) and not isinstance(names, str) else [names]
    for name in given:
        if not isinstance(name, str):
            raise wrong_type(what, name, f"names of sensors ({', '.join(known)})")
    return cast(list[str], given)


def require_scene(scene: object) -> None:
    from .scene import Scene

    if not isinstance(scene, Scene):
        raise wrong_type("scene", scene, 'a scene, such as stilb.load("room.toml")')
