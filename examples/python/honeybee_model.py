"""How does a Honeybee model (HBJSON) become a scene, and what are the daylight factors of its sensor grids?

    python honeybee_model.py office.hbjson --scene office.toml

Rooms, openings, shades, modifiers, sensor grids and perspective views are taken; a list names what is not. `--scene` writes
the scene, without a sky, as a scene file. The sky is that of daylight_factor.py.
"""

import argparse
import json
import tempfile
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

import stilb
from daylight_factor import overcast_sky

METRES = {"Meters": 1.0, "Centimeters": 0.01, "Millimeters": 0.001, "Feet": 0.3048, "Inches": 0.0254}
GENERIC_REFLECTANCES = {"Wall": 0.5, "Floor": 0.2, "RoofCeiling": 0.8, "Shade": 0.35, "Door": 0.5}


def ring_with_holes(outline: np.ndarray, holes: list[np.ndarray]) -> np.ndarray:
    """One polygon for a face with holes: each hole is joined to the corner that is nearest, there and back."""
    ring, normal = outline, area_vector(outline)
    waiting = [hole if area_vector(hole) @ normal < 0 else hole[::-1] for hole in holes]
    while waiting:
        distances = [np.linalg.norm(ring[:, None] - hole, axis=2) for hole in waiting]
        nearest = min(range(len(waiting)), key=lambda number: distances[number].min())
        here, there = np.unravel_index(distances[nearest].argmin(), distances[nearest].shape)
        hole = np.roll(waiting.pop(nearest), -there, axis=0)
        ring = np.vstack([ring[:here + 1], hole, hole[:1], ring[here:]])
    return ring


def area_vector(ring: np.ndarray) -> np.ndarray:
    return np.cross(ring, np.roll(ring, -1, axis=0)).sum(0) / 2


class Converter:
    def __init__(self, model: dict[str, Any]) -> None:
        self.scene = stilb.Scene(model["identifier"])
        self.left_out: Counter[str] = Counter()
        self.model = model
        self.radiance = model["properties"].get("radiance") or {}
        self.modifiers = {modifier["identifier"]: modifier for modifier in self.radiance.get("modifiers") or []}
        self.scale = METRES[model.get("units", "Meters")]

    def convert(self) -> stilb.Scene:
        for item, kind, openings in self.items():
            self.add_object(item, kind, openings)
        for grid in self.radiance.get("sensor_grids") or []:
            self.add_grid(grid)
        for view in self.radiance.get("views") or []:
            self.add_view(view)
        self.left_out["shade meshes"] += len(self.model.get("shade_meshes") or [])
        return self.scene

    def items(self) -> Iterator[tuple[dict[str, Any], str, list[Any]]]:
        """All surfaces, each with its kind and what is cut out of it. A wall between two rooms is taken once: its second side
        comes when the first one is in the scene."""
        for room in self.model.get("rooms") or []:
            yield from ((shade, "Shade", []) for shade in shades_of(room))
            for face in room["faces"]:
                condition = face["boundary_condition"]
                is_second_side = (condition["type"] == "Surface"
                                  and condition["boundary_condition_objects"][0] in self.scene.objects)
                if not is_second_side and face["face_type"] != "AirBoundary":
                    yield from items_of_face(face)
        for face in self.model.get("orphaned_faces") or []:
            yield from items_of_face(face)
        for shade in self.model.get("orphaned_shades") or []:
            yield shade, "Shade", []

    def add_object(self, item: dict[str, Any], kind: str, openings: list[Any]) -> None:
        geometry = item["geometry"]
        holes = [*(geometry.get("holes") or []), *(opening["geometry"]["boundary"] for opening in openings)]
        ring = ring_with_holes(np.array(geometry["boundary"], float), [np.array(hole, float) for hole in holes])
        self.scene.objects[item["identifier"]] = stilb.Polygons(
            vertices=self.scale * ring, faces=[list(range(len(ring)))], material=self.material(item, kind))

    def material(self, item: dict[str, Any], kind: str) -> str:
        """The name of the material, which is made where it is not there yet."""
        name = (item["properties"].get("radiance") or {}).get("modifier")
        modifier = self.modifiers.get(name)
        key = name if modifier else f"generic {kind}"
        if key not in self.scene.materials:
            self.scene.materials[key] = self.material_of(modifier) if modifier else generic_material(kind)
        return key

    def material_of(self, modifier: dict[str, Any]) -> stilb.Material:
        if modifier["type"] == "Glass":
            return stilb.Pane(ior=modifier.get("refraction_index") or 1.52,
                              internal_transmittance=bands(modifier, "transmissivity"))
        if modifier["type"] == "Plastic":
            if modifier.get("specularity"):
                self.left_out["gloss of Plastic modifiers"] += 1
            return stilb.Diffuse(reflectance=bands(modifier, "reflectance"))
        self.left_out[f"modifiers of type {modifier['type']} (grey of 30 % instead)"] += 1
        return stilb.Diffuse(reflectance=0.3)

    def add_grid(self, grid: dict[str, Any]) -> None:
        """A sensor for each direction, which is one in most grids."""
        points = self.scale * np.array([sensor["pos"] for sensor in grid["sensors"]])
        directions, which = np.unique([sensor["dir"] for sensor in grid["sensors"]], axis=0, return_inverse=True)
        for number, direction in enumerate(directions):
            name = grid["identifier"] + (f" {number + 1}" if len(directions) > 1 else "")
            self.scene.sensors[name] = stilb.Illuminance(points=points[which.ravel() == number], normal=direction)

    def add_view(self, view: dict[str, Any]) -> None:
        if view.get("view_type", "v") != "v":
            self.left_out["views that are not perspective"] += 1
            return
        position = self.scale * np.array(view["position"])
        self.scene.sensors[view["identifier"]] = stilb.Camera(
            position=position, target=position + view["direction"], up=view.get("up_vector", (0, 0, 1)),
            fov=view.get("h_size", 60), resolution=(400, 300))


