"""measure --vary: a table of variants, with paired differences; and light scenes on the command line."""

import csv
import json
import math
import unittest

from command_line import CAMERA, ROOM, CommandLineTest, run

SCENES = """
[lights.spot]
type = "point"
position = [1, 2, 2.2]
flux = 500
power = 10
group = "spots"

[scenes.evening]
spots = 0.5
bulb = [1, 0.5, 0.25]

[scenes.emergency]
others = 0
spot = 0.2
bounces = 0
sensors = ["wall"]
"""


class SweepTest(CommandLineTest):
    def sweep(self, *arguments):
        """The rows of the table, by values of the keys, sensor and statistic."""
        result = run("measure", self.scene, *arguments, "--csv", self.folder / "table.csv", "--quiet")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        with (self.folder / "table.csv").open(newline="") as file:
            return list(csv.DictReader(file))

    def test_a_row_for_each_statistic_of_each_variant(self):
        key = "materials.wall.reflectance"
        rows = self.sweep("--vary", f"{key}=0.3,0.5,0.7", "--paths", "4096")
        self.assertEqual([row[key] for row in rows if row["sensor"] == "wall"], ["0.3", "0.5", "0.7"])
        statistics = [row["statistic"] for row in rows if row["sensor"] == "desk" and row[key] == "0.3"]
        self.assertEqual(statistics, ["mean", "minimum", "maximum", "uniformity", "diversity"])
        for row in rows:
            number = {name: float(row[name]) for name in row if name.startswith(("value", "interval", "difference"))}
            self.assertLessEqual(number["interval_low"], number["value"])
            self.assertEqual(row["converged"], "true")
            if row[key] == "0.3":
                self.assertEqual([number["difference"], number["difference_low"], number["difference_high"]], [0, 0, 0])

    def test_differences_agree_with_single_runs_and_are_surer(self):
        rows = self.sweep("--vary", "materials.wall.reflectance=0.5,0.52", "--paths", "16384", "--sensor", "wall")
        single = [
            self.measure("--method", "path", "--paths", "262144", "--sensor", "wall", "--seed", seed, "--set", f"materials.wall.reflectance={value}")
            for seed, value in ((5, 0.5), (6, 0.52))
        ]
        readings = [result["sensors"][0]["values"][0] for result in single]
        expected = readings[1]["value"] - readings[0]["value"]
        error = math.hypot(*(reading["standard_error"] for reading in readings))
        difference, low, high = (float(rows[1][name]) for name in ("difference", "difference_low", "difference_high"))
        self.assertLess(abs(difference - expected), 4 * math.hypot(error, (high - low) / 4))
        # Unpaired, the difference of two such runs is as unsure as both together.
        unpaired = math.hypot(*(float(row["interval_high"]) - float(row["interval_low"]) for row in rows))
        self.assertLess(5 * (high - low), unpaired)
        # A 95 % interval of Student's t of 32 replicates: 2.04 standard errors on each side.
        self.assertAlmostEqual((high - low) / 2 / float(rows[1]["difference_standard_error"]), 2.04, delta=0.01)
        for row in rows:
            self.assertLess(0, float(row["standard_error"]))
            self.assertLess(float(row["standard_error"]), float(row["interval_high"]) - float(row["value"]))

    def test_readings_that_the_first_variant_lacks_have_no_difference(self):
        rows = self.sweep("--vary", "sensors.desk.count=[3, 2],[2, 2]", "--paths", "64", "--sensor", "desk")
        self.assertEqual([row["difference"] == "" for row in rows], 5 * [False] + 5 * [True])

    def test_light_is_not_kept_apart(self):
        result = run("measure", self.scene, "--vary", "materials.wall.reflectance=0.3,0.5", "--by", "light", "--paths", "64")
        self.assertEqual(result.returncode, 2)
        self.assertIn("--vary has one table of all light", result.stderr)

    def test_combinations_and_zip(self):
        keys = ["--vary", "materials.wall.reflectance=0.3,0.5", "--vary", "lights.bulb.flux=500,1000,2000"]
        rows = self.sweep(*keys, "--paths", "64", "--sensor", "wall")
        self.assertEqual([(row["materials.wall.reflectance"], row["lights.bulb.flux"]) for row in rows],
                         [(r, f) for r in ("0.3", "0.5") for f in ("500", "1000", "2000")])
        keys[-1] = "lights.bulb.flux=500,1000"
        self.assertEqual(len(self.sweep(*keys, "--zip", "--paths", "64", "--sensor", "wall")), 2)
        arrays = self.sweep("--vary", "sensors.wall.position=[4, 1.5, 1.2],[4, 1, 1]", "--paths", "64", "--sensor", "wall")
        self.assertEqual([row["sensors.wall.position"] for row in arrays], ["[4, 1.5, 1.2]", "[4, 1, 1]"])

    def test_wrong_input(self):
        wrong = self.expect_wrong_input
        wrong(["measure", self.scene, "--vary", "x"], "--vary x: expected KEY=VALUE,VALUE")
        wrong(["measure", self.scene, "--vary", "a=1,,2"], "expected KEY=VALUE,VALUE")
        wrong(["measure", self.scene, "--vary", "materials.wal.reflectance=0.2,0.3"], "the scene has no materials.wal")
        wrong(["measure", self.scene, "--vary", "run.seed=1,2", "--vary", "run.bounces=1", "--zip"], "give each key as many")
        wrong(["measure", self.scene, "--vary", "run.seed=1,2", "--json"], "--vary writes one table")
        wrong(["measure", self.scene, "--vary", "run.seed=1,2", "--check"], "--vary writes one table")


