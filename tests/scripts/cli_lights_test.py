"""Lights in the scene file: arrays, maintenance factors, lamps that are faces of a mesh."""

import json
import math
import unittest

from command_line import CAMERA, ROOM, CommandLineTest, run

BULB = 'position = [2, 1.5, 2]\nflux = 1000'
ARRAY = 'array = { origin = [1, 1, 2], step_u = [2, 0, 0], step_v = [0, 1, 0], count = [2, 2] }\nflux = 250'
POSITIONS = [(1, 1), (3, 1), (1, 2), (3, 2)]

# A room seen from inside; its ceiling has a lamp of 1 m2 in the middle.
LIT_ROOM = """
v 0 0 0
v 3 0 0
v 3 3 0
v 0 3 0
v 0 0 2.5
v 3 0 2.5
v 3 3 2.5
v 0 3 2.5
v 1 1 2.5
v 2 1 2.5
v 2 2 2.5
v 1 2 2.5
usemtl plaster
f 1 2 3 4
f 1 5 6 2
f 2 6 7 3
f 3 7 8 4
f 4 8 5 1
f 5 9 10 6
f 6 10 11 7
f 7 11 12 8
f 8 12 9 5
g lamps
usemtl lamp_glass
f 9 12 11 10
"""
LIT_ROOM_SCENE = """
[materials.white]
type = "diffuse"
reflectance = 0.7
[objects.room]
shape = "mesh"
file = "room.obj"
material = "white"
[lights.panel]
type = "area"
object = "room"
flux = 3000
PART
[sensors.desk]
type = "grid"
corner = [0.5, 0.5, 0.75]
edge_u = [2, 0, 0]
edge_v = [0, 2, 0]
count = [4, 4]
[sensors.lamp]
type = "luminance"
position = [1, 0.5, 1.2]
target = [1.5, 1.5, 2.5]
"""


def values(document):
    return [reading["value"] for sensor in document["sensors"] for reading in sensor["values"]]


class ArrayTest(CommandLineTest):
    def test_an_array_is_as_many_lights(self):
        self.scene = self.write("array.toml", ROOM.replace(BULB, ARRAY))
        array = self.measure("--paths", "4096")
        lights = "".join(f'[lights.bulb_{i + 1}]\ntype = "point"\nposition = [{x}, {y}, 2]\nflux = 250\n'
                         for i, (x, y) in enumerate(POSITIONS))
        self.scene = self.write("four.toml", ROOM.replace('[lights.bulb]\ntype = "point"\n' + BULB, lights))
        self.assertEqual(self.measure("--paths", "4096")["sensors"], array["sensors"])

    def test_grids_are_copied(self):
        grids = ROOM.replace("corner = [1.5, 1, 0.75]", "positions = [[1.5, 1, 0.75], [1.5, 1, 1.5]]")
        self.scene = self.write("grids.toml", grids)
        document = self.measure("--paths", "4096")
        self.assertEqual([s["name"] for s in document["sensors"]], ["desk_1", "desk_2", "wall"])
        self.assertEqual([s["name"] for s in self.measure("--paths", "4096", "--sensor", "desk_2")["sensors"]], ["desk_2"])

    def test_a_solution_dims_the_copies_together(self):
        self.scene = self.write("array.toml", ROOM.replace(BULB, ARRAY) + CAMERA.replace("[640, 480]", "[16, 12]"))
        solution = self.folder / "a.solution"
        solved = run("solve", self.scene, "-o", solution, "--paths", "64", "--patch", "1")
        self.assertEqual(solved.returncode, 0, solved.stderr)
        self.assertIn("1 group of lights", solved.stdout)
        rendered = run("render", "--from", solution, "-o", self.folder / "a.png", "--set", "bulb=0.5")
        self.assertEqual(rendered.returncode, 0, rendered.stderr)
        self.expect_wrong_input(["render", "--from", solution, "-o", self.folder / "a.png", "--set", "bulb_2=0.5"], "bulb")

    def test_wrong_arrays_are_named(self):
        scene = self.write("wrong.toml", ROOM.replace(BULB, ARRAY.replace("step_u", "stepu")))
        self.expect_wrong_input(["measure", scene], "lights.bulb.array", 'Did you mean "step_u"?')


