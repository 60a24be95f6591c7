"""Scenes and results can be copied and pickled, and go to other processes."""

import copy
import os
import pickle
import tempfile
import unittest
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

import numpy as np
import stilb
from room import TOML, built

PATHS = 2048


def again(value):
    return pickle.loads(pickle.dumps(value))


def measured(scene):
    return scene.measure(paths=PATHS)


class Scenes(unittest.TestCase):
    def test_used_scenes_are_pickled(self):
        scene = built()
        scene.materials["black"] = stilb.Black()  # a part without keys
        scene.defaults["materials"] = {"reflectance": 0.5}
        scene.materials["grey"] = {"type": "diffuse"}
        before = measured(scene)
        for copied in (again(scene), copy.copy(scene), copy.deepcopy(scene)):
            self.assertEqual(copied.to_dict().keys(), scene.to_dict().keys())
            self.assertEqual(list(copied.materials), list(scene.materials))
            np.testing.assert_array_equal(measured(copied)["desk"].value, before["desk"].value)

    def test_parts_without_type_are_pickled(self):
        scene = built()
        scene.lights["bulb"] = {"position": (2, 1.5, 2.3), "flux": 800}  # the type is missing, as the reader will say
        with self.assertRaisesRegex(stilb.InputError, "lights.bulb"):
            measured(again(scene))

    def test_copies_have_parts_of_their_own(self):
        scene = built()
        measured(scene)
        for copied in (copy.copy(scene), copy.deepcopy(scene), again(scene)):
            copied.lights["bulb"].flux = 1
            copied.run["seed"] = 8
            del copied.sensors["eye"]
            self.assertEqual((scene.lights["bulb"].flux, scene.run["seed"], "eye" in scene.sensors), (800, 7, True))
            self.assertLess(measured(copied)["desk"].value.max(), 1)

    def test_copies_share_large_arrays_and_nothing_that_changes(self):
        scene = built()
        copied = copy.deepcopy(scene)
        self.assertIs(copied.objects["table"].vertices, scene.objects["table"].vertices)
        copied.set("sensors.desk.require.mean", 9)
        part = copy.deepcopy(scene.sensors["desk"])
        part.require["mean"] = 10
        self.assertEqual(scene.sensors["desk"].require, {"mean": 1})

    def test_files_of_scenes_are_found_from_other_folders(self):
        with tempfile.TemporaryDirectory() as folder:
            Path(folder, "floor.obj").write_text("v 0 0 0.1\nv 4 0 0.1\nv 4 3 0.1\nf 1 2 3\n")
            Path(folder, "room.toml").write_text(TOML)
            Path(folder, "lamp.rad").write_text("void glow lamp 0 0 4 1 1 1 0\nlamp ring light 0 0 8 0 0 1 0 0 -1 0 0.1\n")
            before = os.getcwd()
            os.chdir(folder)
            try:
                scene = stilb.load("room.toml")
                scene.objects["floor"] = stilb.Mesh(file="floor.obj", material="wall")
                lamp = stilb.load("lamp.rad", light_scale=2)
                lamp.sensors["spot"] = stilb.Illuminance(position=(0, 0, 0), normal=(0, 0, 1))
                kept = pickle.dumps((scene, lamp))
                expected = measured(scene)["desk"].value, measured(lamp)["spot"].value
            finally:
                os.chdir(before)
            scene, lamp = pickle.loads(kept)
            np.testing.assert_array_equal(measured(scene)["desk"].value, expected[0])
            np.testing.assert_array_equal(measured(lamp)["spot"].value, expected[1])

    def test_other_processes_measure(self):
        scene = built()
        expected = measured(scene)
        with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as workers:
            result = workers.submit(measured, scene).result()
        np.testing.assert_array_equal(result["desk"].value, expected["desk"].value)


class Results(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.result = measured(built())

    def test_results_are_pickled(self):
        for copied in (again(self.result), copy.copy(self.result), copy.deepcopy(self.result)):
            self.assertEqual(repr(copied), repr(self.result))
            self.assertEqual(copied.to_json(), self.result.to_json())
            for name in self.result:
                self.same(copied[name], self.result[name])

    def test_readings_are_pickled(self):
        points = built().illuminance(np.full((2, 3, 3), 1.0), (0, 0, 1), paths=PATHS)
        for reading in (self.result["desk"], points):
            for copied in (again(reading), copy.copy(reading), copy.deepcopy(reading)):
                self.same(copied, reading)
                self.assertEqual(copied.run.warnings, reading.run.warnings)
                self.assertEqual(copied.run.elapsed_s, reading.run.elapsed_s)

    def test_a_pickled_reading_does_not_carry_the_result(self):
        self.assertLess(len(pickle.dumps(self.result["eye"])), len(self.result.to_json()))

    def same(self, a, b):
        for name in ("value", "standard_error", "rgb", "position", "direction", "replicates"):
            np.testing.assert_array_equal(getattr(a, name), getattr(b, name), name)
        np.testing.assert_array_equal(a.interval(0.9), b.interval(0.9))
        self.assertEqual((repr(a), a.type, a.quantity, a.unit, a.error, a.requirements, a.reasons),
                         (repr(b), b.type, b.quantity, b.unit, b.error, b.requirements, b.reasons))
        self.assertEqual(a.uniformity.interval, b.uniformity.interval)

    def test_estimates_are_pickled_with_their_correlation(self):
        desk = self.result["desk"]
        mean = again(desk.mean)
        self.assertEqual((mean.value, mean.standard_error, mean.interval, mean.unit),
                         (desk.mean.value, desk.mean.standard_error, desk.mean.interval, "lx"))
        self.assertEqual((mean - desk.mean).interval, (0, 0))
        self.assertEqual((again(self.result)["desk"].minimum - desk.minimum).standard_error, 0)
        ratio = again(desk.minimum / desk.mean)
        self.assertEqual(ratio.interval, (desk.minimum / desk.mean).interval)

    def test_runs_are_pickled(self):
        run = again(self.result["desk"].run)
        self.assertEqual(repr(run), repr(self.result["desk"].run))

    def test_pictures_are_pickled(self):
        image = built().render("view", paths=4)
        for copied in (again(image), copy.copy(image), copy.deepcopy(image)):
            for name in ("luminance", "standard_error", "rgb", "depth", "normals"):
                np.testing.assert_array_equal(getattr(copied, name), getattr(image, name), name)
            self.assertEqual(repr(copied), repr(image))
            self.assertEqual(copied._repr_png_(), image._repr_png_())

    def test_solutions_are_pickled(self):
        solution = built().solve(paths=8, patch=1)
        full = solution.render(lights={"bulb": 0.5})
        for copied in (again(solution), copy.copy(solution), copy.deepcopy(solution)):
            self.assertEqual((copied.lights, repr(copied)), (solution.lights, repr(solution)))
            np.testing.assert_allclose(copied.render(lights={"bulb": 0.5}).luminance, full.luminance, rtol=2e-3)
        self.assertRegex(repr(solution), r"<stilb.Solution of 'room', lights: bulb; ray-bundle, [0-9]+ steps in .* paths done>")

    def test_loaded_solutions_are_pickled(self):
        with tempfile.TemporaryDirectory() as folder:
            scene = built()
            scene.save(Path(folder) / "room.toml")
            scene.solve(paths=8, patch=1).save(Path(folder) / "room.solution")
            solution = stilb.load_solution(Path(folder) / "room.solution")
        np.testing.assert_allclose(again(solution).render().luminance, solution.render().luminance, rtol=2e-3)


if __name__ == "__main__":
    unittest.main()
