"""Results as tables of pandas and data sets of xarray, which are optional."""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

import numpy as np

from .plots import step

if TYPE_CHECKING:
    import pandas
    import xarray

    from .results import Reading, Result


def needed(package: str, installed_by: str | None = None) -> Any:
    try:
        return importlib.import_module(package)
    except ImportError:
        raise ImportError(f"this needs the package {package}: {installed_by or f'pip install {package}'}", name=package) from None


def _columns(reading: Reading) -> dict[str, Any]:
    sensor = reading._sensor
    columns = {axis: sensor.position[:, i] for i, axis in enumerate("xyz")}
    columns |= {f"direction_{axis}": sensor.direction[:, i] for i, axis in enumerate("xyz")}
    return columns | {"value": sensor.value, "standard_error": sensor.standard_error, "lower": sensor.lower,
                      "upper": sensor.upper}


def table(reading: Reading) -> pandas.DataFrame:
    pandas = needed("pandas")
    rows = pandas.DataFrame(_columns(reading))
    if reading._is_grid():
        rows.index = pandas.MultiIndex.from_product([range(length) for length in reading.shape], names=["v", "u"])
    rows.attrs = {"name": reading.name, "quantity": reading.quantity, "unit": reading.unit}
    return rows


def table_of_all(result: Result) -> pandas.DataFrame:
    pandas = needed("pandas")
    parts = {name: pandas.DataFrame({"quantity": reading.quantity, "unit": reading.unit, **_columns(reading)})
             for name, reading in result.items()}
    return pandas.concat(parts, names=["sensor", "reading"])


def dataset(reading: Reading) -> xarray.Dataset:
    module = needed("xarray")
    axes: tuple[str, ...] = ("v", "u")
    if not reading._is_grid():
        axes = ("reading",) if len(reading.shape) == 1 else tuple(f"axis_{i}" for i in range(len(reading.shape)))
    unit = {"units": reading.unit, "long_name": reading.quantity}
    low, high = reading.interval()
    values = {"value": reading.value, "standard_error": reading.standard_error, "lower": low, "upper": high}
    variables: dict[str, Any] = {name: (axes, array, unit) for name, array in values.items()}
    variables["rgb"] = ((*axes, "band"), reading.rgb, unit)
    coordinates: dict[str, Any] = {axis: (axes, reading.position[..., i], {"units": "m"}) for i, axis in enumerate("xyz")}
    coordinates["band"] = ["red", "green", "blue"]
    if reading._is_grid():
        position = reading.position
        for axis, line in (("u", position[0]), ("v", position[:, 0])):
            coordinates[axis] = (axis, step(line) * (np.arange(len(line)) + 0.5), {"units": "m"})
    data: xarray.Dataset = module.Dataset(variables, coordinates, {"name": reading.name, **unit})
    return data
