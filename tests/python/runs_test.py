"""Runs that are followed, saved, continued and merged; the light of each lamp, and states of the lamps."""

import copy
import json
import pickle
import tempfile
import unittest
import warnings
from pathlib import Path

import numpy as np
import stilb
from room import TOML, built, program

LAMPS = TOML.replace("[sensors.desk]", """[lights.panel]
type = "point"
position = [1, 1, 2.2]
flux = 500

[sensors.desk]""")
SCENES = """
[scenes.evening]
panel = 0.2
others = 0
"""
PATHS = 4096


def numbers(text):
    """A document of a result without its times."""
    document = json.loads(text)
    for key in ("elapsed_s", "scene"):
        document.pop(key)
    return document


class InFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        (self.folder / "room.toml").write_text(LAMPS)
        caught = warnings.catch_warnings()
        caught.__enter__()
        self.addCleanup(caught.__exit__, None, None, None)
        warnings.simplefilter("ignore", stilb.ResultWarning)

    def scene(self):
        return stilb.load(self.folder / "room.toml")

    def same(self, a, b):
        self.assertEqual(list(a), list(b))
        for name in a:
            np.testing.assert_array_equal(a[name].value, b[name].value)
            np.testing.assert_array_equal(a[name].interval(), b[name].interval())


class Shares(InFolder):
    def test_shares_add_up_to_the_readings(self):
        for by, names in (("light", {"bulb", "panel"}), ("bounce", {"0", "1", "2", "7+"})):
            result = self.scene().measure(paths=PATHS, by=by)
            self.assertLessEqual(names, set(result.shares), by)
            desk, parts = result["desk"], [share["desk"] for share in result.shares.values()]
            np.testing.assert_allclose(sum(part.value for part in parts), desk.value)
            np.testing.assert_allclose(sum(part.replicates for part in parts), desk.replicates)
            np.testing.assert_array_equal(parts[0].position, desk.position)
            self.assertTrue(np.isnan(parts[0].rgb).all())
            difference = desk.mean - sum((part.mean for part in parts[1:]), parts[0].mean)
            self.assertLess(difference.standard_error, 1e-9 * desk.mean.value)
            self.assertEqual(list(parts[0].to_pandas().columns[:3]), ["x", "y", "z"])

    def test_shares_are_those_of_the_command_line(self):
        printed = json.loads(program("measure", self.folder / "room.toml", "--json", "--paths", PATHS, "--by", "light").stdout)
        result = self.scene().measure(paths=PATHS, by="light")
        for sensor in printed["sensors"]:
            for share in sensor["shares"]:
                own = result.shares[share["name"]][sensor["name"]]
                np.testing.assert_array_equal(own.value.ravel(), [value["value"] for value in share["values"]])
                self.assertEqual(own.mean.value, share["summary"]["mean"])

    def test_missing_shares_are_explained(self):
        plain = self.scene().measure(paths=PATHS)
        for message, wrong in [('measure\\(by="light"\\)', lambda: plain.shares["panel"]),
                               ("light_scenes", lambda: plain.scenes["evening"])]:
            with self.assertRaisesRegex(KeyError, message):
                wrong()
        with self.assertRaisesRegex(stilb.InputError, 'measure\\(by="light"\\) does'):
            plain.dimmed(panel=0.5)
        result = self.scene().measure(paths=PATHS, by="light")
        with self.assertRaisesRegex(KeyError, "there are: bulb, panel"):
            result.shares["lamp"]
        with self.assertRaisesRegex(KeyError, "it has: desk, eye"):
            result.shares["panel"]["wall"]

    def test_dimmed_results_are_those_of_dimmed_lamps(self):
        result = self.scene().measure(paths=PATHS, by="light", method="path")
        dimmed = result.dimmed(panel=0.5, bulb=(0, 1, 0))
        expected = 0.5 * result.shares["panel"]["desk"].value
        self.assertTrue((dimmed["desk"].value > expected).all())
        np.testing.assert_allclose(dimmed["desk"].rgb[..., 0], result.dimmed(panel=0.5, bulb=0)["desk"].rgb[..., 0])
        np.testing.assert_allclose(result.dimmed(panel=0.5, bulb=0)["desk"].value, expected)
        self.assertGreater(dimmed["desk"].mean.standard_error, 0)
        with self.assertRaisesRegex(stilb.InputError, "lamp"):
            result.dimmed(lamp=1)
        for factor in (-1, [1, 0.5], "50%", [[1], 2], None):
            with self.subTest(factor), self.assertRaisesRegex(stilb.InputError, "lights.panel: .* is not allowed. Allowed: a factor of 0"):
                result.dimmed(panel=factor)
        with self.assertRaisesRegex(stilb.InputError, "lights: found a value of type float. Allowed: factors by the names"):
            result.dimmed(0.5)
        for same in (result.dimmed({"panel": 0.5}, bulb=[0, 1, 0]), result.dimmed(panel=np.float32(0.5), bulb=np.array([0, 1, 0]))):
            np.testing.assert_array_equal(same["desk"].value, dimmed["desk"].value)
        with self.assertRaisesRegex(stilb.InputError, "a dimmed one already. Dim the one that it was made from, with the factors of all"):
            pickle.loads(pickle.dumps(dimmed)).dimmed(bulb=1)
        with self.assertRaisesRegex(stilb.InputError, "result 1 is a dimmed one"):
            stilb.merge([dimmed])
        self.assertLess(stilb.paired(dimmed, result)["desk"].mean.value, 0)
        again = pickle.loads(pickle.dumps(result))
        np.testing.assert_array_equal(again.dimmed(panel=0.5, bulb=0)["desk"].value, result.dimmed(panel=0.5, bulb=0)["desk"].value)
        np.testing.assert_array_equal(again.shares["panel"]["desk"].value, result.shares["panel"]["desk"].value)

    def test_a_result_that_can_be_dimmed_does_not_follow_its_scene(self):
        scene = built()
        result = scene.measure(paths=PATHS, by="light")
        before = result["desk"].value.copy()
        scene.lights["bulb"].flux = 1
        np.testing.assert_allclose(result.dimmed(bulb=1)["desk"].value, before)


