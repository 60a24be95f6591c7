"""stilb measure: areas, derived values, requirements and their exit codes, replicates."""

import csv
import json
import math
import re
import statistics
import tempfile
import unittest
from pathlib import Path

from command_line import ROOM, CommandLineTest, run

RATINGS = """
[sensors.task]
type = "area"
corners = [[0.6, 0.6], [3.4, 0.6], [3.4, 2.2], [0.6, 2.2]]
height = 0.75
spacing = 0.4
surround = 0.4

[sensors.ratio]
type = "derived"
value = "desk.mean / wall"
"""


def requiring(text):
    return ROOM.replace("count = [3, 2]", f"count = [3, 2]\nrequire = {text}")


class RatingsTest(CommandLineTest):
    def test_areas_and_derived_values(self):
        self.scene = self.write("ratings.toml", ROOM + RATINGS)
        document = self.measure("--paths", "4096")
        self.assertNotIn("verdict", document)
        desk, wall, task, surround, ratio = document["sensors"]
        self.assertEqual((task["name"], surround["name"]), ("task", "task.surround"))
        self.assertEqual((task["type"], task["quantity"], task["unit"]), ("area", "illuminance", "lx"))
        self.assertAlmostEqual(task["spacing_m"][0], 0.4)
        self.assertEqual(len(task["values"]) + task["left_out"], 7 * 4)
        self.assertEqual(task["left_out"], 1)  # in the cabinet
        self.assertLess(task["summary"]["diversity"], task["summary"]["uniformity"])
        self.assertNotIn("summary", ratio)
        self.assertEqual((ratio["type"], ratio["unit"], ratio["formula"]), ("derived", "", "desk.mean / wall"))
        (value,) = ratio["values"]
        self.assertEqual(set(value), {"value", "standard_error", "interval"})
        self.assertAlmostEqual(value["value"], desk["summary"]["mean"] / wall["values"][0]["value"], 12)
        self.assertGreater(value["standard_error"], 0)
        table = run("measure", self.scene, "--paths", "4096").stdout
        self.assertRegex(table, r"\ntask +27 points 0\.4 m x 0\.4 m apart \(1 hidden one left out\); 95 % of the ")
        self.assertRegex(table, r"   diversity 0\.[0-9]+ ± 0\.[0-9]+\n")
        self.assertRegex(table, r"\nratio +[0-9.]+ ± [0-9.]+   desk\.mean / wall\n")

    def test_installed_power(self):
        known = ROOM.replace("flux = 1000", "flux = 1000\npower = 11.2")
        self.scene = self.write("power.toml", known + RATINGS)
        document = self.measure("--paths", "4096")
        power, task = document["power"], document["sensors"][2]
        self.assertEqual((power["installed_w"], power["unknown"]), (11.2, []))
        self.assertAlmostEqual(power["task_area_m2"], 2.8 * 1.6)  # without the band around it
        self.assertAlmostEqual(power["w_m2"], 11.2 / (2.8 * 1.6))
        (room,) = power["rooms"]  # with the cabinet, which is furniture
        self.assertAlmostEqual(room["floor_m2"], 12, 3)
        self.assertAlmostEqual(room["w_m2"], 11.2 / 12, 3)
        self.assertEqual((room["installed_w"], room["lamps_of_unknown_power"]), (11.2, 0))
        per_100_lx = 100 * power["w_m2"] / task["summary"]["mean"]
        self.assertAlmostEqual(power["w_m2_per_100_lx"], per_100_lx)
        low, high = task["summary"]["mean_interval"]
        relative = (high - low) / 2 / task["summary"]["mean"]
        low, high = power["w_m2_per_100_lx_interval"]
        self.assertAlmostEqual((high - low) / 2 / per_100_lx, relative, 6)
        table = run("measure", self.scene, "--paths", "4096").stdout
        self.assertRegex(table, r"\nInstalled power: 11\.2 W; 0\.933 W/m² of the room's floor \(12 m²\); 2\.5 W/m² of the task area \(4\.48 m²\), "
                                r"[0-9.]+ ± [0-9.]+ W/m² per 100 lx\n")
        report = json.loads(run("info", self.scene, "--json").stdout)
        self.assertEqual(report["lights"][0]["power_w"], 11.2)
        self.assertEqual(report["power"], {key: power[key] for key in ("installed_w", "unknown", "task_area_m2", "w_m2")})
        self.assertIn("\nInstalled power: 11.2 W; 2.5 W/m2 of the task area (4.48 m2)\n", run("info", self.scene).stdout)

    def test_unknown_power(self):
        self.scene = self.write("power.toml", ROOM + RATINGS)
        self.assertEqual(self.measure("--paths", "4096")["power"], {"installed_w": None, "unknown": ["bulb"]})
        unknown = "\nInstalled power: not known: no lamp and no luminaire file states it\n"
        self.assertIn(unknown, run("measure", self.scene, "--paths", "4096").stdout)
        self.assertIn(unknown, run("info", self.scene).stdout)
        spot = "[lights.spot]\ntype = \"point\"\nposition = [1, 2, 2]\nflux = 10\npower = 2\n"
        self.scene = self.write("power.toml", ROOM + RATINGS + spot)
        self.assertIn("\nInstalled power: 2 W, without lamps of unknown power: bulb; 0.167 W/m² of the room's floor (12 m²); 0.446 W/m²",
                      run("measure", self.scene, "--paths", "4096").stdout)

    def test_csv_of_derived_values(self):
        self.scene = self.write("ratings.toml", ROOM + RATINGS)
        with tempfile.TemporaryDirectory() as folder:
            self.measure("--paths", "4096", "--csv", folder)
            with (Path(folder) / "ratio.csv").open(newline="") as file:
                rows = list(csv.reader(file))
            self.assertTrue((Path(folder) / "task.surround.csv").exists())
        self.assertEqual(rows[0], ["derived_value", "standard_error", "interval_low", "interval_high"])
        self.assertEqual(len(rows), 2)

    def test_one_derived_value_measures_what_it_needs(self):
        self.scene = self.write("ratings.toml", ROOM + RATINGS)
        document = self.measure("--paths", "4096", "--sensor", "ratio")
        self.assertEqual([s["name"] for s in document["sensors"]], ["ratio", "desk", "wall"])

    def test_replicates(self):
        self.scene = self.write("ratings.toml", ROOM + RATINGS)
        document = self.measure("--paths", "4096", "--replicates")
        for sensor in document["sensors"]:
            for value in sensor["values"]:
                replicates = value["replicates"]
                self.assertEqual(len(replicates), document["replicates"])
                self.assertAlmostEqual(statistics.fmean(replicates), value["value"], 9)
                error = statistics.stdev(replicates) / len(replicates) ** 0.5
                self.assertAlmostEqual(error, value["standard_error"], 9)
        self.assertNotIn("replicates", self.measure("--paths", "4096")["sensors"][0]["values"][0])
        self.expect_wrong_input(["measure", self.scene, "--replicates"], "give --json or -o as well")

    def test_requirements_are_the_exit_code_of_a_check(self):
        for text, code, verdict in (("{ mean = 1, uniformity = 0.01 }", 0, "pass"), ("{ mean = 1, minimum = 1e5 }", 1, "fail"),
                                    ("{ maximum = 1 }", 1, "fail")):
            with self.subTest(text=text):
                self.scene = self.write("required.toml", requiring(text))
                document = self.measure("--check", code=code)
                self.assertEqual((document["verdict"], document["stopped"]), (verdict, "requirements decided"))
                self.assertIs(document["converged"], True)
                self.assertEqual(document["sensors"][0]["requirements"][-1]["verdict"], verdict)
                self.measure()  # without --check, a fail is a result
        table = run("measure", self.scene, "--check").stdout
        self.assertRegex(table, r"\n    required: maximum at most 1 lx: fail\n")
        self.assertRegex(table, r": all requirements are decided; error [^\n]+\nRequirements: 1 fail\n$")

    def test_a_check_of_glare(self):
        glare = """
[lights.globe]
type = "sphere"
center = [2, 2.4, 2.1]
radius = 0.1
flux = 1000

[sensors.eye]
type = "ugr"
position = [2, 1.6, 1.2]
direction = [0, 1, 0]
"""
        for limit, code, verdict in ((40, 0, "pass"), (3, 1, "fail")):
            with self.subTest(limit=limit):
                self.scene = self.write("glare.toml", ROOM + glare + f"require = {{ ugr = {limit} }}\n")
                document = self.measure("--check", code=code)
                self.assertEqual((document["verdict"], document["stopped"]), (verdict, "requirements decided"))
                (requirement,) = document["sensors"][-1]["requirements"]
                self.assertEqual((requirement["key"], requirement["at_most"]), ("ugr", limit))
                self.assertEqual(requirement["value"], document["sensors"][-1]["values"][0]["value"])
        table = run("measure", self.scene, "--check").stdout
        self.assertRegex(table, r"\n    required: ugr at most 3: fail\n")
        # An error that is asked for is reached, though all is decided before.
        document = self.measure("--check", "--error", "1%", code=1)
        self.assertEqual((document["verdict"], document["stopped"]), ("fail", "target reached"))
        # The bulb, which is a point, is in view.
        self.scene = self.write("glare.toml", ROOM + glare.replace("1.6, 1.2", "0.3, 1.2") + "require = { ugr = 40 }\n")
        document = self.measure("--check", code=3)
        self.assertEqual((document["verdict"], document["stopped"]), ("not sure", "requirements decided"))
        (requirement,) = document["sensors"][-1]["requirements"]
        self.assertEqual((requirement["verdict"], requirement["reason"]),
                         ("not sure", 'light "bulb" has no luminous area'))
        (view,) = document["sensors"][-1]["glare"]
        self.assertEqual([(s["light"], s["counted"], s.get("remark")) for s in view["sources"]],
                         [("globe", True, None), ("bulb", False, "no luminous area")])

    def test_small_downlights_and_those_above_the_eye(self):
        """Six downlights of I = 1000 cd cos gamma, 1.79 m above an eye; a rating by hand."""
        room = """
[materials.w]
type = "diffuse"
reflectance = 0.5
[objects.room]
shape = "box"
min = [0, 0, 0]
max = [8, 5, 3]
material = "w"
[lights.d]
type = "photometry"
file = "spot.ies"
positions = [[4.5, 1.25, 2.99], [4.5, 3.75, 2.99], [6, 1.25, 2.99], [6, 3.75, 2.99], [7.5, 1.25, 2.99], [7.5, 3.75, 2.99]]
[sensors.eye]
type = "ugr"
position = [0.5, 2.5, 1.2]
direction = [1, 0, 0]
require = { ugr = LIMIT }
[sensors.front]
type = "illuminance"
position = [0.5, 2.5, 1.2]
normal = [1, 0, 0]
"""
        def write(limit, diameter, scene=room):
            # 10 degrees apart: at most 0.4 % from the cosine.
            angles = range(0, 91, 10)
            candela = " ".join(f"{1000 * math.cos(math.radians(a)):.3f}" for a in angles)
            self.write("spot.ies", "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 10 1 1 2 "
                       f"{-diameter} {-diameter} 0\n1 1 30\n{' '.join(map(str, angles))}\n0\n{candela}\n")
            self.scene = self.write("spots.toml", scene.replace("LIMIT", str(limit)))

        def by_hand(diameter, total_lx):
            glare, direct_lx = 0, 0
            for across in (-1.25, 1.25):
                for along in (4, 5.5, 7):
                    squared = along ** 2 + across ** 2 + 1.79 ** 2
                    cosine = 1.79 / math.sqrt(squared)  # gamma from the nadir
                    intensity, area = 1000 * cosine, math.pi / 4 * diameter ** 2 * cosine
                    s = math.degrees(math.atan2(math.hypot(across, 1.79), along))
                    t = math.degrees(math.atan2(abs(across), 1.79))
                    index = math.exp((35.2 - 0.31889 * t - 1.22 * math.exp(-2 * t / 9)) * 1e-3 * s
                                     + (21 + 0.26667 * t - 0.002963 * t ** 2) * 1e-5 * s ** 2)
                    glare += (intensity / area) ** 2 * area / squared / index ** 2
                    direct_lx += intensity * along / squared ** 1.5
            return 8 * math.log10(0.25 * glare * math.pi / (total_lx - direct_lx))

        write(19, 0.06)  # 5e-5 sr and less
        document = self.measure("--check", "--paths", "16384", code=3)
        eye, front = document["sensors"]
        total_lx = front["values"][0]["value"]
        (requirement,) = eye["requirements"]
        self.assertEqual((document["verdict"], requirement["verdict"]), ("not sure", "not sure"))
        self.assertEqual(eye["values"][0]["value"], 0)
        rating = float(re.search(r"less than 0\.0003 sr, .* left out: with it the rating is ([\d.]+)", requirement["reason"])[1])
        self.assertAlmostEqual(rating, by_hand(0.06, total_lx), delta=0.15)
        self.assertEqual([(s["counted"], s["remark"]) for s in eye["glare"][0]["sources"]], [(False, "less than 0.0003 sr")] * 6)
        table = run("measure", self.scene, "--paths", "2048").stdout
        self.assertIn('\n    not counted: "d_1" and 5 more (less than 0.0003 sr)\n    required: ugr at most 19: not sure (light "d_1" and 5 more ', table)
        # Larger ones count, and one steeply above the eye (H / R = 1.99) does not, in spite of all its light.
        write(19, 0.3, room.replace("positions = [", "positions = [[1.4, 2.5, 2.99], "))
        document = self.measure("--check", "--paths", "16384", code=1)
        eye, front = document["sensors"]
        above = 1000 * 1.79 * 0.9 / (0.9 ** 2 + 1.79 ** 2) ** 2  # I cos / d^2 at the eye
        self.assertAlmostEqual(eye["values"][0]["value"], by_hand(0.3, front["values"][0]["value"] - above), delta=0.15)
        self.assertEqual([(s["light"], s.get("remark")) for s in eye["glare"][0]["sources"] if not s["counted"]],
                         [("d_1", "outside of the field of view")])

    def test_what_is_not_sure_yet(self):
        self.scene = self.write("free.toml", ROOM)
        mean = self.measure("--error", "0.2%")["sensors"][0]["summary"]["mean"]
        self.scene = self.write("required.toml", requiring(f"{{ mean = {mean} }}"))
        document = self.measure("--check", "--paths", "2048", "--seed", "3", code=3)
        self.assertEqual((document["verdict"], document["stopped"]), ("not sure yet", "paths done"))
        (requirement,) = document["sensors"][0]["requirements"]
        low, high = requirement["interval"]
        self.assertTrue(low < mean < high)
        self.assertEqual((requirement["key"], requirement["at_least"]), ("mean", mean))
        self.measure("--paths", "2048", "--seed", "3")  # exit code 0

    def test_a_check_needs_requirements(self):
        self.expect_wrong_input(["measure", self.scene, "--check"], "no measured sensor has a key \"require\"")

    def test_target(self):
        readings, mean = (self.measure("--error", "1%", "--target", name) for name in ("readings", "mean"))
        self.assertEqual(readings["attained_error"], max(s["attained_error"] for s in readings["sensors"]))
        widths = []
        for sensor in mean["sensors"]:
            for key in ("mean", "minimum"):
                low, high = sensor["summary"][f"{key}_interval"]
                widths.append((high - low) / 2 / sensor["summary"][key])
        self.assertAlmostEqual(mean["attained_error"], max(widths), 12)
        self.assertLessEqual(mean["attained_error"], 0.01)
        self.expect_wrong_input(["measure", self.scene, "--target", "men"], 'Did you mean "mean"?')

    def test_info_shows_formulas_and_limits(self):
        self.scene = self.write("ratings.toml", requiring("{ mean = 500 }") + RATINGS)
        document = json.loads(run("info", self.scene, "--json").stdout)
        desk, _, task, _, ratio = document["sensors"]
        self.assertEqual(desk["require"], {"mean": 500})
        self.assertEqual(task["left_out"], 1)
        self.assertEqual((ratio["formula"], ratio["unit"]), ("desk.mean / wall", ""))
        text = run("info", self.scene).stdout
        self.assertRegex(text, r"\n  desk +grid +3 x 2 points, .*, required: mean 500\n")
        self.assertRegex(text, r"\n  ratio +derived +desk\.mean / wall\n")


if __name__ == "__main__":
    unittest.main()
