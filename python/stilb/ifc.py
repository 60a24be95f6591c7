"""Buildings in IFC become folders with a scene file: `python -m stilb.ifc building.ifc -o building/`.

The folder has `scene.toml`, a mesh for each storey (OBJ) and the luminaire files that were found. Materials carry the
names of the IFC file; their reflectances are a start, by words of the name, by the colour of the style or by the kind of
element, and are there to be edited. It needs ifcopenshell: `pip install "stilb[ifc]"`.
"""

from __future__ import annotations

import argparse
import re
import shutil
import sys
import tomllib
from collections import Counter, defaultdict
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from ._stilb import InputError
from .scene import load

#: Reflectances by words of a material's name (English, German, French), the first that fits.
REFLECTANCES_BY_WORD = {
    "white": 0.8, "weiss": 0.8, "weiß": 0.8, "blanc": 0.8, "black": 0.05, "schwarz": 0.05, "acoustic": 0.75, "akustik": 0.75,
    "plaster": 0.7, "gypsum": 0.7, "gips": 0.7, "putz": 0.7, "plâtre": 0.7, "drywall": 0.7, "paint": 0.7, "anstrich": 0.7,
    "carpet": 0.15, "teppich": 0.15, "moquette": 0.15, "linoleum": 0.25, "parquet": 0.3, "parkett": 0.3, "screed": 0.3,
    "estrich": 0.3, "tile": 0.4, "fliese": 0.4, "concrete": 0.35, "beton": 0.35, "béton": 0.35, "brick": 0.25, "ziegel": 0.25,
    "wood": 0.4, "holz": 0.4, "bois": 0.4, "timber": 0.4, "alumin": 0.6, "steel": 0.5, "stahl": 0.5, "metal": 0.5,
    "metall": 0.5, "insulation": 0.5, "dämm": 0.5, "asphalt": 0.1, "grass": 0.1, "soil": 0.1,
}
#: And by the kind of element, where nothing else is known: the usual values of EN 12464-1.
REFLECTANCES_BY_KIND = {"IfcSlab": 0.3, "IfcCovering": 0.7, "IfcWall": 0.5, "IfcDoor": 0.4, "IfcRoof": 0.7,
                        "IfcFurniture": 0.4, "IfcFurnishingElement": 0.4}
REFLECTANCE_OTHERWISE = 0.5
GLASS_WORDS = ("glass", "glas", "verre", "glazing")
#: A solid of glass has two faces, each of which is a pane here. Two panes of this glass pass 78 % along the normal, as
#: double glazing does, and less at an angle.
GLASS = ("ior = 1.5", "internal_transmittance = 0.9543")
#: Spaces, holes and drawings are no surfaces.
NO_SURFACES = ("IfcSpace", "IfcOpeningElement", "IfcAnnotation", "IfcGrid", "IfcVirtualElement")
PHOTOMETRY = (".ies", ".ldt")
LEVEL_M = 1e-3
#: Farther from the origin than this, coordinates are those of a map: the building is moved.
FARTHEST_M = 1000.0


@dataclass
class Material:
    """A material of the scene, and where its value comes from."""

    name: str
    reflectance: float = REFLECTANCE_OTHERWISE
    is_glass: bool = False
    reason: str = ""


@dataclass
class Mesh:
    """The surfaces of a storey: triangles of materials, by element."""

    name: str
    vertices: list[np.ndarray] = field(default_factory=list)
    #: Element, material, triangles as indices into all vertices so far.
    groups: list[tuple[str, str, np.ndarray]] = field(default_factory=list)
    count: int = 0

    def add(self, element: str, material: str, vertices: np.ndarray, triangles: np.ndarray) -> None:
        """Adds triangles of one element and material."""
        self.groups.append((element, material, triangles + self.count))
        self.vertices.append(vertices)
        self.count += len(vertices)

    def materials(self) -> list[str]:
        """The names of its materials, in order."""
        return sorted({material for _, material, _ in self.groups})

    def write(self, path: Path) -> None:
        """Writes the mesh as OBJ, with groups by element."""
        with path.open("w", encoding="utf-8") as file:
            for vertices in self.vertices:
                np.savetxt(file, vertices, fmt="v %.6f %.6f %.6f")  # micrometres
            for element, material, triangles in self.groups:
                file.write(f"g {element}\nusemtl {material}\n")
                np.savetxt(file, triangles + 1, fmt="f %d %d %d")