class LightScenes(InFolder):
    def test_light_scenes_are_read_written_and_measured(self):
        read = stilb.Scene.parse(LAMPS + SCENES)
        made = self.scene()
        made.light_scenes["evening"] = {"panel": 0.2, "others": 0}
        expected = 0.2 * made.measure(paths=PATHS, by="light").shares["panel"]["desk"].value
        made.save(self.folder / "saved.toml")
        self.assertIn("[scenes.evening]", (self.folder / "saved.toml").read_text())
        for scene in (read, made, stilb.load(self.folder / "saved.toml"), stilb.Scene.from_dict(read.to_dict()),
                      copy.copy(read), pickle.loads(pickle.dumps(read))):
            self.assertEqual(scene.light_scenes, {"evening": {"panel": 0.2, "others": 0}})
            result = scene.measure(paths=PATHS)
            np.testing.assert_allclose(result.scenes["evening"]["desk"].value, expected)
        again = pickle.loads(pickle.dumps(result))
        np.testing.assert_array_equal(again.scenes["evening"]["desk"].value, result.scenes["evening"]["desk"].value)
        self.assertGreater((result["desk"].mean - result.scenes["evening"]["desk"].mean).value, 0)
        self.assertIsNone(result.scenes["evening"].power_w)
        np.testing.assert_allclose(result.dimmed(panel=0.2, bulb=0)["desk"].value, expected)

    def test_changes_of_light_scenes_count(self):
        scene = stilb.Scene.parse(LAMPS + SCENES)
        before = scene.measure(paths=PATHS).scenes["evening"]["desk"].value
        scene.set("scenes.evening.panel", 0.4)
        np.testing.assert_allclose(scene.measure(paths=PATHS).scenes["evening"]["desk"].value, 2 * before)
        scene.light_scenes["evening"]["lamp"] = 1
        with self.assertRaisesRegex(stilb.InputError, "lamp"):
            scene.measure(paths=PATHS)
        copied = copy.copy(scene)
        copied.light_scenes["evening"]["lamp"] = 2
        self.assertEqual(scene.light_scenes["evening"]["lamp"], 1)


