"""The example office: made by its script byte for byte, closed, untangled, and honest about its flux."""

import importlib.util
import sys
import tempfile
import tomllib
import unittest
from collections import Counter, defaultdict
from math import cos, radians
from pathlib import Path

FOLDER = Path(__file__).resolve().parents[2] / "scenes" / "office"
CLEARANCE_M = 0.0005


def load_script(name):
    sys.path.insert(0, str(FOLDER))
    specification = importlib.util.spec_from_file_location(name, FOLDER / f"{name}.py")
    module = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(module)
    return module


def read_obj(path):
    """Vertices, and triangles (indices from 0) by group."""
    vertices, groups, group = [], defaultdict(list), None
    for line in path.read_text().splitlines():
        word, *rest = line.split()
        if word == "v":
            vertices.append(tuple(map(float, rest)))
        elif word == "g":
            group = rest[0]
        elif word == "f":
            groups[group].append(tuple(int(number) - 1 for number in rest))
    return vertices, groups


def minus(a, b):
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def cross(a, b):
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def volume_m3(triangles):
    return sum(dot(p, cross(q, r)) for p, q, r in triangles) / 6


def solids_of(vertices, groups):
    """Surfaces connected by edges (a common point does not connect) as (group, triangles of points)."""
    solids = []
    for group, faces in groups.items():
        neighbour = {}
        for a, b, c in faces:
            neighbour.update({(b, a): (a, b, c), (c, b): (a, b, c), (a, c): (a, b, c)})
        left = dict.fromkeys(faces)
        while left:
            reached = [left.popitem()[0]]
            for a, b, c in reached:
                for edge in ((a, b), (b, c), (c, a)):
                    if neighbour.get(edge) in left:
                        reached.append(neighbour[edge])
                        del left[neighbour[edge]]
            solids.append((group, [tuple(vertices[index] for index in face) for face in reached]))
    return solids


def bounds(triangles):
    points = [point for triangle in triangles for point in triangle]
    return tuple(map(min, zip(*points))), tuple(map(max, zip(*points)))


def boxes_meet(a, b):
    """True where they come nearer than CLEARANCE_M."""
    return all(a[0][k] <= b[1][k] + CLEARANCE_M and b[0][k] <= a[1][k] + CLEARANCE_M for k in range(3))


def segment_hits(start, end, triangle, slack_m=0.0):
    """True where the segment, longer by `slack_m` at both ends, meets the triangle."""
    p, q, r = triangle
    along, u, v = minus(end, start), minus(q, p), minus(r, p)
    normal = cross(u, v)
    determinant = -dot(along, normal)
    if abs(determinant) < 1e-15:
        return False
    offset = minus(start, p)
    t = dot(offset, normal) / determinant
    turned = cross(offset, along)
    s1, s2 = dot(v, turned) / determinant, -dot(u, turned) / determinant
    slack = slack_m / dot(along, along) ** 0.5
    return -slack <= t <= 1 + slack and s1 >= 0 and s2 >= 0 and s1 + s2 <= 1


def edges_cross(first, second):
    """True where an edge of one surface passes through a triangle of the other, or ends at it."""
    for ones, others in ((first, second), (second, first)):
        box = bounds(others)
        near = [t for t in ones if boxes_meet(bounds([t]), box)]
        boxed = [(t, bounds([t])) for t in others]
        for triangle in near:
            triangle_box = bounds([triangle])
            for other, other_box in boxed:
                if boxes_meet(triangle_box, other_box):
                    edges = zip(triangle, (*triangle[1:], triangle[0]))
                    if any(segment_hits(a, b, other, CLEARANCE_M) for a, b in edges):
                        return True
    return False


def contains(triangles, point):
    """True where a closed surface has the point inside: an odd number of hits in an odd direction."""
    far = (point[0] + 20.123, point[1] + 13.457, point[2] + 31.791)
    return sum(segment_hits(point, far, triangle) for triangle in triangles) % 2 == 1