@dataclass
class Space:
    """A room: where a working plane is measured."""

    name: str
    outline: np.ndarray  #: corners of its floor, shape (n, 3)


@dataclass
class Fixture:
    """A luminaire."""

    name: str
    position: np.ndarray
    aim: np.ndarray
    spin_deg: float
    file: Path | None = None
    flux_lm: float | None = None
    cct_k: float | None = None
    power_w: float | None = None

    def is_dark(self) -> bool:
        """Whether the IFC file states no light of it."""
        return self.file is None and self.flux_lm is None


@dataclass
class Building:
    """A building as it was read from an IFC file."""

    name: str
    materials: dict[str, Material]
    storeys: list[Mesh]
    spaces: list[Space]
    fixtures: list[Fixture]
    warnings: list[str]
    #: What is subtracted from the coordinates of the IFC file, in m.
    offset: np.ndarray = field(default_factory=lambda: np.zeros(3))

    def move_to_origin(self) -> None:
        """Moves a building at map coordinates near to the origin, by whole metres."""
        middle = np.median(np.concatenate([vertices for storey in self.storeys for vertices in storey.vertices]), axis=0)
        self.offset = np.where(np.abs(middle) > FARTHEST_M, np.round(middle), 0.0)
        if not self.offset.any():
            return
        for storey in self.storeys:
            storey.vertices = [vertices - self.offset for vertices in storey.vertices]
        for space in self.spaces:
            space.outline = space.outline - self.offset
        for fixture in self.fixtures:
            fixture.position = fixture.position - self.offset
        self.warnings.append(f"the building lies at map coordinates: it is moved by {_vector(-self.offset)} m, to the origin. "
                             "The scene file has the offset.")

    def leave_out_unusable_space(self, scene: Path) -> bool:
        """Whether there was a space over whose floor no plane fits, such as a shaft."""
        try:
            load(scene)
        except InputError as error:
            refused = re.search(r"sensors\.(.+?): (found no floor.*)$", str(error), re.DOTALL)
            if refused is None:
                raise
            self.spaces = [space for space in self.spaces if space.name != refused[1]]
            self.warnings.append(f'space "{refused[1]}" gets no sensor: {refused[2]}')
            return True
        return False


def import_ifc(path: str | Path, folder: str | Path, reflectances: str | Path | None = None) -> Building:
    """Writes a building as a folder with a scene file.

    path: the IFC file (IFC2X3, IFC4 or IFC4X3).
    folder: is made; files in it that are written again are replaced.
    reflectances: a TOML file of lines `"name of the material" = 0.5`, which decide before all else.

    Raises InputError where the file cannot be read, or has no surfaces.
    """
    building = read_ifc(Path(path), _table(reflectances))
    target = Path(folder)
    target.mkdir(parents=True, exist_ok=True)
    for storey in building.storeys:
        storey.write(target / f"{storey.name}.obj")
    for fixture in building.fixtures:
        if fixture.file is not None:
            shutil.copyfile(fixture.file, target / fixture.file.name)
    scene = target / "scene.toml"
    scene.write_text(scene_text(building, Path(path).name), encoding="utf-8")
    while building.leave_out_unusable_space(scene):
        scene.write_text(scene_text(building, Path(path).name), encoding="utf-8")
    return building


def read_ifc(path: Path, reflectances: dict[str, float] | None = None) -> Building:
    """Reads a building; `reflectances` by the names of materials decide before all else."""
    try:
        import ifcopenshell
        import ifcopenshell.geom
    except ImportError as error:
        raise InputError('IFC files need ifcopenshell: pip install "stilb[ifc]".') from error
    if not path.is_file():
        raise InputError(f"{path}: there is no such file.")
    try:
        model = ifcopenshell.open(str(path))
    except Exception as error:  # ifcopenshell has many classes
        raise InputError(f"{path}: it cannot be read as IFC: {str(error).strip()}.") from error
    reader = _Reader(model, path, reflectances or {})
    return reader.read(ifcopenshell.geom)


def _table(path: str | Path | None) -> dict[str, float]:
    if path is None:
        return {}
    try:
        table = tomllib.loads(Path(path).read_text(encoding="utf-8-sig"))
    except (OSError, tomllib.TOMLDecodeError) as error:
        raise InputError(f"{path}: it is no table of reflectances: {error}.") from error
    for name, value in table.items():
        if not isinstance(value, (int, float)) or not 0 <= value <= 1:
            raise InputError(f'{path}: "{name}" = {value!r} is no reflectance. Allowed: a number from 0 to 1.')
    return {name: float(value) for name, value in table.items()}


