"""Results in Python: the numbers of the command line, as arrays, and runs that are followed and ended."""

import io
import json
import os
import pickle
import signal
import sys
import tempfile
import threading
import time
import unittest
import unittest.mock
import warnings
from contextlib import redirect_stderr
from pathlib import Path

import matplotlib
import numpy as np
import stilb
from room import TOML, built, program

matplotlib.use("Agg")
PATHS = 4096


def without_times(document):
    document = json.loads(document)
    for key in ("elapsed_s", "scene"):
        document.pop(key)
    return document


class Readings(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scene = built()
        cls.result = cls.scene.measure(paths=PATHS)

    def test_bits_are_those_of_the_command_line(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "room.toml"
            file.write_text(TOML)
            printed = json.loads(program("measure", file, "--json", "--paths", PATHS).stdout)
            read = stilb.load(file).measure(paths=PATHS, threads=1)
        self.assertEqual(without_times(read.to_json()), without_times(json.dumps(printed)))
        for sensor in printed["sensors"]:
            reading = self.result[sensor["name"]]
            values = [value["value"] for value in sensor["values"]]
            intervals = np.array([value["interval"] for value in sensor["values"]])
            low, high = reading.interval()
            np.testing.assert_array_equal(reading.value.ravel(), values)
            np.testing.assert_array_equal(np.stack([low.ravel(), high.ravel()], 1), intervals)
            self.assertEqual(reading.mean.value, sensor["summary"]["mean"])

    def test_arrays_have_the_shape_of_the_sensor(self):
        desk, eye = self.result["desk"], self.result["eye"]
        self.assertEqual((desk.value.shape, desk.rgb.shape, desk.position.shape), ((2, 4), (2, 4, 3), (2, 4, 3)))
        self.assertEqual((eye.value.shape, eye.direction.shape), ((3,), (3, 3)))
        self.assertEqual((desk.quantity, desk.unit, eye.quantity, eye.unit), ("illuminance", "lx", "luminance", "cd/m2"))
        np.testing.assert_allclose(desk.position[1, 2], [2, 1.6, 0.75])
        np.testing.assert_array_equal(desk.direction[0, 0], [0, 0, 1])
        np.testing.assert_allclose(desk.rgb @ [0.2126, 0.7152, 0.0722], desk.value)

    def test_arrays_are_views_that_outlive_the_result(self):
        desk = built().measure(paths=PATHS)["desk"]
        value = desk.value
        self.assertTrue(np.shares_memory(value, desk.value))
        self.assertFalse(value.flags.owndata or value.flags.writeable)
        expected = self.result["desk"].value
        del desk
        np.testing.assert_array_equal(value, expected)

    def test_intervals_of_other_confidence(self):
        desk = self.result["desk"]
        low, high = desk.interval()
        wider, _ = desk.interval(0.99)
        t = [stilb.statistics.student_t_quantile(p, desk.run.replicates - 1) for p in (0.975, 0.995)]
        np.testing.assert_allclose((desk.value - wider) / (desk.value - low), t[1] / t[0])
        for wrong in (95, "x"):
            with self.assertRaisesRegex(stilb.InputError, f"confidence {wrong}: expected a probability between 0 and 1"):
                desk.interval(wrong)

    def test_intervals_are_pairs_that_may_be_called(self):
        desk = self.result["desk"]
        for holder in (desk, desk.mean, desk.uniformity, desk.maximum - desk.mean, stilb.paired(self.result, self.result)["desk"]):
            low, high = holder.interval
            np.testing.assert_array_equal(holder.interval(), (low, high))
            np.testing.assert_array_equal(pickle.loads(pickle.dumps(holder.interval)), (low, high))
            wider = holder.interval(0.99)
            self.assertTrue(np.all(wider[0] <= low) and np.all(wider[1] >= high))
        t = [stilb.statistics.student_t_quantile(p, desk.run.replicates - 1) for p in (0.975, 0.995)]
        low, wider = desk.mean.interval[0], desk.mean.interval(0.99)[0]
        self.assertAlmostEqual((desk.mean.value - wider) / (desk.mean.value - low), t[1] / t[0])

    def test_statistics_have_intervals(self):
        desk = self.result["desk"]
        for estimate in (desk.mean, desk.minimum, desk.maximum, desk.uniformity, desk.diversity):
            low, high = estimate.interval
            self.assertTrue(low <= estimate.value <= high)
        self.assertAlmostEqual(float(desk.mean), desk.value.mean())
        self.assertEqual(desk.minimum.value, desk.value.min())
        self.assertEqual(desk.requirements, {"mean": (1.0, "pass")})
        self.assertEqual(desk.reasons, {})

    def test_results_are_mappings(self):
        self.assertEqual([name for name in self.result], ["desk", "eye"])
        with self.assertRaisesRegex(KeyError, "no result of a sensor 'desc'; there are: desk, eye"):
            self.result["desc"]
        only = built().measure(paths=PATHS, sensors=["eye"])
        self.assertEqual(list(only), ["eye"])
        with self.assertRaisesRegex(stilb.InputError, "chair"):
            built().measure(sensors=["chair"])

    def test_tables_and_drawings(self):
        desk = self.result["desk"]
        table = desk.to_pandas()
        self.assertEqual(table.loc[(1, 2), "value"], desk.value[1, 2])
        self.assertEqual(table.attrs["unit"], "lx")
        axes = desk.plot()
        np.testing.assert_array_equal(axes.images[0].get_array(), desk.value)
        np.testing.assert_allclose(axes.images[0].get_extent(), (0, 1.6, 0, 0.8))
        self.assertEqual(self.result["eye"].plot().get_ylabel(), "luminance [cd/m2]")
        self.assertIn("<td>2 x 4</td>", self.result._repr_html_())
        self.assertRegex(repr(desk), r"<desk: 2 x 4 readings, mean [0-9.]+ ± [0-9.]+ lx; converged: paths done>")
        self.assertNotIn("converged", self.result._repr_html_().lower().replace("converged: paths done", ""))

    def test_a_table_of_all_sensors(self):
        table = self.result.to_pandas()
        self.assertEqual(len(table), 11)
        self.assertEqual(table.loc[("desk", 6), "value"], self.result["desk"].value[1, 2])
        self.assertEqual(table.loc[("eye", 2), "unit"], "cd/m2")
        self.assertEqual(table.loc[("eye", 2), "direction_z"], -1)

    def test_data_sets_have_metres_on_their_axes(self):
        desk, eye = self.result["desk"].to_xarray(), self.result["eye"].to_xarray()
        np.testing.assert_array_equal(desk["value"].values, self.result["desk"].value)
        self.assertEqual(desk["value"].dims, ("v", "u"))
        np.testing.assert_allclose(desk["u"].values, [0.2, 0.6, 1, 1.4])
        np.testing.assert_allclose(desk["v"].values, [0.2, 0.6])
        self.assertEqual((desk["value"].attrs["units"], desk["u"].attrs["units"]), ("lx", "m"))
        self.assertEqual(float(desk["value"].sel(u=1, v=0.6, method="nearest")), self.result["desk"].value[1, 2])
        np.testing.assert_allclose(desk["x"].sel(u=1, v=0.6, method="nearest"), 2)
        self.assertEqual(float(desk["rgb"].sel(band="red")[1, 2]), self.result["desk"].rgb[1, 2, 0])
        self.assertEqual((eye["value"].dims, eye.attrs["name"]), (("reading",), "eye"))

    def test_missing_packages_are_named(self):
        with unittest.mock.patch.dict(sys.modules, {"xarray": None, "pandas": None}):
            for table, package in [(self.result["desk"].to_xarray, "xarray"), (self.result.to_pandas, "pandas")]:
                with self.assertRaisesRegex(ImportError, f"this needs the package {package}: pip install {package}"):
                    table()

    def test_readings_are_arrays(self):
        desk = self.result["desk"]
        np.testing.assert_array_equal(np.asarray(desk), desk.value)
        self.assertTrue(np.shares_memory(np.asarray(desk), desk.value))
        self.assertEqual(np.asarray(desk, np.float32).dtype, np.float32)
        copied = np.array(desk)
        copied[0, 0] = 1  # a copy can be changed
        self.assertEqual((desk.shape, desk.size, len(desk)), ((2, 4), 8, 2))
        self.assertEqual((desk[1, 2], desk[-1].shape), (desk.value[1, 2], (4,)))
        self.assertEqual(np.asarray(desk).mean(), desk.value.mean())
        np.testing.assert_array_equal(2 * np.asarray(self.result["eye"][1:]), 2 * self.result["eye"].value[1:])

    def test_functions_of_numpy_have_the_values(self):
        desk, eye = self.result["desk"], self.result["eye"]
        self.assertAlmostEqual(np.mean(desk), desk.mean.value)
        np.testing.assert_array_equal(np.mean(desk, axis=0), desk.value.mean(0))
        np.testing.assert_array_equal(np.concatenate([np.ravel(desk), eye]), [*desk.value.ravel(), *eye.value])
        self.assertEqual((np.max(desk), np.shape(desk), np.sqrt(eye).shape), (desk.value.max(), (2, 4), (3,)))
        self.assertEqual(np.mean(stilb.paired(self.result, self.result)["desk"]), 0)

    def test_a_call_takes_less_than_5_ms_more_than_its_run(self):
        def overhead():
            begin = time.perf_counter()
            result = self.scene.measure(paths=1)
            return time.perf_counter() - begin - result.elapsed_s

        self.assertLess(min(overhead() for _ in range(20)), 0.005)


class Points(unittest.TestCase):
    def test_illuminance_is_that_of_a_point_source(self):
        scene = built()
        scene.materials["wall"] = stilb.Black()
        points = np.random.default_rng(1).uniform((0.2, 0.2, 1), (3.8, 2.8, 2), (5, 2, 3))
        reading = scene.illuminance(points, (0, 0, 2), paths=PATHS)
        exact = stilb.exact.illuminance_by_point(points, (0, 0, 1), (2, 1.5, 2.3), 800 / (4 * np.pi))
        self.assertEqual(reading.value.shape, (5, 2))
        np.testing.assert_allclose(reading.value, exact, rtol=1e-6)

    def test_points_measure_what_sensors_do(self):
        scene = built()
        del scene.sensors["eye"]
        desk = scene.measure(paths=65536)["desk"]
        reading = scene.illuminance(desk.position, desk.direction, paths=65536, seed=2)
        z = (reading.value - desk.value) / np.hypot(reading.standard_error, desk.standard_error)
        self.assertLess(np.abs(z).max(), stilb.statistics.sidak_threshold_z(1e-4, z.size))

    def test_luminance_of_a_diffuse_wall_is_its_illuminance_times_reflectance_over_pi(self):
        scene = built()
        seen = scene.luminance((2, 1.5, 1), [(1, 0, 0)], paths=65536)
        on_wall = scene.illuminance((4, 1.5, 1), (-1, 0, 0), paths=65536, seed=2)
        self.assertEqual((seen.value.shape, on_wall.value.shape), ((1,), ()))
        expected = on_wall.rgb * [0.7, 0.5, 0.3] / np.pi
        error = 5 * (seen.standard_error + on_wall.standard_error * 0.7 / np.pi)
        np.testing.assert_allclose(seen.rgb[0], expected, atol=error.item())

    def test_wrong_points_are_refused(self):
        scene = built()
        for points, normals, message in [
                ([1, 2], [0, 0, 1], r"points: found an array of shape \(2,\). Allowed: \(..., 3\)"),
                ([1, 1, 1], [0, 1], r"normals: found an array of shape \(2,\)"), ([1, 1, 1], 1, r"normals: found .* shape \(\)"),
                (np.ones((2, 3)), np.ones((3, 3)), r"points of shape \(2, 3\) and normals of shape \(3, 3\) do not fit"),
                (np.ones((0, 3)), [0, 0, 1], r"points: found .* shape \(0, 3\)"), ("a", [0, 0, 1], "points: found a value of type str"),
                ([[1, 1, 1], [1, 1]], [0, 0, 1], "points: found a value of type list. Allowed: numbers"),
                ([1, 1, 1], [0, 0, 0], "point 0: "), ([1, np.nan, 1], [0, 0, 1], "point 0: ")]:
            with self.subTest(message), self.assertRaisesRegex(stilb.InputError, message):
                scene.illuminance(points, normals)


class Pictures(unittest.TestCase):
    def test_pictures_are_arrays_and_files(self):
        image = built().render("view", paths=4)
        self.assertEqual((image.luminance.shape, image.rgb.shape), ((16, 24), (16, 24, 3)))
        self.assertEqual(image.standard_error.shape, (16, 24))
        np.testing.assert_allclose(image.rgb @ np.float32([0.2126, 0.7152, 0.0722]), image.luminance, rtol=1e-5)
        self.assertTrue(image._repr_png_().startswith(b"\x89PNG"))
        self.assertEqual(image.plot().images[0].get_array().shape, (16, 24))
        self.assertRegex(repr(image), r"<stilb.Image 24 x 16: auto.*, 4 passes in .* s, error .* %; converged: paths done>")
        with tempfile.TemporaryDirectory() as folder, self.assertRaisesRegex(stilb.InputError, "picture.jpg"):
            image.save(Path(folder) / "picture.jpg")

    def test_pictures_have_depth_and_normals(self):
        scene = built()
        scene.sensors["view"] = stilb.Camera(position=(1, 1, 2.2), target=(1, 1, 0), up=(0, 1, 0), fov=20, resolution=(9, 9))
        del scene.objects["table"]
        image = scene.render("view", paths=2)
        self.assertEqual((image.depth.shape, image.normals.shape), ((9, 9), (9, 9, 3)))
        self.assertAlmostEqual(image.depth[4, 4], 2.2, 5)
        self.assertGreater(image.depth[0, 0], 2.2)
        np.testing.assert_allclose(image.normals, np.broadcast_to([0, 0, 1], (9, 9, 3)), atol=1e-6)
        self.assertFalse(image.depth.flags.writeable)

    def test_solutions_dim_their_lights(self):
        with tempfile.TemporaryDirectory() as folder:
            scene = built()
            scene.save(Path(folder) / "room.toml")
            solution = scene.solve(paths=8, patch=1)
            self.assertEqual(solution.lights, ["bulb"])
            full, dimmed = solution.render(), solution.render("view", lights={"bulb": 0.25})
            np.testing.assert_allclose(dimmed.luminance, full.luminance / 4, rtol=1e-5)
            solution.save(Path(folder) / "room.solution")
            np.testing.assert_allclose(stilb.load_solution(Path(folder) / "room.solution").render().luminance,
                                       full.luminance, rtol=1e-3)
            with self.assertRaisesRegex(stilb.InputError, "lights.bulb: -1"):
                solution.render(lights={"bulb": -1})


def measure_for(time_s, **options):
    """A run that ends by this time alone: the desk has requirements, which would end it, too."""
    return built().measure(time=time_s, sensors=["eye"], **options)


class Runs(unittest.TestCase):
    def test_progress_is_reported_and_ends_the_run(self):
        reports = []

        def follow(report):
            reports.append(report)
            return report.elapsed_s < 0.5 or report.stage != ""

        result = measure_for(600, progress=follow)
        self.assertFalse(result.converged)
        self.assertGreater(reports[-1].elapsed_s, 0.5)
        printed = io.StringIO()
        with redirect_stderr(printed):
            measure_for(1, progress=True)
        self.assertRegex(printed.getvalue(), r" s .*\n$")
        with redirect_stderr(printed), self.assertRaises(stilb.Cancelled):
            printed.truncate(0)
            measure_for(0.001, progress=True)
        self.assertFalse(printed.getvalue().endswith(" "))

    def test_runs_that_do_not_converge_say_so(self):
        with self.assertWarns(stilb.ResultWarning) as caught:
            result = built().measure(error=1e-6, time=3)
        self.assertEqual((result.converged, result.stopped), (False, "time over"))
        shortfall = [str(warning.message) for warning in caught.warnings if "requested error" in str(warning.message)]
        self.assertEqual(len(shortfall), 1)
        self.assertRegex(shortfall[0], "The requested error of 0.0001 % is not reached: the error is [0-9.e-]+ %. The run ended "
                                       "by: time over.")
        self.assertEqual(caught.filename, __file__)
        for text in (repr(result), repr(result["desk"]), result._repr_html_(), result["desk"]._repr_html_(),
                     repr(result["desk"].run)):
            self.assertIn("NOT converged: time over", text)
        self.assertIn(shortfall[0], repr(result))
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            self.assertEqual(built().measure(error=0.5).stopped, "target reached")

    def test_warnings_of_runs_are_python_warnings(self):
        scene = built()
        scene.sensors["behind"] = stilb.Illuminance(position=(9, 9, 9), normal=(0, 0, 1))
        for run in (lambda: scene.measure(paths=PATHS), lambda: scene.illuminance([9, 9, 9], [0, 0, 1], paths=PATHS).run):
            with self.assertWarns(stilb.ResultWarning) as caught:
                result = run()
            self.assertEqual([str(warning.message) for warning in caught.warnings], result.warnings)
            self.assertEqual(caught.filename, __file__)
        result = scene.measure(paths=PATHS)
        self.assertIn(f"Warning: {result.warnings[0]}", repr(result))
        self.assertIn("Warning: ", result._repr_html_())

    def test_errors_of_progress_end_the_run(self):
        def fail(report):
            raise ZeroDivisionError

        with self.assertRaises(ZeroDivisionError) as caught:
            measure_for(600, progress=fail)
        self.assertTrue(caught.exception.result is None or caught.exception.result["eye"].size == 3)

    def interrupted(self, run):
        """The result that Ctrl-C leaves, once there is one."""

        def press(report):
            if report.stage == "" and np.isfinite(report.error):
                os.kill(os.getpid(), signal.SIGINT)

        begin = time.monotonic()
        with self.assertRaises(KeyboardInterrupt) as caught:
            run(press)
        self.assertLess(time.monotonic() - begin, 120)
        return caught.exception.result

    def test_ctrl_c_ends_the_run_and_keeps_its_light(self):
        result = self.interrupted(lambda press: measure_for(600, progress=press))
        self.assertEqual((result.stopped, result.converged), ("interrupted", False))
        self.assertTrue(np.all(result["eye"].standard_error > 0))
        reading = self.interrupted(lambda press: built().illuminance(np.ones((2, 2, 3)), (0, 0, 1), time=600, progress=press))
        self.assertEqual((reading.shape, reading.run.stopped), ((2, 2), "interrupted"))
        image = self.interrupted(lambda press: built().render("view", time=600, progress=press))
        self.assertIsInstance(image, stilb.Image)
        self.assertEqual(image.stopped, "interrupted")
        solution = self.interrupted(lambda press: built().solve(time=600, patch=0.5, progress=press))
        self.assertIsInstance(solution, stilb.Solution)
        self.assertGreater(solution.render().luminance.max(), 0)

    def test_options_of_patches_are_those_of_the_command_line(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "room.toml"
            file.write_text(TOML)
            scene = stilb.load(file)
            result = scene.measure(method="ray-bundle", patch=1, paths=512, first_shot="classical", resolution=64, directions="pair")
            typed = program("measure", file, "--json", "--method", "ray-bundle", "--patch", 1, "--paths", 512, "--first-shot",
                            "classical", "--resolution", 64, "--directions", "pair")
            expected, own = json.loads(typed.stdout), json.loads(result.to_json())
            self.assertEqual(own["patches"]["first_shot"]["variant"], "classical")
            self.assertEqual(own["sensors"], expected["sensors"])
            scene.materials["wall"] = stilb.Phong(diffuse=0.4, specular=0.2, exponent=20)
            finer, coarser = (scene.solve(paths=8, patch=1, degree=degree) for degree in (4, 0))
            self.assertGreater(len(pickle.dumps(finer)), len(pickle.dumps(coarser)))
            with self.assertRaisesRegex(stilb.InputError, "degree: 13 is not allowed. Allowed: from 0 to 12"):
                scene.solve(degree=13)

    def test_other_threads_go_on(self):
        counts = []

        def count():
            for _ in range(20):
                time.sleep(0.01)
                counts.append(time.monotonic())

        thread = threading.Thread(target=count)
        thread.start()
        measure_for(2)
        end = time.monotonic()
        thread.join()
        self.assertLess(counts[-1], end)

    def test_a_time_limit_before_any_result(self):
        with self.assertRaises(stilb.Cancelled):
            measure_for(0.001)

    def test_wrong_options_are_refused(self):
        for options, message in [({"error": "x"}, "error: \"x\" is not allowed. Allowed: a share"), ({"method": "paths"}, "Did you mean \"path\""),
                                 ({"target": "means"}, 'Did you mean "mean"')]:
            with self.assertRaisesRegex(stilb.InputError, message):
                built().measure(**options)
        for options, message in [({"paths": "4096"}, "^paths: '4096' is not allowed. Allowed: a whole number from 1 to "),
                                 ({"paths": 1.5}, "^paths: 1.5 is not allowed"), ({"seed": -1}, "^seed: -1 is not allowed. Allowed: a "),
                                 ({"time": "long"}, "^time: 'long' is not allowed. Allowed: a time above 0"),
                                 ({"method": 3}, "^method: 3 is not allowed. Allowed: .*path, "),
                                 ({"error": [1]}, "^error: .1. is not allowed. Allowed: a share"),
                                 ({"sensors": []}, "^sensors: the list is empty. Allowed: names of sensors .desk, eye, view.")]:
            with self.subTest(options), self.assertRaisesRegex(stilb.InputError, message):
                built().measure(**options)
        for call, message in [(lambda: built().measure(sensors=3), "sensors: found a value of type int. Allowed: names of sensors .desk"),
                              (lambda: built().measure(sensors=[3]), "sensors: found a value of type int"),
                              (lambda: built().measure(progress="yes"), "progress: found a value of type str. Allowed: True, or"),
                              (lambda: built().render(3), "camera: found a value of type int. Allowed: the name of a camera")]:
            with self.assertRaisesRegex(stilb.InputError, message):
                call()
        self.assertEqual(built().measure(paths=4096.0).paths, built().measure(paths=4096).paths)
        with self.assertRaisesRegex(stilb.InputError, "window has no effect with method path unless first_shot is given"):
            built().measure(method="path", window="cube")
        with self.assertRaisesRegex(TypeError, "unknown argument eror; allowed: method, error, target, time, paths"):
            built().measure(eror=0.01)


if __name__ == "__main__":
    unittest.main()