class Continued(InFolder):
    def test_nothing_is_computed_at_the_start(self):
        run = self.scene().start(paths=PATHS)
        self.assertEqual((run.samples, run.result, run.seeds), (0, None, [7]))
        with self.assertRaisesRegex(stilb.InputError, "no samples yet"):
            run.save(self.folder / "room.run")
        with self.assertRaisesRegex(TypeError, "unknown argument eror"):
            self.scene().start(eror=0.01)
        for wrong, message in [({"sensors": []}, "the list is empty"), ({"sensors": "chair"}, "chair"),
                               ({"method": "magic"}, 'method: "magic" is not allowed'), ({"progress": "yes"}, "progress: found a value"),
                               ({"method": "path", "window": "cube"}, "window has no effect")]:
            with self.subTest(message), self.assertRaisesRegex(stilb.InputError, message):
                self.scene().start(**wrong)

    def test_followed_runs_are_those_in_one_go(self):
        for method, error in (("path", 0.013), ("light-paths", 0.013)):
            run = self.scene().start(error=error, method=method)
            results = list(run)
            errors = [result.error for result in results]
            self.assertGreater(len(results), 1)
            self.assertGreater(min(errors[:-1]), error)
            self.assertLessEqual(errors[-1], error)
            self.assertEqual({(result.stopped, result.converged) for result in results[:-1]}, {("interrupted", False)})
            self.assertEqual((results[-1].stopped, results[-1].converged), ("target reached", True))
            whole = self.scene().measure(error=error, method=method)
            self.same(results[-1], whole)
            self.assertEqual((run.samples, run.result.paths), (whole.paths, whole.paths))

    def test_a_loop_that_is_left_goes_on(self):
        run = self.scene().start(paths=1 << 14)
        for partial in run:
            break
        self.assertLess(partial.paths, 1 << 14)
        self.assertEqual(run.samples, partial.paths)
        copies = [copy.copy(run), copy.deepcopy(run), pickle.loads(pickle.dumps(run))]
        whole = self.scene().measure(paths=1 << 14)
        self.same(run.finish(), whole)
        for copied in copies:
            self.assertEqual(copied.samples, partial.paths)
            self.same(copied.result, partial)
            self.same(copied.finish(), whole)
        more = run.finish(paths=1 << 15)
        self.same(more, self.scene().measure(paths=1 << 15))
        self.same(run.finish(), more)  # there is nothing left to do
        self.assertGreater(more.elapsed_s, whole.elapsed_s / 10)

    def test_large_grids_go_on(self):
        scene = self.scene()
        scene.sensors["desk"].count = (16, 8)
        run = scene.start(error=0.05, sensors="desk")
        for partial in run:
            if partial.paths > 1000:
                break
        self.same(run.finish(), scene.measure(error=0.05, sensors="desk"))

    def test_the_scene_is_that_of_the_start(self):
        scene = built()
        run = scene.start(paths=PATHS)
        expected = scene.measure(paths=PATHS)
        scene.lights["bulb"].flux = 1
        self.same(run.finish(), expected)

    def test_progress_and_time_end_a_run(self):
        run = self.scene().start(paths=1e8, method="path", progress=lambda report: report.stage != "")
        *_, last = run
        self.assertEqual((last.stopped, last.converged), ("interrupted", False))
        run = self.scene().start(time=0.5, method="path", sensors="eye")
        list(run)
        self.assertIn(run.result.stopped, ("time over", "interrupted"))
        self.assertLess(run.result.elapsed_s, 5)

    def test_dimmed_partial_results_keep_their_samples(self):
        run = self.scene().start(paths=1 << 15, by="light", method="path")
        first, *_, last = run
        self.assertEqual(first.dimmed(panel=0.5).paths, first.paths)
        self.assertGreater(last.paths, first.paths)