class _Reader:
    """Reads one model."""

    def __init__(self, model: Any, path: Path, reflectances: dict[str, float]) -> None:
        self.model = model
        self.path = path
        self.reflectances = reflectances
        self.materials: dict[str, Material] = {}
        self.material_names: Counter[str] = Counter()
        self.known: dict[tuple[str, bool, float], Material] = {}
        self.storeys: dict[str, Mesh] = {}
        self.spaces: list[Space] = []
        self.warnings: list[str] = []
        self.names: Counter[str] = Counter()
        self.luminaires = {product.id() for product in _light_fixtures(model)}

    def read(self, geometry: Any) -> Building:
        settings = geometry.settings()
        settings.set("use-world-coords", True)
        settings.set("weld-vertices", True)
        iterator = geometry.iterator(settings, self.model)
        found = iterator.initialize()
        while found:
            self._add(iterator.get())
            found = iterator.next()
        if not self.storeys:
            raise InputError(f"{self.path}: it has no element with a surface, such as a wall or a slab.")
        self._name_failures()
        projects = self.model.by_type("IfcProject")
        name = (projects[0].LongName or projects[0].Name) if projects else None
        building = Building(name or self.path.stem, self.materials, list(self.storeys.values()), self.spaces,
                            self._fixtures(geometry), self.warnings)
        building.move_to_origin()
        return building

    def _add(self, shape: Any) -> None:
        product = self.model.by_id(shape.id)
        vertices = np.asarray(shape.geometry.verts, dtype=float).reshape(-1, 3)
        triangles = np.asarray(shape.geometry.faces, dtype=np.int64).reshape(-1, 3)
        if product.is_a("IfcSpace"):
            self._add_space(product, vertices, triangles)
        if any(product.is_a(kind) for kind in NO_SURFACES) or len(triangles) == 0:
            return
        # What a luminaire's file or flux states was measured with its body, which would catch the light again.
        if product.id() in self.luminaires:
            return
        mesh = self._storey_of(product)
        element = _plain(f"{product.is_a()[3:]} {product.Name or product.GlobalId}")
        styles = list(shape.geometry.materials)
        ids = np.asarray(shape.geometry.material_ids, dtype=int)
        for index in sorted(set(ids.tolist())):
            style = styles[index] if 0 <= index < len(styles) else None
            material = self._material_of(product, style)
            own = triangles[ids == index]
            used, renumbered = np.unique(own, return_inverse=True)
            mesh.add(element, material.name, vertices[used], renumbered.reshape(-1, 3))

    def _storey_of(self, product: Any) -> Mesh:
        import ifcopenshell.util.element

        place: Any = ifcopenshell.util.element.get_container(product)
        while place is not None and not place.is_a("IfcBuildingStorey"):
            place = ifcopenshell.util.element.get_aggregate(place)
        key = place.GlobalId if place is not None else ""
        if key not in self.storeys:
            name = (place.LongName or place.Name) if place is not None else None
            self.storeys[key] = Mesh(self._new_name(_plain(name or "building")))
        return self.storeys[key]

    def _new_name(self, name: str) -> str:
        self.names[name] += 1
        return name if self.names[name] == 1 else f"{name}_{self.names[name]}"

    def _material_of(self, product: Any, style: Any) -> Material:
        """The material of this name and look: the parts of an element may share a name, as pane and frame do."""
        import ifcopenshell.util.element

        name = self._style_name(style)
        if not name:
            known = ifcopenshell.util.element.get_materials(product)
            name = (known[0].Name if known else "") or product.is_a()[3:].lower()
        material = self._new_material(_plain(name), product, style)
        key = (material.name, material.is_glass, material.reflectance)
        if key not in self.known:
            self.known[key] = material
            self.material_names[material.name] += 1
            count = self.material_names[material.name]
            if count > 1:
                material.name = f"{material.name}_{count}"
            self.materials[material.name] = material
        return self.known[key]

    def _style_name(self, style: Any) -> str:
        """The name that the file gives the style; ifcopenshell calls many by their number alone."""
        name = style.name if style is not None else ""
        number = re.search(r"-(\d+)$", name)
        if not name.startswith("Ifc") and "surface-style" not in name.lower():
            return name
        if number is None:
            return ""
        try:
            entity = self.model.by_id(int(number[1]))
        except RuntimeError:
            return ""
        owners = [entity, *self.model.get_inverse(entity)]
        return next((owner.Name for owner in owners if owner.is_a("IfcSurfaceStyle") and owner.Name), "")

    def _new_material(self, name: str, product: Any, style: Any) -> Material:
        lower = name.lower()
        if name in self.reflectances:
            return Material(name, self.reflectances[name], reason="from the table")
        transparency = getattr(style, "transparency", None)
        is_clear = isinstance(transparency, float) and transparency == transparency and transparency > 0.3
        if is_clear or any(word in lower for word in GLASS_WORDS):
            return Material(name, is_glass=True, reason="transparent in the IFC file" if is_clear else "by its name")
        for word, value in REFLECTANCES_BY_WORD.items():
            if word in lower:
                return Material(name, value, reason=f'by "{word}" in its name')
        colour = _colour_of(style)
        if colour is not None:
            # Colours of displays are gamma-coded.
            linear = np.where(colour <= 0.04045, colour / 12.92, ((colour + 0.055) / 1.055) ** 2.4)
            value = float(np.clip(linear @ [0.2126, 0.7152, 0.0722], 0.02, 0.9))
            return Material(name, round(value, 3), reason="by the colour of its style")
        for kind, value in REFLECTANCES_BY_KIND.items():
            if product.is_a(kind):
                return Material(name, value, reason=f"of {kind[3:].lower()}s in general")
        return Material(name, reason="nothing is known of it")

    def _add_space(self, product: Any, vertices: np.ndarray, triangles: np.ndarray) -> None:
        outline = _floor_outline(vertices, triangles)
        name = self._new_name(_plain(product.LongName or product.Name or "space"))
        if outline is None:
            self.warnings.append(f'space "{name}" has no level floor; it gets no sensor.')
            return
        self.spaces.append(Space(name, outline))

    def _name_failures(self) -> None:
        lacking = [product for product in _products(self.model, "IfcBuildingElement", "IfcBuiltElement")
                   if product.Representation is None and not product.IsDecomposedBy]
        if lacking:
            self.warnings.append(f"{len(lacking)} elements have no geometry, such as {lacking[0].is_a()[3:]} "
                                 f'"{lacking[0].Name or lacking[0].GlobalId}".')

    def _fixtures(self, geometry: Any) -> list[Fixture]:
        import ifcopenshell.util.placement
        import ifcopenshell.util.unit

        metres = ifcopenshell.util.unit.calculate_unit_scale(self.model)
        fixtures = []
        for number in sorted(self.luminaires):
            product = self.model.by_id(number)
            matrix = np.array(ifcopenshell.util.placement.get_local_placement(product.ObjectPlacement))
            axis, across = 0.0 - matrix[:3, 2], matrix[:3, 0]
            spin_deg = float(np.degrees(np.arctan2(across[1], across[0]))) if abs(axis[2]) > 0.999 else 0.0
            fixture = Fixture(self._new_name(_plain(product.Name or "luminaire")), matrix[:3, 3] * metres, axis, spin_deg)
            self._add_photometry(product, fixture)
            fixtures.append(fixture)
        dark = [f'"{fixture.name}"' for fixture in fixtures if fixture.is_dark()]
        if dark:
            more = f" and {len(dark) - 3} more" if len(dark) > 3 else ""
            self.warnings.append(f"no photometric file and no flux is known of the luminaires {', '.join(dark[:3])}{more}: they "
                                 "are in the scene file as comments.")
        return fixtures

    def _add_photometry(self, product: Any, fixture: Fixture) -> None:
        import ifcopenshell.util.element

        for source in _light_sources(self.model, product):
            if source.is_a("IfcLightSourceGoniometric"):
                fixture.flux_lm = source.LuminousFlux or fixture.flux_lm
                fixture.cct_k = source.ColourTemperature or fixture.cct_k
                fixture.file = self._existing(getattr(source.LightDistributionDataSource, "Location", None))
        for properties in ifcopenshell.util.element.get_psets(product).values():
            for key, value in properties.items():
                if isinstance(value, str) and value.lower().endswith(PHOTOMETRY):
                    fixture.file = fixture.file or self._existing(value)
                elif key in ("TotalWattage", "Wattage") and isinstance(value, (int, float)):
                    fixture.power_w = float(value)
                elif key in ("LuminousFlux", "TotalLuminousFlux") and isinstance(value, (int, float)):
                    fixture.flux_lm = fixture.flux_lm or float(value)

    def _existing(self, location: str | None) -> Path | None:
        if not location:
            return None
        name = location.removeprefix("file://").replace("\\", "/")
        for candidate in (self.path.parent / name, self.path.parent / Path(name).name):
            if candidate.is_file():
                return candidate
        self.warnings.append(f'photometric file "{location}" was not found beside {self.path.name}.')
        return None


