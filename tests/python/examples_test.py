"""The programs of examples/python run as users run them, and what they print is true."""

import importlib.util
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import stilb
from room import ROOT

EXAMPLES = ROOT / "examples/python"
NUMBER = r"(-?\d+(?:\.\d+)?)"
ESTIMATE = rf"{NUMBER} ± {NUMBER}"


def has(package: str) -> bool:
    return importlib.util.find_spec(package) is not None


class Examples(unittest.TestCase):
    def printed(self, example: str, *arguments: object) -> str:
        """What the program prints. Warnings of scenes and results are not expected."""
        made = subprocess.run([sys.executable, "-B", EXAMPLES / example, *map(str, arguments)], capture_output=True, text=True,
                              check=False, env=os.environ | {"OMP_NUM_THREADS": "1"})
        self.assertEqual(made.returncode, 0, made.stderr)
        self.assertNotIn("ResultWarning", made.stderr)
        return made.stdout

    def estimates(self, text: str, pattern: str) -> list[tuple[float, float]]:
        """The values and their ± behind what this pattern finds."""
        found = [(float(match[-2]), float(match[-1])) for match in re.findall(pattern + ESTIMATE, text)]
        self.assertTrue(found, f"{pattern!r} is not in:\n{text}")
        return found

    def require_agreement(self, first: tuple[float, float], second: tuple[float, float]) -> None:
        """Of two independent numbers with their intervals: half as much again as 95 % of them differ."""
        self.assertLess(abs(first[0] - second[0]), 1.5 * (first[1] ** 2 + second[1] ** 2) ** 0.5)

    def test_each_is_described_and_tested(self):
        guide = (ROOT / "docs/python.md").read_text(encoding="utf-8")
        own = Path(__file__).read_text(encoding="utf-8")
        for example in EXAMPLES.glob("*.py"):
            with self.subTest(example.name):
                self.assertTrue(f"(../examples/python/{example.name})" in guide, "docs/python.md has no line for it")
                self.assertTrue(f'"{example.name}"' in own or example.name == "tour.py", "it has no test")

    def test_light_is_proportional_to_the_lamp(self):
        text = self.printed("sweep.py", "--paths", 1024, "--reflectances", 0.5, "--fluxes", 800, 1600)
        (lamp, _), (double, _) = self.estimates(text, r"800 lm  ") + self.estimates(text, r"1600 lm  ")
        self.assertAlmostEqual(double, 2 * lamp, delta=0.02)
        (_, (change, error)) = self.estimates(text, rf"lm  {ESTIMATE} +")
        self.assertAlmostEqual(change, lamp, delta=0.02)
        self.assertLess(error, 0.1 * change)
        shelf, standard_error, factor = map(float, re.search(
            rf"changes the mean by {NUMBER} lx, with a standard error of {NUMBER} lx: {NUMBER} times", text).groups())
        self.assertLess(abs(shelf + 0.165), 5 * standard_error)  # by 65536 paths: -0.165 lx
        self.assertGreater(factor, 2)

    def test_a_layout_becomes_more_uniform(self):
        text = self.printed("optimise.py", "--paths", 32, "--least-step", 0.4)
        ((start, _),) = self.estimates(text, "start .*: uniformity ")
        ((checked, _),) = self.estimates(text, "With another seed: ")
        ((gain, error),) = self.estimates(text, "With another seed: .*, ")
        self.assertGreater(gain, error)
        self.assertGreater(checked, start)

    def test_rooms_of_processes_are_those_of_one(self):
        text = self.printed("many_rooms.py", "--rooms", 2, "--error", "5%")
        own = self.example("many_rooms")
        for number in range(2):
            mean = own.measured(own.room(number), "5%")["task"].mean
            self.assertRegex(text, rf"room {number} +{re.escape(str(mean))} ")
        self.assertIn("of 2 rooms have 100 lx", text)

    @unittest.skipUnless(has("distributed"), "needs the package distributed")
    def test_rooms_of_a_cluster_are_those_of_one_process(self):
        text = self.printed("many_rooms_dask.py", "--rooms", 2, "--error", "5%", "--small-error", "2%")
        own = self.example("many_rooms")
        means = [own.measured(own.room(number), "5%")["task"].mean for number in range(2)]
        for number, mean in enumerate(means):
            self.assertRegex(text, rf"room {number} +{re.escape(str(mean))} ")
        ((least, error),) = self.estimates(text, "The least light is in room 0: ")
        self.assertLess(error, 0.02 * least)
        self.assertLess(abs(least - means[0].value), 3 * means[0].standard_error + error)

    def test_intervals_are_honest(self):
        text = self.printed("check_estimator.py", "--seeds", 60, "--paths", 128, "--methods", "path")
        bias, least, most, covered, by_bins, by_order = map(float, re.search(
            rf"path +{NUMBER} +{NUMBER} to {NUMBER} +{NUMBER} % +{NUMBER} +{NUMBER}", text).groups())
        self.assertLess(bias, 4)
        self.assertGreater(least, 0.6)
        self.assertLess(most, 1.4)
        self.assertGreater(covered, 88)
        self.assertGreater(min(by_bins, by_order), 1e-3)

    def test_merged_seeds_are_one_run(self):
        text = self.printed("merge_seeds.py", "--seeds", 8, "--paths", 32)
        singles = self.estimates(text, r"seed \d +mean ")
        ((mean, error),) = self.estimates(text, "merged +mean ")
        self.assertEqual(len(singles), 8)
        self.assertAlmostEqual(mean, sum(value for value, _ in singles) / 8, delta=0.1)
        self.assertLess(error, 0.6 * sum(error for _, error in singles) / 8)
        truth = stilb.load(ROOT / "scenes/simple/room.toml").measure(sensors="table", paths=16384)["table"]
        ((minimum, error),) = self.estimates(text, "merged .* minimum ")
        self.require_agreement((minimum, error), (truth.minimum.value, 0))
        of_means = float(re.search(rf"mean of runs .* minimum {NUMBER} \(too small\)", text)[1])
        self.assertLess(of_means, truth.minimum.interval[0])
        self.assertIn("256 paths in 32 replicates", text)

    def test_the_daylight_factor_of_a_model_is_that_of_the_same_room(self):
        text = self.printed("daylight_factor.py", "--error", "20%")
        ((outside, _),) = self.estimates(text, "outside +")
        self.assertAlmostEqual(outside, 10000, delta=20)  # Radiance's sky fades into the ground, by 0.15 %
        ((mean, _),) = self.estimates(text, "mean factor +")
        ((plane, _),) = self.estimates(text, "working plane +")
        self.assertAlmostEqual(mean, 100 * plane / outside, delta=0.01)
        ((median, _),) = self.estimates(text, "median factor +")
        self.assertLess(median, mean)
        self.assertRegex(text, "EN 17037 asks for 2 %: met")

    @staticmethod
    def example(name: str):
        """The example as a module."""
        spec = importlib.util.spec_from_file_location(name, EXAMPLES / f"{name}.py")
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        return module

    def test_honeybee_models_become_scenes(self):
        with tempfile.TemporaryDirectory() as folder:
            model = json.loads((EXAMPLES / "office.hbjson").read_text(encoding="utf-8"))
            printed = [self.printed("honeybee_model.py", "--error", "20%", "--scene", Path(folder, "office.toml"))]
            scene = stilb.load(Path(folder, "office.toml"))
            self.assertEqual(list(scene.objects), ["floor", "ceiling", "south", "window", "east", "north", "west"])
            self.assertEqual(scene.materials["generic Floor"].reflectance, 0.2)
            # The same model in millimetres, with a modifier that is not known.
            in_millimetres(model)
            model["properties"]["radiance"]["modifiers"].append({"type": "Glow", "identifier": "lamp"})
            model["rooms"][0]["faces"][1]["properties"]["radiance"]["modifier"] = "lamp"
            Path(folder, "millimetres.hbjson").write_text(json.dumps(model), encoding="utf-8")
            printed.append(self.printed("honeybee_model.py", Path(folder, "millimetres.hbjson"), "--error", "20%"))
        self.assertNotIn("left out", printed[0])
        self.assertIn("left out: 1 modifiers of type Glow", printed[1])
        (light,), (dark,) = (self.estimates(text, "desks: daylight factor ") for text in printed)
        self.assertGreater(light[0] - light[1], dark[0] + dark[1])  # a ceiling of 30 % instead of 80 %
        self.require_agreement(light, self.same_room_measured())

    def same_room_measured(self) -> tuple[float, float]:
        """By the room of daylight_factor.py, at the points of the model."""
        own = self.example("daylight_factor")
        with tempfile.TemporaryDirectory() as folder:
            scene = own.overcast_sky(folder)
            own.add_room(scene)
            points = [(x, y, 0.85) for y in (1, 2, 3, 4) for x in (1, 2, 3)]
            scene.sensors["desks"] = stilb.Illuminance(points=points, normal=(0, 0, 1))
            mean = scene.measure(error="10%", seed=2)["desks"].mean / 99.857  # lx of one per cent
        return mean.value, (mean.interval[1] - mean.interval[0]) / 2

    @unittest.skipUnless(has("mitsuba"), "needs the package mitsuba, and LLVM")
    def test_mitsuba_says_the_same(self):
        text = self.printed("compare_mitsuba.py", "--samples", 256, "--error", "3%")
        self.assertLess(float(re.search(rf"The means are {NUMBER} standard errors apart", text)[1]), 4)
        farthest, threshold = map(float, re.search(rf"farthest are {NUMBER} standard.* exceed {NUMBER}\)",
                                                   text).groups())
        self.assertLess(farthest, threshold + 1)


def in_millimetres(model: dict) -> None:
    model["units"] = "Millimeters"
    for face in model["rooms"][0]["faces"]:
        for item in [face, *face.get("apertures", [])]:
            item["geometry"]["boundary"] = scaled(item["geometry"]["boundary"])
    for grid in model["properties"]["radiance"]["sensor_grids"]:
        for sensor in grid["sensors"]:
            (sensor["pos"],) = scaled([sensor["pos"]])
    for view in model["properties"]["radiance"]["views"]:
        (view["position"],) = scaled([view["position"]])


def scaled(points: list[list[float]]) -> list[list[float]]:
    return [[1000 * coordinate for coordinate in point] for point in points]


if __name__ == "__main__":
    unittest.main()