def items_of_face(face: dict[str, Any]) -> Iterator[tuple[dict[str, Any], str, list[Any]]]:
    openings = [("Aperture", aperture) for aperture in face.get("apertures") or []]
    openings += [("Door", door) for door in face.get("doors") or []]
    yield face, face["face_type"], [opening for _, opening in openings]
    for kind, opening in openings:
        yield opening, kind, []
        yield from ((shade, "Shade", []) for shade in shades_of(opening))
    yield from ((shade, "Shade", []) for shade in shades_of(face))


def shades_of(item: dict[str, Any]) -> list[dict[str, Any]]:
    return (item.get("outdoor_shades") or []) + (item.get("indoor_shades") or [])


def generic_material(kind: str) -> stilb.Material:
    if kind == "Aperture":
        return stilb.Pane(ior=1.52, internal_transmittance=0.7)
    return stilb.Diffuse(reflectance=GENERIC_REFLECTANCES[kind])


def bands(modifier: dict[str, Any], quantity: str) -> list[float]:
    return [modifier[f"{band}_{quantity}"] for band in "rgb"]


def daylight(model: stilb.Scene, error: str) -> stilb.Result:
    """The model under an overcast sky, with a point outside that the sky alone lights."""
    with tempfile.TemporaryDirectory() as folder:
        scene = overcast_sky(folder)
        scene.materials.update(model.materials)
        scene.objects.update(model.objects)
        scene.sensors.update(model.sensors)
        scene.sensors["outside"] = stilb.Illuminance(position=(0, 0, 1000), normal=(0, 0, 1))
        return scene.measure(error=error, time=60)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("model", nargs="?", type=Path, default=Path(__file__).with_name("office.hbjson"))
    parser.add_argument("--scene", type=Path, help="the scene file to write")
    parser.add_argument("--error", default="10%", help="the relative half-width of the 95 %% intervals (10%%)")
    arguments = parser.parse_args()

    converter = Converter(json.loads(arguments.model.read_text(encoding="utf-8")))
    scene = converter.convert()
    print(scene)
    for what, count in (+converter.left_out).items():
        print(f"left out: {count} {what}")
    if arguments.scene:
        scene.save(arguments.scene)

    result = daylight(scene, arguments.error)
    outside = result["outside"].mean
    for name, reading in result.items():
        if name != "outside":
            print(f"{name}: daylight factor {100 * reading.mean / outside} % in the mean of {reading.size} points, "
                  f"{100 * reading.minimum / outside} % at least")


if __name__ == "__main__":
    main()