def _products(model: Any, *kinds: str) -> list[Any]:
    """All products of these kinds; the schemas have different ones."""
    products = []
    for kind in kinds:
        try:
            products += model.by_type(kind)
        except RuntimeError:  # not in this schema
            continue
    return products


def _light_fixtures(model: Any) -> list[Any]:
    """The luminaires: in IFC2X3 they are terminals whose type says so."""
    import ifcopenshell.util.element

    def is_luminaire(terminal: Any) -> bool:
        kind: Any = ifcopenshell.util.element.get_type(terminal)
        return kind is not None and bool(kind.is_a("IfcLightFixtureType"))

    terminals = [] if model.schema != "IFC2X3" else model.by_type("IfcFlowTerminal")
    return _products(model, "IfcLightFixture") + [terminal for terminal in terminals if is_luminaire(terminal)]


def _light_sources(model: Any, product: Any) -> list[Any]:
    """The light sources in the representations of a product."""
    if product.Representation is None:
        return []
    return [item for representation in product.Representation.Representations
            for item in model.traverse(representation) if item.is_a("IfcLightSource")]


def _colour_of(style: Any) -> np.ndarray | None:
    diffuse = getattr(style, "diffuse", None)
    if diffuse is None:
        return None
    if callable(getattr(diffuse, "r", None)):
        return np.array([diffuse.r(), diffuse.g(), diffuse.b()])
    try:
        return np.array(tuple(diffuse), dtype=float)[:3]
    except TypeError:
        return None