class Files(InFolder):
    def test_the_command_line_goes_on_with_saved_runs(self):
        (self.folder / "runs").mkdir()
        state = self.folder / "runs/room.run"
        scene = stilb.load(self.folder / "room.toml", set={"lights.panel.flux": 300})
        run = scene.start(paths=1 << 14, seed=3, sensors=["desk"])
        for _ in run:
            run.save(state)
            break
        self.assertIn("desk", program("info", state).stdout)
        resumed = program("resume", state, "--json")
        self.assertEqual(resumed.returncode, 0, resumed.stderr)
        whole = scene.measure(paths=1 << 14, seed=3, sensors=["desk"])
        own, expected = (json.loads(text)["sensors"] for text in (resumed.stdout, whole.to_json()))
        self.assertEqual(own, expected)
        after = stilb.resume(state)
        self.same(after.result, whole)
        self.same(after.finish(paths=1 << 15), scene.measure(paths=1 << 15, seed=3, sensors=["desk"]))

    def test_python_goes_on_with_runs_of_the_command_line(self):
        state = self.folder / "room.run"
        began = program("measure", self.folder / "room.toml", "--method", "path", "--error=5%", "--set", "lights.panel.flux=300",
                        "--state", state, "-o", self.folder / "room.json", "--quiet")
        self.assertEqual(began.returncode, 0, began.stderr)
        run = stilb.resume(state)
        scene = stilb.load(self.folder / "room.toml", set={"lights.panel.flux": 300})
        self.assertEqual(run.samples, json.loads((self.folder / "room.json").read_text())["paths"])
        self.same(run.finish(error=0.01), scene.measure(error=0.01, method="path"))
        run.save(state)
        shown = json.loads(program("measure", "--from", state, "--json").stdout)
        self.assertEqual(shown["paths"], run.samples)

    def test_runs_of_scenes_in_code_write_their_scene(self):
        scene = built()
        run = pickle.loads(pickle.dumps(scene.start(paths=1 << 15)))
        next(iter(run))
        state = self.folder / "hall.run"
        run.save(state)
        run.save(state)
        resumed = program("resume", state, "--json")
        self.assertEqual(resumed.returncode, 0, resumed.stderr)
        whole = scene.measure(paths=1 << 15)
        self.assertEqual(json.loads(resumed.stdout)["sensors"], json.loads(whole.to_json())["sensors"])
        (self.folder / "other.toml").write_text(LAMPS)
        with self.assertRaisesRegex(stilb.InputError, "other.toml is that of another one: save it elsewhere"):
            run.save(self.folder / "other.run")

    def test_pickled_runs_of_files_are_saved_with_their_files(self):
        run = pickle.loads(pickle.dumps(self.scene().start(paths=PATHS)))
        run.finish()
        run.save(self.folder / "hall.run")
        self.assertFalse((self.folder / "hall.toml").exists())
        self.same(stilb.resume(self.folder / "hall.run").result, run.result)

    def test_other_files_are_not_written_over(self):
        run = self.scene().start(paths=PATHS)
        run.finish()
        with self.assertRaisesRegex(stilb.InputError, "not the state of a run"):
            run.save(self.folder / "room.toml")
        run.save(self.folder / "a.run")
        other = self.scene().start(paths=PATHS, seed=8)
        other.finish()
        with self.assertRaisesRegex(stilb.InputError, "a.run: this is the state of another run: its seed is 7, here it is 8"):
            other.save(self.folder / "a.run")

    def test_states_that_cannot_go_on_are_explained(self):
        state = self.folder / "room.run"
        run = self.scene().start(paths=PATHS)
        run.finish()
        run.save(state)
        (self.folder / "room.toml").write_text(LAMPS.replace("500", "501"))
        with self.assertRaisesRegex(stilb.InputError, "room.run: this is the state of another run: materials"):
            stilb.resume(state)
        with self.assertRaisesRegex(stilb.InputError, "not the state of a run"):
            stilb.resume(self.folder / "room.toml")
        (self.folder / "room.toml").write_text(LAMPS)
        grid = self.folder / "grid.run"
        made = program("measure", self.folder / "room.toml", "--grid", "z=0.8", "--paths", 64, "--state", grid)
        self.assertEqual(made.returncode, 0, made.stderr)
        with self.assertRaisesRegex(stilb.InputError, "grid.run: this run cannot go on here: .*--grid.*stilb resume"):
            stilb.resume(grid)