class MaintenanceTest(CommandLineTest):
    def test_it_is_a_factor_and_said(self):
        new = self.measure("--paths", "4096")
        self.assertNotIn("maintenance", new)
        aged = self.measure("--paths", "4096", "--set", "run.maintenance=0.8")
        self.assertEqual(aged["maintenance"], [0.8, 0.8])
        for one, other in zip(values(aged), values(new), strict=True):
            self.assertAlmostEqual(one, 0.8 * other, delta=1e-6 * other)
        table = run("measure", self.scene, "--paths", "4096", "--set", "run.maintenance=0.8").stdout
        self.assertTrue(table.startswith("Maintained illuminance (maintenance factor 0.8), with 95 % intervals"), table)
        info = run("info", self.scene, "--set", "run.maintenance=0.8").stdout
        self.assertIn("Lights (1), 800 lm in all (maintenance factor 0.8)", info)

    def test_of_a_lamp(self):
        aged = self.measure("--paths", "4096", "--set", "lights.bulb.maintenance=0.5", "--set", "run.maintenance=0.8")
        self.assertEqual(aged["maintenance"], [0.5, 0.5])

    def test_pictures_say_it(self):
        scene = self.write("view.toml", ROOM + CAMERA.replace("[640, 480]", "[16, 12]") + "[run]\nmaintenance = 0.8\n")
        rendered = run("render", scene, "-o", self.folder / "view.exr", "--paths", "2")
        self.assertIn("maintained: maintenance factor 0.8", rendered.stdout)


class LampFacesTest(CommandLineTest):
    def scene_of(self, part):
        self.write("room.obj", LIT_ROOM)
        return self.write("lit.toml", LIT_ROOM_SCENE.replace("PART", part))

    def test_only_these_faces_shine(self):
        readings = []
        for part in ('material = "lamp_glass"', 'mesh_group = "lamps"'):
            self.scene = self.scene_of(part)
            report = json.loads(run("info", self.scene, "--json").stdout)
            self.assertEqual(report["warnings"], [])
            room, lamp = report["objects"]
            self.assertEqual((room["triangles"], room["closed"]), (18, True))
            self.assertEqual((lamp["triangles"], lamp["area_m2"]), (2, 1))
            self.assertAlmostEqual(report["lights"][0]["flux_lm"], 3000)
            document = self.measure("--error", "0.01", "--time", "20")
            self.assertEqual(document["warnings"], [])
            readings.append(values(document))
        self.assertEqual(*readings)
        emitted = 3000 / math.pi
        self.assertGreater(readings[0][-1], emitted)
        self.assertLess(readings[0][-1], 1.3 * emitted)

    def test_a_whole_room_as_a_lamp_is_suspicious(self):
        self.scene = self.scene_of("")
        warnings = json.loads(run("info", self.scene, "--json").stdout)["warnings"]
        self.assertRegex(warnings[0], 'light "panel": the whole of object "room" shines, 48 m2 of a closed surface, all '
                                      'around sensors "desk", "lamp"')


class WarningsTest(CommandLineTest):
    def test_measure_says_what_info_says(self):
        twice = ROOM + '[lights.again]\ntype = "point"\nposition = [2, 1.5, 2]\nflux = 500\n'
        lantern = ROOM + '[lights.lantern]\ntype = "point"\nposition = [2, 1.5, 3]\nflux = 500\n'
        for text, expected in ((twice, "are alike and in one place"), (lantern, 'is not inside object "room"')):
            self.scene = self.write("odd.toml", text)
            warnings = json.loads(run("info", self.scene, "--json").stdout)["warnings"]
            self.assertEqual(len(warnings), 1)
            self.assertIn(expected, warnings[0])
            self.assertEqual(self.measure("--paths", "2048")["warnings"], warnings)
            self.assertIn(warnings[0], run("measure", self.scene, "--paths", "2048").stderr)


if __name__ == "__main__":
    unittest.main()