def _plain(name: str) -> str:
    """A name that may be a key, a file's name and a word of an OBJ file."""
    words = re.sub(r"[^\w.+-]+", "_", name.strip(), flags=re.UNICODE).strip("_.")
    return words or "unnamed"


def _floor_outline(vertices: np.ndarray, triangles: np.ndarray) -> np.ndarray | None:
    """The longest loop around the lowest level faces, shape (n, 3)."""
    if len(triangles) == 0:
        return None
    lowest = vertices[:, 2].min()
    is_low = np.abs(vertices[:, 2] - lowest) < LEVEL_M
    uses: Counter[tuple[int, int]] = Counter()
    for triangle in triangles[is_low[triangles].all(axis=1)]:
        for a, b in zip(triangle, np.roll(triangle, -1)):
            uses[int(min(a, b)), int(max(a, b))] += 1
    next_to: dict[int, list[int]] = defaultdict(list)
    for (a, b), count in uses.items():
        if count == 1:
            next_to[a].append(b)
            next_to[b].append(a)
    loops = []
    while next_to:
        start = min(next_to)
        loop, at = [start], start
        while next_to.get(at):
            to = next_to[at].pop()
            next_to[to].remove(at)
            if to == start:
                break
            loop.append(to)
            at = to
        next_to = defaultdict(list, {key: ends for key, ends in next_to.items() if ends})
        if len(loop) >= 3:
            loops.append(loop)
    if not loops:
        return None
    longest = max(loops, key=lambda loop: float(np.linalg.norm(np.diff(vertices[[*loop, loop[0]]], axis=0), axis=1).sum()))
    corners = vertices[longest].copy()
    corners[:, 2] = lowest
    return corners


def scene_text(building: Building, source: str) -> str:
    """The scene file of a building whose meshes lie beside it."""
    lines = [f"# Imported from {source}. Edit it: above all the reflectances of the materials.", "", "[scene]",
             f"name = {_text(building.name)}"]
    if building.offset.any():
        lines.insert(1, "# It lay at map coordinates, and was moved to the origin: the coordinates of the IFC file are those of "
                        f"this scene plus {_vector(building.offset)} m.")
    for material in building.materials.values():
        lines += ["", f"[materials.{_text(material.name)}]" + (f"  # {material.reason}" if material.reason else "")]
        if material.is_glass:
            lines += ['type = "pane"', *GLASS]
        else:
            lines += ['type = "diffuse"', f"reflectance = {material.reflectance:g}"]
    for storey in building.storeys:
        pairs = ", ".join(f"{_text(name)} = {_text(name)}" for name in storey.materials())
        lines += ["", f"[objects.{_text(storey.name)}]", 'shape = "mesh"', f"file = {_text(storey.name + '.obj')}",
                  f"materials = {{ {pairs} }}"]
    for fixture in building.fixtures:
        lines += ["", *_fixture_lines(fixture)]
    for space in building.spaces:
        corners = ", ".join(map(_vector, space.outline))
        lines += ["", f"[sensors.{_text(space.name)}]", 'type = "plane"', f"polygon = [{corners}]", "height = 0.75",
                  f"margin = {_margin_m(space.outline):g}"]
    return "\n".join(lines) + "\n"