class OfficeMesh(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.vertices, cls.groups = read_obj(FOLDER / "office.obj")
        cls.solids = solids_of(cls.vertices, cls.groups)

    def test_is_what_the_script_writes(self):
        with tempfile.TemporaryDirectory() as folder:
            load_script("make_office").main(Path(folder))
            for name in ("office.obj", "luminaire.ies", "luminaire.ldt"):
                self.assertEqual((Path(folder) / name).read_bytes(), (FOLDER / name).read_bytes(), name)

    def test_has_about_ten_thousand_triangles(self):
        count = sum(map(len, self.groups.values()))
        self.assertTrue(9000 <= count <= 11000, count)

    def test_every_group_is_closed(self):
        for group, faces in self.groups.items():
            edges = Counter(edge for a, b, c in faces for edge in ((a, b), (b, c), (c, a)))
            for (a, b), count in edges.items():
                self.assertEqual((count, edges[(b, a)]), (1, 1), f"{group}: edge {a} {b}")

    def test_no_triangle_is_degenerate(self):
        for group, triangles in self.solids:
            for p, q, r in triangles:
                normal = cross(minus(q, p), minus(r, p))
                longest = max(dot(d, d) for d in (minus(q, p), minus(r, q), minus(p, r)))
                self.assertGreater(dot(normal, normal) ** 0.5, 1e-4 * longest, f"{group}: {p} {q} {r}")

    def test_solids_face_outwards_and_the_shell_inwards(self):
        for group, triangles in self.solids:
            if group == "room":
                recesses = 2.4 * 1.3 * 0.22 + 0.9 * 2.05 * 0.06
                self.assertAlmostEqual(volume_m3(triangles), -(5.4 * 4.2 * 2.8 + recesses), places=6)
            else:
                self.assertGreater(volume_m3(triangles), 0, group)

    def test_solids_neither_cross_nor_contain_each_other(self):
        boxes = [bounds(triangles) for _, triangles in self.solids]
        for i, (group, triangles) in enumerate(self.solids):
            for j in range(i):
                if not boxes_meet(boxes[i], boxes[j]):
                    continue
                other_group, others = self.solids[j]
                names = f"{group} and {other_group} near {triangles[0][0]}"
                self.assertFalse(edges_cross(triangles, others), names)
                inside_room = "room" in (group, other_group)
                self.assertEqual(contains(others, triangles[0][0]), inside_room, names)
                self.assertFalse(contains(triangles, others[0][0]), names)

    def test_every_solid_is_in_the_room(self):
        low, high = bounds(self.vertices_of("room"))
        for group, triangles in self.solids:
            box = bounds(triangles)
            if group != "room":
                self.assertTrue(all(low[k] < box[0][k] and box[1][k] < high[k] for k in range(3)), group)

    def vertices_of(self, group):
        return [tuple(self.vertices[index] for index in face) for face in self.groups[group]]


class OfficeScene(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scene = tomllib.loads((FOLDER / "office.toml").read_text())

    def test_every_material_of_the_mesh_is_mapped_to_one_of_the_scene(self):
        lines = (FOLDER / "office.obj").read_text().splitlines()
        used = {line.split()[1] for line in lines if line.startswith("usemtl")}
        mapping = self.scene["objects"]["office"]["materials"]
        self.assertEqual(used, set(mapping))
        self.assertEqual(set(mapping.values()), set(self.scene["materials"]))

    def test_every_sensor_and_light_is_in_the_air(self):
        solids = [(group, triangles, bounds(triangles)) for group, triangles in
                  solids_of(*read_obj(FOLDER / "office.obj"))]
        points = [light["position"] for light in self.scene["lights"].values()]
        for sensor in self.scene["sensors"].values():
            points += [sensor["position"]] if "position" in sensor else list(grid_points(sensor))
        self.assertEqual(len(points), 4 + 2 * 128 + 4)
        for point in points:
            inside = [group for group, triangles, box in solids
                      if boxes_meet(box, (point, point)) and contains(triangles, point)]
            self.assertEqual(inside, ["room"], point)


def grid_points(grid):
    count_u, count_v = grid["count"]
    for v in range(count_v):
        for u in range(count_u):
            yield tuple(c + eu * (u + 0.5) / count_u + ev * (v + 0.5) / count_v
                        for c, eu, ev in zip(grid["corner"], grid["edge_u"], grid["edge_v"]))


def ies_flux(path):
    """Stated and integrated flux of a file of type C with a quarter of its planes, by the midpoint rule."""
    text = path.read_text()
    numbers = [float(word) for word in text[text.index("TILT=NONE") + 9:].split()]
    lamps, lumens, multiplier, polar_count, plane_count = (numbers[k] for k in range(5))
    start = 13
    polar = numbers[start:start + int(polar_count)]
    planes = numbers[start + len(polar):start + len(polar) + int(plane_count)]
    rows = numbers[start + len(polar) + len(planes):]
    assert len(rows) == len(polar) * len(planes) and planes[-1] == 90
    return lamps * lumens, multiplier * integrate(polar, planes, rows)


def eulumdat_flux(path):
    """The same of a EULUMDAT file that is symmetric about both axes."""
    lines = path.read_text().splitlines()
    assert lines[2] == "4" and lines[25] == "1"
    plane_count, polar_count = int(lines[3]), int(lines[5])
    first = 42
    planes = [float(word) for word in lines[first:first + plane_count // 4 + 1]]
    polar = [float(word) for word in lines[first + plane_count:first + plane_count + polar_count]]
    rows = [float(word) for word in lines[first + plane_count + polar_count:]]
    assert len(rows) == len(polar) * len(planes) and planes[-1] == 90
    flux = float(lines[28])
    return flux * float(lines[22]) / 100, flux / 1000 * integrate(polar, planes, rows)


def integrate(polar_deg, planes_deg, rows, steps=40):
    """Four times the integral over a quarter, linear in both angles, by the midpoint rule in gamma."""
    total = 0.0
    for k in range(len(planes_deg) - 1):
        left, right = (rows[len(polar_deg) * plane:len(polar_deg) * (plane + 1)] for plane in (k, k + 1))
        mean = [(a + b) / 2 for a, b in zip(left, right)]
        for j in range(len(polar_deg) - 1):
            low, step = polar_deg[j], (polar_deg[j + 1] - polar_deg[j]) / steps
            for i in range(steps):
                zone = cos(radians(low + i * step)) - cos(radians(low + (i + 1) * step))
                value = mean[j] + (mean[j + 1] - mean[j]) * (i + 0.5) / steps
                total += value * zone * radians(planes_deg[k + 1] - planes_deg[k])
    return 4 * total


class Luminaire(unittest.TestCase):
    def test_stated_flux_is_the_integral(self):
        for flux, name in ((ies_flux, "luminaire.ies"), (eulumdat_flux, "luminaire.ldt")):
            stated, integral = flux(FOLDER / name)
            self.assertAlmostEqual(integral / stated, 1, delta=0.005, msg=name)

    def test_both_files_say_the_same(self):
        ies, eulumdat = ies_flux(FOLDER / "luminaire.ies")[1], eulumdat_flux(FOLDER / "luminaire.ldt")[1]
        self.assertAlmostEqual(ies / eulumdat, 1, delta=1e-5)


if __name__ == "__main__":
    unittest.main()