class Merged(InFolder):
    def test_parts_of_the_command_line_are_merged(self):
        files = [self.folder / f"part{number}.run" for number in range(1, 4)]
        for number, file in enumerate(files, 1):
            made = program("measure", self.folder / "room.toml", "--paths", PATHS, "--part", f"{number}/3", "--state", file)
            self.assertEqual(made.returncode, 0, made.stderr)
        merged = stilb.merge(files)
        self.same(merged.result, self.scene().measure(paths=PATHS))
        merged.save(self.folder / "all.run")
        shown = program("measure", "--from", self.folder / "all.run", "--json")
        self.assertEqual(numbers(shown.stdout)["sensors"], numbers(merged.result.to_json())["sensors"])
        with self.assertRaisesRegex(stilb.InputError, "part1.run cannot be merged with .*part1.run: both have made the same samples"):
            stilb.merge([files[0], files[0]])

    def test_runs_of_other_scenes_are_not_merged(self):
        def run(seed, change=lambda scene: None):
            scene = built()
            change(scene)
            run = scene.start(paths=256, method="path", seed=seed)
            run.finish()
            return run

        def move(scene):
            scene.lights["bulb"].position = (1.5, 1.5, 2.3)

        def turn(scene):
            scene.objects["room"] = stilb.Box(min=(0, 0, 0), max=(4, 3, 2.5), material="wall")
            scene.materials["wall"] = stilb.Ward(diffuse=.3, specular=.2, roughness=(.2, .2))

        def roughen(scene):
            turn(scene)
            scene.materials["wall"].roughness = (.2, .21)

        stilb.merge([run(1), run(2)])
        stilb.merge([run(1, turn), run(2, turn)])
        for first, second in ((None, move), (None, turn), (turn, roughen)):
            with self.assertRaisesRegex(stilb.InputError, "run 2 cannot be merged with run 1: .* its scene"):
                stilb.merge([run(1, first) if first else run(1), run(2, second)])

    def test_parts_of_two_seeds_are_merged_in_any_order(self):
        files = []
        for number, seed in ((1, 7), (1, 8), (2, 7), (2, 8)):
            files.append(self.folder / f"{seed}_{number}.run")
            made = program("measure", self.folder / "room.toml", "--paths", PATHS, "--seed", seed, "--part", f"{number}/2", "--state", files[-1])
            self.assertEqual(made.returncode, 0, made.stderr)
        merged = stilb.merge(files)
        self.assertEqual((merged.seeds, merged.samples), ([7, 8], 2 * PATHS))
        with self.assertRaisesRegex(stilb.InputError, "7_2.run cannot be merged with .*7_1.run: both have made the same samples"):
            stilb.merge([*files, files[2]])

    def test_seeds_are_merged(self):
        scene = self.scene()
        runs = [scene.start(paths=PATHS, method="path", seed=seed) for seed in (1, 2, 3)]
        for run in runs:
            run.finish()
        runs[1] = pickle.loads(pickle.dumps(runs[1]))  # as from another process
        runs[2].save(self.folder / "three.run")
        merged = stilb.merge([runs[0], runs[1], self.folder / "three.run"])
        self.assertEqual((merged.seeds, merged.samples), ([1, 2, 3], 3 * PATHS))
        np.testing.assert_allclose(merged.result["desk"].value, np.mean([run.result["desk"].value for run in runs], 0))
        with self.assertRaisesRegex(stilb.InputError, "several seeds, and cannot go on"):
            merged.finish(paths=4 * PATHS)
        with self.assertRaisesRegex(stilb.InputError, "run 2 cannot be merged with run 1: both have made the same samples"):
            stilb.merge([runs[0], runs[0]])

    def test_other_runs_are_refused(self):
        scene = self.scene()
        run = scene.start(paths=PATHS)
        run.finish()
        scene.lights["panel"].flux = 400
        other = scene.start(paths=PATHS, seed=8)
        other.finish()
        with self.assertRaisesRegex(stilb.InputError, "run 2 cannot be merged with run 1: .*materials, objects or lights"):
            stilb.merge([run, other])
        with self.assertRaisesRegex(stilb.InputError, "result 2 has not kept its sums"):
            stilb.merge([run, run.result])
        by_light = built().measure(paths=64, by="light")
        for wrong, message in [([], "the list is empty"), (by_light, "runs: found a value of type Result. Allowed: a list"),
                               ("a.run", "runs: found a value of type str. Allowed: a list of runs and names"), (run, "ResumableRun. Allowed"),
                               (Path("a.run"), "runs: found a value of type .*Path. Allowed"), ([run, 3], "run 2: found a value of type int"),
                               ([scene.start(paths=PATHS)], "run 1 has not begun, and has nothing to merge")]:
            with self.subTest(message), self.assertRaisesRegex(stilb.InputError, message):
                stilb.merge(wrong)

    def test_results_by_light_are_merged(self):
        scene = self.scene()
        results = [scene.measure(paths=PATHS, by="light", method="path", seed=seed) for seed in (1, 2)]
        merged = stilb.merge(results).result
        np.testing.assert_allclose(merged.dimmed(panel=0.5)["desk"].value,
                                   np.mean([result.dimmed(panel=0.5)["desk"].value for result in results], 0))


if __name__ == "__main__":
    unittest.main()