class LightScenesTest(CommandLineTest):
    def setUp(self):
        super().setUp()
        self.scene = self.write("room.toml", ROOM + SCENES)

    def test_results(self):
        document = self.measure("--paths", "4096", "--by", "light")
        self.assertEqual(list(document["scenes"]), ["evening", "emergency"])
        evening, emergency = document["scenes"].values()
        self.assertEqual([s["name"] for s in evening["sensors"]], ["desk", "wall"])
        self.assertEqual([s["name"] for s in emergency["sensors"]], ["wall"])
        self.assertEqual(evening["power"]["installed_w"], 5)
        self.assertEqual(emergency["power"]["installed_w"], 2)
        desk = document["sensors"][0]
        self.assertEqual([share["name"] for share in desk["shares"]], ["bulb", "spots"])
        for j, value in enumerate(desk["values"]):
            self.assertAlmostEqual(sum(share["values"][j]["value"] for share in desk["shares"]), value["value"], delta=1e-4)
        # Grey walls would make this the sum of shares times factors; these walls are red.
        green = [value["rgb"][1] for value in desk["values"]]
        self.assertTrue(all(value["rgb"][1] < g for value, g in zip(evening["sensors"][0]["values"], green)))

    def test_csv_has_a_folder_for_each(self):
        result = run("measure", self.scene, "--paths", "64", "--by", "bounce", "--csv", self.folder / "out", "--quiet")
        self.assertEqual(result.returncode, 0, result.stderr)
        files = sorted(str(path.relative_to(self.folder / "out")) for path in (self.folder / "out").rglob("*.csv"))
        self.assertEqual(files, ["desk.csv", "emergency/wall.csv", "evening/desk.csv", "evening/wall.csv", "wall.csv"])
        header = (self.folder / "out/desk.csv").read_text().splitlines()[0]
        self.assertIn("illuminance_lx_of_0,standard_error_lx_of_0", header)
        self.assertIn("illuminance_lx_of_7+", header)

    def test_pictures_have_layers(self):
        self.scene = self.write("room.toml", ROOM + SCENES + CAMERA.replace("[640, 480]", "[16, 12]"))
        picture = self.folder / "view.exr"
        result = run("render", self.scene, "--by", "light", "--paths", "4", "-o", picture)
        self.assertEqual(result.returncode, 0, result.stderr)
        header = picture.read_bytes()[:4096]
        for name in (b"Combined_bulb.R", b"Combined_spots.G", b"SE.Y"):
            self.assertIn(name, header)
        self.expect_wrong_input(["render", self.scene, "--by", "light", "-o", self.folder / "view.png"], "end the name", ".exr")

    def test_check_counts_scenes_that_name_their_sensors(self):
        required = ROOM + "require = { mean = 0.5 }\n" + SCENES
        self.scene = self.write("room.toml", required)
        self.assertEqual(run("measure", self.scene, "--check", "--quiet").returncode, 0)
        self.scene = self.write("room.toml", required.replace("spot = 0.2", "spot = 0.0001"))
        self.assertEqual(run("measure", self.scene, "--check", "--quiet").returncode, 1)
        self.scene = self.write("room.toml", required.replace("spot = 0.2", "spot = 0.0001").replace('sensors = ["wall"]', ""))
        self.assertEqual(run("measure", self.scene, "--check", "--quiet").returncode, 0)

    def test_wrong_input(self):
        for line, message in (
            ("bulbb = 0.5", 'there is no light or group of lights "bulbb". Did you mean "bulb"?'),
            ("bulb = -1", "scenes.evening.bulb"),
            ("bounces = 1.5", "scenes.evening.bounces"),
            ("bounces = 21", "scenes.evening.bounces"),
            ("maintenance = 2", "scenes.evening.maintenance"),
            ('sensors = ["door"]', 'there is no sensor "door"'),
        ):
            self.scene = self.write("room.toml", ROOM + f"[scenes.evening]\n{line}\n")
            self.expect_wrong_input(["measure", self.scene], message)
        self.scene = self.write("room.toml", ROOM + SCENES)
        self.expect_wrong_input(["measure", self.scene, "--method", "radiosity"], "keeps the light of lamps and of bounces together")

    def test_most_bounces(self):
        for bounces in (19, 20):
            self.scene = self.write("room.toml", ROOM + f"[scenes.evening]\nbounces = {bounces}\n")
            document = self.measure("--paths", "64", "--method", "path")
            whole, lit = document["sensors"][0], document["scenes"]["evening"]["sensors"][0]
            self.assertLess(lit["summary"]["mean"], whole["summary"]["mean"])
            self.assertGreater(lit["summary"]["mean"], 0.99 * whole["summary"]["mean"])

    def test_odd_names(self):
        """Of groups: parts of texts, of columns of CSV and of layers."""
        name = 'a "b", c.d = {é} %'
        quoted = json.dumps(name, ensure_ascii=False)
        scene = ROOM.replace("flux = 1000", f"flux = 1000\ngroup = {quoted}") + f"[scenes.evening]\n{quoted} = 0.5\n"
        self.scene = self.write("room.toml", scene + CAMERA.replace("[640, 480]", "[16, 12]"))
        document = self.measure("--paths", "64", "--by", "light", "--csv", self.folder / "out")
        self.assertEqual(document["sensors"][0]["shares"][0]["name"], name)
        with (self.folder / "out/desk.csv").open(newline="") as file:
            header = next(csv.reader(file))
        self.assertTrue(any(column.startswith("illuminance_lx_of_") for column in header))
        result = run("render", self.scene, "--by", "light", "--paths", "2", "-o", self.folder / "view.exr")
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_dimming_after_the_run(self):
        state = self.folder / "lamps.run"
        self.measure("--paths", "65536", "--method", "path", "--by", "light", "--state", state)
        dimmed = run("measure", "--from", state, "--set", "bulb=0.5", "--set", "spots=0", "--json")
        self.assertEqual(dimmed.returncode, 0, dimmed.stderr)
        fresh = self.measure("--paths", "65536", "--method", "path", "--set", "lights.bulb.flux=500", "--set", "lights.spot.on=false", "--seed", "3")
        pairs = zip(json.loads(dimmed.stdout)["sensors"][0]["values"], fresh["sensors"][0]["values"])
        for a, b in pairs:
            self.assertLess(abs(a["value"] - b["value"]), 4 * math.hypot(a["standard_error"], b["standard_error"]))
        self.expect_wrong_input(["measure", "--from", state, "--set", "bulbb=0.5"], 'Did you mean "bulb"?')
        self.expect_wrong_input(["measure", "--from", state, "--set", "materials.wall.reflectance=0.5"], "all else is that of the run")


if __name__ == "__main__":
    unittest.main()
