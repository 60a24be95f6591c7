"""Scene files of Stilb, as far as the comparison needs them: rectangles, triangles, spheres, lights and cameras.

Quantities stay photometric (lm, cd, cd/m2, lx) and are RGB triples of linear Rec. 709.
"""

import math
import tomllib
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

MATERIALS = ("diffuse", "phong", "rough", "plastic", "mirror", "glass", "pane", "translucent", "frosted", "black")
LUMINANCE_WEIGHTS = np.array([0.2126, 0.7152, 0.0722])


@dataclass
class Rectangle:
    """Its front is edge_u x edge_v."""

    corner: np.ndarray
    edge_u: np.ndarray
    edge_v: np.ndarray

    def area(self) -> float:
        return float(np.linalg.norm(np.cross(self.edge_u, self.edge_v)))


@dataclass
class Sphere:
    center: np.ndarray
    radius: float

    def area(self) -> float:
        return 4 * math.pi * self.radius**2


@dataclass
class Triangles:
    vertices: np.ndarray  # n x 3 [m]
    faces: np.ndarray  # m x 3 indices


@dataclass
class Surface:
    shape: Rectangle | Sphere | Triangles
    material: dict  # the table of the scene file; reflectances are RGB
    luminance: np.ndarray | None = None  # [cd/m2], of the front


@dataclass
class PointLight:
    position: np.ndarray
    intensity: np.ndarray  # [cd]


@dataclass
class Luminaire:
    """A photometric file that hangs straight down."""

    file: Path
    position: np.ndarray
    spin_deg: float
    dimming: float


@dataclass
class Camera:
    position: np.ndarray
    target: np.ndarray
    projection: str
    fov_deg: float
    resolution: tuple[int, int]  # width, height [pixels]


@dataclass
class Scene:
    surfaces: list[Surface] = field(default_factory=list)
    points: list[PointLight] = field(default_factory=list)
    luminaires: list[Luminaire] = field(default_factory=list)
    cameras: dict[str, Camera] = field(default_factory=dict)

    def has(self, *materials: str) -> bool:
        return any(surface.material["type"] in materials for surface in self.surfaces)


def read_scene(path: Path) -> Scene:
    """Raises ValueError where the scene holds something that is not compared here."""
    table = tomllib.loads(path.read_text())
    materials = {name: _read_material(m) for name, m in table["materials"].items()}
    emitters = {l["object"]: l for l in table["lights"].values() if l["type"] == "area"}
    scene = Scene()
    for name, entry in table["objects"].items():
        for shape, material in _read_shapes(entry, path.parent):
            scene.surfaces.append(Surface(shape, materials[material]))
        if name in emitters:
            if entry["shape"] not in ("rectangle", "sphere"):
                raise ValueError(f"{path}: light on {name}: only rectangles and spheres are compared")
            emitter = scene.surfaces[-1]
            emitter.luminance = _luminance(emitters[name], emitter.shape)
    for light in table["lights"].values():
        _read_light(light, path.parent, scene)
    cameras = {name: s for name, s in table.get("sensors", {}).items() if s["type"] == "camera"}
    scene.cameras = {name: _read_camera(sensor) for name, sensor in cameras.items()}
    return scene


def _read_camera(table: dict) -> Camera:
    if "up" in table or "filter" in table:
        raise ValueError("cameras are compared that stand upright and have the box filter")
    projection = table.get("projection", "perspective")
    fov = table.get("fov", {"perspective": 60, "fisheye": 180, "panorama": 360}[projection])
    ends = _vector(table["position"]), _vector(table["target"])
    return Camera(*ends, projection, fov, tuple(table["resolution"]))


def _rgb(value) -> np.ndarray:
    return np.broadcast_to(np.asarray(value, float), 3).copy()


def _read_material(table: dict) -> dict:
    if table["type"] not in MATERIALS:
        raise ValueError(f"material type {table['type']} is not compared")
    keys = ("reflectance", "diffuse", "specular", "transmittance", "specular_transmittance")
    return {key: _rgb(value) if key in keys else value for key, value in table.items()}


def _vector(value) -> np.ndarray:
    return np.asarray(value, float)


def _read_shapes(entry: dict, directory: Path) -> list:
    kind, material = entry["shape"], entry["material"]
    if kind == "rectangle":
        return [(Rectangle(*(_vector(entry[k]) for k in ("corner", "edge_u", "edge_v"))), material)]
    if kind == "box":
        return [(side, material) for side in _box(_vector(entry["min"]), _vector(entry["max"]))]
    if kind == "sphere":
        return [(Sphere(_vector(entry["center"]), entry["radius"]), material)]
    if kind == "mesh":
        chosen = entry.get("materials", {})
        meshes = read_obj(directory / entry["file"])
        return [(mesh, chosen.get(name, material)) for name, mesh in meshes.items()]
    raise ValueError(f"shape {kind} is not compared")


def _box(low: np.ndarray, high: np.ndarray) -> list[Rectangle]:
    edges = np.diag(high - low)
    sides = []
    for axis in range(3):
        u, v = edges[(axis + 1) % 3], edges[(axis + 2) % 3]
        sides += [Rectangle(low, v, u), Rectangle(low + edges[axis], u, v)]
    return sides


def read_obj(path: Path) -> dict[str, Triangles]:
    """The triangles by material name; polygons must be convex."""
    vertices, faces, material = [], {}, ""
    for line in path.read_text().splitlines():
        words = line.split()
        if line.startswith("v "):
            vertices.append([float(w) for w in words[1:4]])
        elif line.startswith("usemtl "):
            material = words[1]
        elif line.startswith("f "):
            corners = [int(w.split("/")[0]) - 1 for w in words[1:]]
            fan = [[corners[0], b, c] for b, c in zip(corners[1:], corners[2:])]
            faces.setdefault(material, []).extend(fan)
    return {name: Triangles(np.array(vertices), np.array(f)) for name, f in faces.items()}


def _luminance(light: dict, shape: Rectangle | Sphere) -> np.ndarray:
    return _rgb(light["luminance"] if "luminance" in light else light["flux"] / (math.pi * shape.area()))


def _read_light(light: dict, directory: Path, scene: Scene) -> None:
    if "cct" in light or "color" in light:
        raise ValueError("coloured lights are not compared")
    if light["type"] == "point":
        intensity = light["intensity"] if "intensity" in light else light["flux"] / (4 * math.pi)
        scene.points.append(PointLight(_vector(light["position"]), _rgb(intensity)))
    elif light["type"] == "sphere":
        sphere = Sphere(_vector(light["center"]), light["radius"])
        scene.surfaces.append(Surface(sphere, {"type": "black"}, _luminance(light, sphere)))
    elif light["type"] == "photometry":
        if light.get("aim", [0, 0, -1]) != [0, 0, -1] or "flux" in light:
            raise ValueError("luminaires are compared that hang straight down and have their file's flux")
        turn_and_dimming = light.get("spin", 0), light.get("dimming", 1)
        position = _vector(light["position"])
        scene.luminaires.append(Luminaire(directory / light["file"], position, *turn_and_dimming))
