"""--set, which overrides keys of the scene file; results on standard output; progress off a terminal."""

import json
import subprocess
import unittest

from command_line import CAMERA, PROGRAM, ROOM, CommandLineTest, run


class OverridesTest(CommandLineTest):
    def test_values_replace_those_of_the_scene_file(self):
        dark = self.measure("--paths", "2048", "--set", "materials.wall.reflectance=0")
        exact = self.measure("--bounces", "0", "--paths", "2048")
        for one, other in zip(dark["sensors"], exact["sensors"]):
            for a, b in zip(one["values"], other["values"]):
                self.assertAlmostEqual(a["value"], b["value"], delta=1e-6 * b["value"])

    def test_values_equal_those_written_into_the_file(self):
        given = self.measure("--paths", "2048", "--set", "sensors.desk.count=[1, 2]", "--set", "lights.bulb.flux = 500",
                             "--set", "run.method=path")
        self.scene = self.write("room.toml", ROOM.replace("[3, 2]", "[1, 2]").replace("1000", "500"))
        written = self.measure("--paths", "2048", "--method", "path")
        self.assertEqual(given["sensors"], written["sensors"])

    def test_whole_tables_are_added(self):
        seat = 'sensors.seat={type="illuminance", position=[2, 2, 1], normal=[0, 0, 1]}'
        measured = self.measure("--paths", "2048", "--set", seat, "--set", seat.replace("seat", "\"a seat\""))
        self.assertEqual([sensor["name"] for sensor in measured["sensors"]], ["desk", "wall", "seat", "a seat"])
        changed = self.measure("--paths", "2048", "--set", seat, "--set", "sensors.seat.position=[3, 2, 1]")
        self.assertEqual(changed["sensors"][2]["values"][0]["position"], [3, 2, 1])

    def test_wrong_ones_are_named(self):
        def refused(override, *parts):
            for command in ("measure", "info"):
                self.expect_wrong_input([command, self.scene, "--set", override], *parts)
        refused("materials.wal.reflectance=0.4", "the scene has no materials.wal.", 'Did you mean "wall"?')
        refused("materials.wall.reflectanc=0.4", 'unknown key "reflectanc"', 'Did you mean "reflectance"?')
        refused("materials.wall.reflectance=1.4", "materials.wall.reflectance: 1.4 is not allowed")
        refused("materials.wall.reflectance", "a key and a value are needed")
        refused("materials.wall.reflectance=[1", "not valid TOML")
        refused("material.wall.reflectance=1", 'unknown key "material"')

    def test_a_solution_belongs_to_its_values(self):
        self.scene = self.write("view.toml", ROOM + CAMERA)
        solution, picture = self.folder / "a.solution", self.folder / "a.png"
        darker = ["--set", "materials.wall.reflectance=0.2", "--set", "sensors.view.resolution=[20, 20]"]
        solved = run("solve", self.scene, "-o", solution, "--paths", "16", "--patch", "1", *darker)
        self.assertEqual(solved.returncode, 0, solved.stderr)
        self.expect_wrong_input(["render", "--from", solution, "-o", picture], "have changed since the scene was solved")
        rendered = run("render", "--from", solution, "-o", picture, *darker)
        self.assertEqual(rendered.returncode, 0, rendered.stderr)


class StandardOutputTest(CommandLineTest):
    def test_json_goes_where_it_is_sent(self):
        file = self.folder / "a.json"
        measure = ["measure", self.scene, "--paths", "2048", "--quiet"]
        alone = [run(*measure, *flags) for flags in (["--json"], ["--json", "-"], ["-o", "-"])]
        alone.append(run("measure", "--paths", "2048", "--quiet", "--json", self.scene))
        beside = run(*measure, "--json", file)
        self.assertTrue(beside.stdout.startswith("Illuminance"), beside)
        expected = json.loads(file.read_text())["sensors"]
        for result in alone:
            self.assertEqual(json.loads(result.stdout)["sensors"], expected)
        self.assertFalse((self.folder / "-").exists())

    def test_pictures_and_solutions_go_to_pipes(self):
        self.scene = self.write("view.toml", ROOM + CAMERA)
        def output(*arguments, given=None):
            result = subprocess.run([PROGRAM, *map(str, arguments)], input=given, capture_output=True, check=True, cwd=self.folder)
            return result.stdout
        document = output("measure", self.scene, "--paths", "2048", "-o", "-")
        self.assertTrue(output("falsecolor", "-", "-o", "-", given=document).startswith(b"\x89PNG"))
        small = ["--set", "sensors.view.resolution=[20, 20]", "--paths", "2", "-o", "-"]
        self.assertTrue(output("render", self.scene, *small).startswith(b"\x76\x2f\x31\x01"))
        self.assertTrue(output("solve", self.scene, "--paths", "16", "--patch", "1", "-o", "-").startswith(b"STILB"))
        self.assertEqual([path.name for path in self.folder.iterdir() if path.name == "-"], [])


class ProgressTest(CommandLineTest):
    def test_plain_lines_off_a_terminal(self):
        silent = run("measure", self.scene, "--error", "0.0001%", "--time", "2")
        told = run("measure", self.scene, "--error", "0.0001%", "--time", "2", "--progress")
        self.assertNotRegex(silent.stderr, r"\d paths")
        self.assertRegex(told.stderr, r"(?m)^\d+\.\d s  \d+ samples  error [\d.]+ %")
        self.assertNotIn("\033", told.stderr)


class OpenGlTest(CommandLineTest):
    def test_ends_in_order(self):
        """Threads that used OpenGL end together with the program."""
        command = ["measure", self.scene, "--method", "ray-bundle", "--visibility", "opengl", "--paths", "64", "--patch", "1"]
        first = run(*command)
        if "OpenGL is not available" in first.stderr:
            self.skipTest("there is no OpenGL here")
        for _ in range(3):
            result = run(*command)
            self.assertIn(result.returncode, (0, 3), result.stderr)


if __name__ == "__main__":
    unittest.main()