def _margin_m(outline: np.ndarray) -> float:
    """The margin of EN 12464-1: 0.5 m, or 15 % of the smallest dimension of the room if that is less. The smallest
    dimension is the diameter of the largest circle within the outline, with a middle on a raster of 64 x 64."""
    starts = outline[:, :2]
    edges = np.roll(starts, -1, axis=0) - starts
    least, size = starts.min(axis=0), np.ptp(starts, axis=0)
    steps = (np.arange(64) + 0.5) / 64
    points = np.stack(np.meshgrid(*(least + size * steps[:, None]).T), axis=-1).reshape(-1, 1, 2)
    along = np.clip(((points - starts) * edges).sum(axis=2) / np.maximum((edges**2).sum(axis=1), 1e-12), 0, 1)
    distances = np.linalg.norm(points - starts - along[:, :, None] * edges, axis=2).min(axis=1)
    is_past = starts[:, 1] > points[:, :, 1]
    with np.errstate(divide="ignore", invalid="ignore"):
        crossings = starts[:, 0] + (points[:, :, 1] - starts[:, 1]) / edges[:, 1] * edges[:, 0]
    is_inside = ((is_past != np.roll(is_past, -1, axis=1)) & (points[:, :, 0] < crossings)).sum(axis=1) % 2 == 1
    return float(np.floor(100 * min(0.5, 0.15 * 2 * (distances * is_inside).max())) / 100)


def _fixture_lines(fixture: Fixture) -> list[str]:
    lines = [f"[lights.{_text(fixture.name)}]"]
    if fixture.file is not None:
        lines += ['type = "photometry"', f"file = {_text(fixture.file.name)}", f"position = {_vector(fixture.position)}",
                  f"aim = {_vector(fixture.aim)}"]
        if fixture.spin_deg:
            lines.append(f"spin = {fixture.spin_deg:.4g}")
    else:
        lines += ['type = "point"', f"position = {_vector(fixture.position)}", f"flux = {fixture.flux_lm or 0:g}"]
    if fixture.cct_k:
        lines.append(f"cct = {fixture.cct_k:g}")
    if fixture.power_w:
        lines.append(f"power = {fixture.power_w:g}")
    return [f"# {line}" for line in ["The IFC file states no light of it.", *lines]] if fixture.is_dark() else lines


def _vector(vector: np.ndarray) -> str:
    """Three numbers as in a scene file, to a millionth."""
    return "[" + ", ".join(f"{round(float(x), 6) + 0.0:.6f}".rstrip("0").rstrip(".") for x in vector) + "]"


def _text(text: str) -> str:
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'


def main(arguments: list[str] | None = None) -> int:
    """The command line."""
    parser = argparse.ArgumentParser(prog="stilb import", description="Write a building (IFC) as a folder with a scene file")
    parser.add_argument("file", metavar="FILE.ifc")
    parser.add_argument("-o", "--output", metavar="DIR", required=True, help="folder to write")
    parser.add_argument("--reflectances", metavar="FILE.toml", help='table of reflectances: "name of the material" = 0.5')
    request = parser.parse_args(arguments)
    try:
        building = import_ifc(request.file, request.output, request.reflectances)
    except (InputError, OSError) as error:
        print(f"stilb: {error}", file=sys.stderr)
        return 2
    for warning in building.warnings:
        print(f"warning: {warning}", file=sys.stderr)
    triangles = sum(len(group[2]) for storey in building.storeys for group in storey.groups)
    print(f"{request.output}/scene.toml: {len(building.storeys)} storeys, {triangles} triangles, {len(building.materials)} "
          f"materials, {len(building.spaces)} spaces, {len(building.fixtures)} luminaires")
    print(f"Next: stilb render {request.output}/scene.toml --preview; stilb measure {request.output}/scene.toml")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
