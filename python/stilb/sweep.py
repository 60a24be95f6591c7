"""Variants of a scene, with their differences from the first one (docs/runs.md)."""

from __future__ import annotations

import builtins
import copy
import itertools
import math
import warnings
from collections.abc import Iterable, Iterator, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from typing import TYPE_CHECKING, Any, Unpack, cast

from ._stilb import InputError
from ._wrong import names_of, require_scene, wrong_type
from .estimates import Errors, Estimate, ResultWarning
from .options import Limits, options
from .pairs import difference
from .results import Reading, Result

if TYPE_CHECKING:
    import pandas

    from .scene import Scene

__all__ = ["sweep"]

STATISTICS = ("mean", "minimum", "maximum", "uniformity", "diversity")
UNKNOWN = Estimate(math.nan, math.nan, (math.nan, math.nan), "", lambda: Errors({}, {}))


def sweep(scene: Scene, variations: Mapping[str, Sequence[Any]], *, zip: bool = False, processes: int = 1,
          sensors: Iterable[str] | None = None, **limits: Unpack[Limits]) -> pandas.DataFrame:
    """Measures a variant of the scene for each value of a key, or for all combinations of the values of several keys.

        table = stilb.sweep(scene, {"materials.wall.reflectance": [0.3, 0.5, 0.7]}, processes=2)

    The table is that of `stilb measure --vary` (docs/runs.md): a row for each statistic of each sensor in each variant, with
    the values of the keys, the value with its standard error and interval, and its difference from the first variant. All
    variants have the same random numbers, so that most of the errors cancel in differences. `limits` are those of the first
    variant; the others have as many samples. Method "auto" is "path" here, by which differences are known best.

    zip        take the first values of all keys together, then the second ones ...
    processes  so many processes share the variants after the first one
    by         "light" or "bounce": a column `share` names the light or the number of reflections, and each has rows of its own
               below those of the whole, where `share` is empty

    Needs pandas.
    """
    from .tables import needed

    pandas = needed("pandas")
    _require_kinds(scene, variations, processes)
    variants = list(_variants(variations, zip))
    names = None if sensors is None else names_of("sensors", sensors, scene.sensors)
    asked: dict[str, Any] = dict(limits)
    scenes = [_variant(scene, variant) for variant in variants]
    if options(scenes[0]._scene(), limits).method == "auto":
        asked["method"] = "path"
    first = _measured(scenes[0], names, asked)
    others = {key: value for key, value in asked.items() if key not in ("error", "time")}
    others |= {"method": first.technique, "paths": first.paths}
    results = [first, *_all_measured(scenes[1:], names, others, processes)]
    rows = [row for variant, result in builtins.zip(variants, results, strict=True)
            for row in _rows(variant, result, first)]
    return pandas.DataFrame(rows)


def _require_kinds(scene: object, variations: object, processes: object) -> None:
    require_scene(scene)
    if not isinstance(variations, Mapping):
        raise wrong_type("variations", variations, 'keys with lists of values, such as {"materials.wall.reflectance": [0.3, 0.5]}')
    for key, values in variations.items():
        if isinstance(values, str | bytes | Mapping) or not isinstance(values, Iterable) or getattr(values, "ndim", 1) == 0:
            raise InputError(f"variations: {key} has the value {values!r}. Allowed: a list of values, such as [{values!r}].")
    if not isinstance(processes, int) or processes < 1:
        raise InputError(f"processes: {processes!r} is not allowed. Allowed: a whole number from 1.")


def _variants(variations: Mapping[str, Sequence[Any]], zips: bool) -> Iterator[dict[str, Any]]:
    """The values of the keys. Of combinations the last key changes first."""
    values = [list(own) for own in variations.values()]
    if not values or not all(values):
        raise InputError('variations: there is no key, or one without values. Allowed: such as '
                         '{"materials.wall.reflectance": [0.3, 0.5]}.')
    if zips and len({len(own) for own in values}) > 1:
        counts = ", ".join(f"{key} has {len(own)}" for key, own in variations.items())
        raise InputError(f"zip: the keys have different numbers of values ({counts}). Give each key as many.")
    for variant in builtins.zip(*values, strict=True) if zips else itertools.product(*values):
        yield dict(builtins.zip(variations, variant, strict=True))


def _variant(scene: Scene, values: Mapping[str, Any]) -> Scene:
    variant = copy.copy(scene)
    for key, value in values.items():
        variant.set(key, value)
    return variant


def _measured(scene: Scene, sensors: list[str] | None, limits: Mapping[str, Any]) -> Result:
    """Warnings are in the table."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ResultWarning)
        return scene.measure(sensors=sensors, **cast(Limits, limits))


def _all_measured(scenes: list[Scene], sensors: list[str] | None, limits: Mapping[str, Any],
                  processes: int) -> Iterator[Result]:
    if processes <= 1 or not scenes:
        yield from (_measured(scene, sensors, limits) for scene in scenes)
        return
    # Processes that are forked would have the locks of threads that are not there.
    with ProcessPoolExecutor(min(processes, len(scenes)), mp_context=get_context("spawn")) as workers:
        yield from workers.map(_measured, scenes, itertools.repeat(sensors), itertools.repeat(limits))


def _rows(variant: Mapping[str, Any], result: Result, first: Result) -> Iterator[dict[str, Any]]:
    of_first = _shares(first)
    for share, readings in _shares(result).items():
        of_share = {"share": share} if result.shares else {}
        for name, reading in readings.items():
            for statistic in _statistics(reading):
                yield {**variant, "sensor": name, **of_share, **_numbers(reading, of_first.get(share, {}).get(name), statistic),
                       "converged": result.converged, "warnings": " ".join(result.warnings)}


def _shares(result: Result) -> dict[str, Mapping[str, Reading]]:
    """The readings by all light, and by each part of it."""
    return {"": result, **result.shares}


def _numbers(reading: Reading, before: Reading | None, statistic: str) -> dict[str, Any]:
    """`before`: the same in the first variant; None where that has no such reading."""
    value: Estimate = getattr(reading, statistic)
    is_paired = before is not None and before.replicates.shape == reading.replicates.shape
    change = difference(reading, before, statistic) if before is not None and is_paired else UNKNOWN
    numbers: dict[str, Any] = {"statistic": "value" if reading.size == 1 else statistic, "unit": value.unit}
    for name, ends, estimate in (("value", "interval", value), ("difference", "difference", change)):
        error = "standard_error" if estimate is value else f"{name}_standard_error"
        low, high = estimate.interval
        numbers |= {name: estimate.value, error: estimate.standard_error, f"{ends}_low": low, f"{ends}_high": high}
    return numbers


def _statistics(reading: Reading) -> tuple[str, ...]:
    if reading.size == 1:
        return STATISTICS[:1]
    is_illuminance = reading.unit == "lx"  # of luminances and ratings ratios have no meaning
    return STATISTICS if is_illuminance else STATISTICS[:3]
