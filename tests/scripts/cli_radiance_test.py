"""Radiance scenes on the command line: info, points and lines of rtrace, other commands."""

import subprocess
import unittest

from command_line import PROGRAM, ROOT, CommandLineTest, run

BOX = """
void plastic wall 0 0 5 .5 .4 .3 0 0
void light lamp 0 0 3 10 8 6
!genbox wall room 4 3 2.5 -i
lamp polygon panel 0 0 12  1.5 1 2.49  1.5 2 2.49  2.5 2 2.49  2.5 1 2.49
"""
POINTS = "2 1.5 0.75 0 0 1\n0.01 1.5 1 1 0 0\n"
DATA = ROOT / "tests/data/radiance"


def numbers(text):
    return [[float(word) for word in line.split()] for line in text.splitlines()]


class RadianceTest(CommandLineTest):
    def setUp(self):
        super().setUp()
        self.rad = self.write("box.rad", BOX)
        self.points = self.write("grid.pts", POINTS)

    def test_info_states_units_and_weights(self):
        result = run("info", self.rad)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("179 lm/W times 0.265 R + 0.67 G + 0.065 B", result.stdout)
        self.assertIn("panel            area", result.stdout)

    def test_lines_of_rtrace_have_the_illuminances_of_the_table(self):
        common = ["measure", self.rad, "--points", self.points, "--paths", "8192"]
        result = run(*common, "--format", "radiance")
        self.assertEqual(result.returncode, 0, result.stderr)
        lines = numbers(result.stdout)
        self.scene = self.rad
        values = self.measure("--points", self.points, "--paths", "8192")["sensors"][0]["values"]
        self.assertEqual(len(lines), 2)
        for (red, green, blue), value in zip(lines, values):
            self.assertAlmostEqual(179 * (0.265 * red + 0.67 * green + 0.065 * blue), value["value"],
                                   delta=1e-5 * value["value"])
            self.assertGreater(red, green)
        piped = subprocess.run([PROGRAM, *map(str, common[:-3]), "-", "--paths", "8192", "--format", "radiance"],
                               input=POINTS, capture_output=True, text=True, timeout=60)
        self.assertEqual(piped.stdout, result.stdout, piped.stderr)

    def test_points_are_measured_in_scenes_of_stilb(self):
        result = run("measure", self.scene, "--points", self.points, "--paths", "1024", "--format", "radiance")
        self.assertEqual(len(numbers(result.stdout)), 2, result.stderr)
        both = run("measure", self.scene, "--points", self.points, "--sensor", "desk", "--sensor", "points",
                   "--paths", "1024")
        self.assertIn("desk", both.stdout)
        self.assertIn("points", both.stdout)

    def test_wrong_input_is_named(self):
        measure = ["measure", self.rad]
        self.expect_wrong_input([*measure, "--points", self.points, "--set", "materials.red.reflectance=0.1"],
                                "only keys of import, run and sensors")
        self.expect_wrong_input([*measure, "--points", self.points, "--format", "rad"], "--format rad",
                                "Allowed: radiance")
        self.expect_wrong_input([*measure, "--points", self.points, "--format", "radiance", "--json"],
                                "standard output")
        self.expect_wrong_input(["measure", "-", "--points", "-"], "both")
        self.expect_wrong_input([*measure, "--points", self.write("bad.pts", "1 2 3\n")], "bad.pts:1: found 3 numbers")
        self.expect_wrong_input(["info", self.write("bad.rad", "\n!gensurf 6 21 12\n")], "bad.rad:2:", '"gensurf"')

    def test_views_of_radiance_are_cameras(self):
        view = self.write("nice.vf", "rvu -vtv -vp 0.3 0.3 1.6 -vd 1 0.7 -0.2 -vu 0 0 1 -vh 70 -vv 50 -vs 0.1 "
                                     "-x 60 -y 60\n")
        picture = self.folder / "nice.hdr"
        result = run("render", self.rad, "--view", view, "-o", picture, "--paths", "2")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("nice: 60 x 40 pixels", result.stdout)
        self.assertIn("the shift (-vs)", result.stderr)
        again = run("render", self.rad, "--view", picture, "-o", self.folder / "again.hdr", "--paths", "2")
        self.assertIn("nice: 60 x 40 pixels", again.stdout, again.stderr)
        self.assertEqual(result.stdout.splitlines()[:2], again.stdout.splitlines()[:2])
        imported = run("import", self.rad, "-o", self.folder / "box", "--view", view)
        self.assertIn("1 sensor in", imported.stdout, imported.stderr)
        self.expect_wrong_input(["render", self.rad, "--view", view, "--sensor", "nice", "-o", picture], "--sensor")
        self.expect_wrong_input(["render", self.rad, "--view", self.rad, "-o", picture], "there is no view")
        self.expect_wrong_input(["render", self.rad, "--view", picture, "-o", picture], "nice.hdr")

    def test_scale_and_upward_axis_hold_for_points_and_views(self):
        """The box in centimetres with y upwards: z = -y."""
        rad = self.write("y_up.rad", BOX.split("!genbox")[0] + "!xform -rx -90 -s 100 part.rad\n")
        self.write("part.rad", "!genbox" + BOX.split("!genbox")[1])
        points = self.write("y_up.pts", "200 75 -150 0 1 0\n1 100 -150 1 0 0\n")
        view = self.write("y_up.vf", "rvu -vp 30 160 -30 -vd 1 -0.2 -0.7 -vu 0 1 0 -vh 70 -vv 50 -x 60 -y 60\n")
        straight = self.write("z_up.vf", "rvu -vp 0.3 0.3 1.6 -vd 1 0.7 -0.2 -vh 70 -vv 50 -x 60 -y 60\n")
        placed = ["--set", "import.scale=0.01", "--set", "import.up=y"]

        def lines(scene, pts, *more):
            result = run("measure", scene, "--points", pts, "--paths", "4096", "--format", "radiance", *more)
            return numbers(result.stdout)

        for expected, found in zip(lines(self.rad, self.points), lines(rad, points, *placed), strict=True):
            for a, b in zip(expected, found):
                self.assertAlmostEqual(a, b, delta=1e-3 * a)

        def mean(scene, vf, *more):
            picture = self.folder / "view.hdr"
            result = run("render", scene, "--view", vf, "-o", picture, "--paths", "64", *more)
            return float(result.stdout.split("mean luminance")[1].split()[0])

        self.assertAlmostEqual(mean(self.rad, straight), mean(rad, view, *placed), delta=1)
        bright = lines(rad, points, *placed, "--set", "import.light_scale=2")
        self.assertAlmostEqual(bright[0][0], 2 * lines(rad, points, *placed)[0][0], delta=1e-6 * bright[0][0])

    def test_solutions_remember_all_files_of_a_scene(self):
        part = self.write("part.rad", "wall sphere ball 0 0 4  2 1.5 0.3 0.2\n")
        scene = self.write("whole.rad", BOX + "!xform -t 0.5 0 0 part.rad\n")
        solution = self.folder / "a.solution"
        result = run("solve", scene, "-o", solution, "--paths", "16", "--patch", "1")
        self.assertEqual(result.returncode, 0, result.stderr)
        part.write_text("wall sphere ball 0 0 4  2 1.5 0.3 0.1\n")
        self.expect_wrong_input(["view", solution, "-o", self.folder / "a.html"], "have changed")

    def test_the_furnished_room_is_exported_again(self):
        result = run("export", DATA / "room.rad", "--format", "radiance", "-o", self.folder / "again")
        self.assertEqual(result.returncode, 0, result.stderr)


if __name__ == "__main__":
    unittest.main()
