"""Arithmetic with estimates, covariances and paired differences: errors that contain the correlations."""

import json
import pickle
import unittest
import warnings

import numpy as np
import stilb
from room import built

PATHS = 4096


def room_with_formulas():
    scene = built()
    for name, formula in [("difference", "desk.mean - wall.mean"), ("ratio", "desk.minimum / wall.mean"),
                          ("excess", "(desk.maximum - desk.mean) / desk.mean"), ("product", "3 * desk.uniformity * wall.mean"),
                          ("inverse", "2 / wall.mean - 1")]:
        scene.sensors[name] = stilb.Derived(value=formula)
    scene.sensors["wall"] = stilb.Illuminance(position=(4, 1.5, 1), normal=(-1, 0, 0))
    return scene


class Replicates(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.result = room_with_formulas().measure(paths=PATHS)

    def test_replicates_are_the_basis_of_the_errors(self):
        desk = self.result["desk"]
        self.assertEqual(desk.replicates.shape, (self.result.replicates, 2, 4))
        np.testing.assert_allclose(desk.replicates.mean(0), desk.value, rtol=1e-12)
        error = desk.replicates.std(0, ddof=1) / np.sqrt(len(desk.replicates))
        np.testing.assert_allclose(error, desk.standard_error, rtol=1e-9)
        np.testing.assert_allclose(self.result["difference"].replicates.mean(), self.result["difference"].value, rtol=1e-9)
        self.assertFalse(desk.replicates.flags.writeable or desk.replicates.flags.owndata)

    def test_replicates_have_the_shape_of_the_points(self):
        reading = built().illuminance(np.full((5, 2, 3), 1.0), (0, 0, 1), paths=PATHS)
        self.assertEqual(reading.replicates.shape[1:], (5, 2))
        np.testing.assert_allclose(reading.replicates.mean(0), reading.value, rtol=1e-12)

    def test_covariances(self):
        desk, wall = self.result["desk"], self.result["wall"]
        own = self.result.covariance("desk")
        self.assertEqual(own.shape, (8, 8))
        np.testing.assert_allclose(np.sqrt(np.diag(own)).reshape(2, 4), desk.standard_error, rtol=1e-9)
        np.testing.assert_allclose(np.sqrt(own.mean()), desk.mean.standard_error, rtol=1e-9)
        both = self.result.covariance("desk", "wall")
        self.assertEqual(both.shape, (8, 1))
        variance = own.mean() + wall.standard_error[0] ** 2 - 2 * both.mean()
        np.testing.assert_allclose(variance, self.result["difference"].standard_error[0] ** 2, rtol=1e-9)


class Arithmetic(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scene = room_with_formulas()
        cls.result = cls.scene.measure(paths=PATHS)
        cls.desk, cls.wall = cls.result["desk"], cls.result["wall"]

    def same(self, estimate, name):
        derived = self.result[name].mean
        np.testing.assert_allclose([estimate.value, estimate.standard_error, *estimate.interval],
                                   [derived.value, derived.standard_error, *derived.interval], rtol=1e-9, err_msg=name)

    def test_errors_are_those_of_derived_sensors(self):
        desk, wall = self.desk, self.wall
        self.same(desk.mean - wall.mean, "difference")
        self.same(-(wall.mean - desk.mean), "difference")
        self.same(desk.minimum / wall.mean, "ratio")
        self.same((desk.maximum - desk.mean) / desk.mean, "excess")
        self.same(3 * (desk.uniformity * wall.mean), "product")
        self.same(2 / wall.mean + -1, "inverse")
        self.assertLess((desk.mean - wall.mean).standard_error,
                        0.9 * np.hypot(desk.mean.standard_error, wall.mean.standard_error))

    def test_what_is_equal_has_no_difference(self):
        difference = self.desk.mean - self.desk.mean
        self.assertEqual((difference.value, difference.standard_error, difference.interval), (0, 0, (0, 0)))

    def test_units(self):
        desk = self.desk
        self.assertEqual((desk.mean - self.wall.mean).unit, "lx")
        self.assertEqual((desk.minimum / desk.mean).unit, "")
        self.assertEqual((desk.uniformity * desk.mean).unit, "lx")
        self.assertEqual((2 * desk.mean).unit, "lx")
        with self.assertRaisesRegex(stilb.InputError, "lx and .* cd/m2 have different units"):
            desk.mean + self.result["eye"].mean
        with self.assertRaises(TypeError):
            desk.mean + "1"

    def test_formats(self):
        mean = self.desk.mean
        self.assertEqual(f"{mean:.1f}", f"{mean.value:.1f}")
        self.assertEqual(f"{mean}", repr(mean))

    def test_what_has_no_interval_is_refused(self):
        mean = self.desk.mean
        for wrong, meant in [(lambda: abs(mean), r"abs\(estimate.value\)"), (lambda: mean < 3, r"Compare their values \(estimate.value\)"),
                             (lambda: max(mean, self.wall.mean), "no order"), (lambda: round(mean, 1), r"round\(estimate.value, 1\)")]:
            with self.assertRaisesRegex(TypeError, meant):
                wrong()

    def test_results_with_other_seeds_are_independent(self):
        a, b = self.desk.mean, self.scene.measure(paths=PATHS, seed=8)["desk"].mean
        difference = a - b
        self.assertAlmostEqual(difference.standard_error, np.hypot(a.standard_error, b.standard_error), 12)
        low, high = difference.interval
        degrees = 2 * (self.result.replicates - 1)  # at most; at least the smaller one
        t = [stilb.statistics.student_t_quantile(0.975, degrees // n) for n in (1, 2)]
        half_width = (high - low) / 2
        beyond = sum((estimate.interval[1] - estimate.interval[0]) / 2 - t[1] * estimate.standard_error for estimate in (a, b))
        self.assertGreaterEqual(half_width, t[0] * difference.standard_error * (1 - 1e-9))
        self.assertLessEqual(half_width, t[1] * difference.standard_error + beyond + 1e-9)
        mean_of_both = (a + b) / 2
        self.assertAlmostEqual((mean_of_both - a).standard_error, difference.standard_error / 2, 12)

    def test_results_with_the_same_seed_are_refused(self):
        other = self.scene.measure(paths=2 * PATHS)["desk"].mean
        with self.assertRaisesRegex(stilb.InputError, r"same seed \(7\).*stilb.paired\(after, before\)"):
            self.desk.mean - other
        with self.assertRaisesRegex(stilb.InputError, "same seed"):
            (self.desk.mean - self.scene.measure(paths=PATHS, seed=8)["desk"].mean) / other

    def test_coverage_of_a_difference_of_sensors(self):
        """The interval of desk - wall contains the difference of a long run in about 95 % of the runs."""
        self.scene.sensors.pop("eye", None)
        truth = self.scene.measure(paths=2**20, seed=99)
        expected = truth["desk"].mean.value - truth["wall"].mean.value
        hits = 0
        for seed in range(100, 160):
            result = self.scene.measure(paths=PATHS, seed=seed)
            low, high = (result["desk"].mean - result["wall"].mean).interval
            hits += low <= expected <= high
        self.assertGreaterEqual(hits, 48)  # of 60; fewer have a probability of 1e-5


class SeveralRuns(unittest.TestCase):
    """Few paths, so that light is rare."""

    @classmethod
    def setUpClass(cls):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", stilb.ResultWarning)
            cls.runs = [built().start(paths=1024, method="path", seed=seed) for seed in range(1, 9)]
            cls.results = [run.finish() for run in cls.runs]
            cls.merged = stilb.merge(cls.runs).result

    @staticmethod
    def widths(estimate):
        """Below and above the value."""
        return estimate.value - estimate.interval[0], estimate.interval[1] - estimate.value

    def test_margins_for_rare_light_of_independent_runs_add_in_quadrature(self):
        means = [result["eye"].mean for result in self.results]
        margins = [above - below for below, above in map(self.widths, means)]  # those below have Student's t alone
        self.assertGreater(max(margins), 0)
        below, above = self.widths(sum(means[1:], means[0]) / len(means))
        self.assertAlmostEqual(above - below, np.hypot.reduce(margins) / len(means))
        # The merged run is the same mean: it is not less sure but for its smaller number of degrees of freedom.
        self.assertLess(self.widths(self.merged["eye"].mean)[1], 1.2 * above)
        a, b = means[:2]
        below, above = self.widths(a - b)
        self.assertAlmostEqual(above - below, margins[0] - margins[1])

    def test_biases_of_minima_add_up(self):
        minima = [result["desk"].minimum for result in self.results[:2]]
        beyond = [self.widths(minimum)[1] - self.widths(minimum)[0] for minimum in minima]
        below, above = self.widths(minima[0] + minima[1])
        self.assertAlmostEqual(above - below, sum(beyond))

    def test_merged_runs_have_all_seeds(self):
        self.assertEqual((self.merged.seeds, self.merged["eye"].run.seeds), (tuple(range(1, 9)), tuple(range(1, 9))))
        self.assertEqual((self.results[2].seeds, self.results[2].seed), ((3,), 3))
        document = json.loads(self.merged.to_json())
        self.assertEqual((document["seed"], document["seeds"]), (1, list(range(1, 9))))
        self.assertNotIn("seeds", json.loads(self.results[0].to_json()))
        again = pickle.loads(pickle.dumps(self.merged))
        with self.assertRaisesRegex(stilb.InputError, r"same seed \(5\), so that .* Take runs without a common seed"):
            again["eye"].mean - self.results[4]["eye"].mean
        self.assertEqual((again["eye"].mean - self.merged["eye"].mean).value, 0)
        half, other, overlapping = (stilb.merge(self.runs[begin:end]).result for begin, end in ((0, 4), (4, 8), (3, 8)))
        difference = half["eye"].mean - other["eye"].mean
        self.assertAlmostEqual(difference.standard_error, np.hypot(half["eye"].mean.standard_error, other["eye"].mean.standard_error))
        with self.assertRaisesRegex(stilb.InputError, r"same seed \(4\)"):
            half["eye"].mean - overlapping["eye"].mean

    def test_merged_runs_of_the_same_seeds_are_paired(self):
        scene = built()
        scene.materials["wall"].reflectance = (0.71, 0.51, 0.31)
        others = [scene.start(paths=1024, method="path", seed=seed) for seed in (2, 1)]
        for run in others:
            run.finish()
        pair = stilb.paired(stilb.merge(others).result, stilb.merge(self.runs[:2]).result)["desk"].mean
        self.assertTrue(pair.interval[0] > 0 and pair.standard_error < self.merged["desk"].mean.standard_error)
        with self.assertRaisesRegex(stilb.InputError, r"the seeds 1 and \(1, 2\), so that their errors are partly the same"):
            stilb.paired(self.results[0], stilb.merge(self.runs[:2]).result)
        with self.assertRaisesRegex(stilb.InputError, r"the seeds 3 and \(1, 2\), so that their errors are independent"):
            stilb.paired(self.results[2], stilb.merge(self.runs[:2]).result)


class Pairs(unittest.TestCase):
    def test_paired_differences_are_better_known(self):
        scene = built()
        before = scene.measure(paths=PATHS, method="path")
        scene.materials["wall"].reflectance = (0.71, 0.51, 0.31)
        after = scene.measure(paths=PATHS, method="path")
        pair = stilb.paired(after, before)
        desk = pair["desk"]
        self.assertEqual(list(pair), ["desk", "eye"])
        np.testing.assert_array_equal(desk.value, after["desk"].value - before["desk"].value)
        replicates = after["desk"].replicates - before["desk"].replicates
        np.testing.assert_allclose(desk.standard_error, replicates.std(0, ddof=1) / np.sqrt(len(replicates)), rtol=1e-12)
        of_mean = replicates.mean((1, 2))
        self.assertAlmostEqual(desk.mean.value, of_mean.mean(), 9)
        self.assertAlmostEqual(desk.mean.standard_error, of_mean.std(ddof=1) / np.sqrt(len(of_mean)), 9)
        self.assertEqual(desk.mean.unit, "lx")
        independent = np.hypot(after["desk"].mean.standard_error, before["desk"].mean.standard_error)
        self.assertLess(desk.mean.standard_error, independent / 5)
        low, high = desk.interval
        self.assertTrue(np.all((low < desk.value) & (desk.value < high)))
        t = stilb.statistics.student_t_quantile(0.975, before.replicates - 1)
        np.testing.assert_allclose(high - desk.value, t * desk.standard_error)
        np.testing.assert_allclose(desk.value - low, t * desk.standard_error)
        for estimate in (desk.mean, desk.minimum, desk.uniformity):
            np.testing.assert_allclose(estimate.interval, estimate.value + t * estimate.standard_error * np.array([-1, 1]))
        scene.run["seed"] = 1000
        truth = [scene.measure(paths=2**19, method="path")["desk"].mean.value]
        scene.materials["wall"].reflectance = (0.7, 0.5, 0.3)
        truth.append(scene.measure(paths=2**19, method="path")["desk"].mean.value)
        self.assertLess(abs(desk.mean.value - (truth[0] - truth[1])), 5 * desk.mean.standard_error)
        self.assertLess(desk.uniformity.standard_error, after["desk"].uniformity.standard_error)

    def test_equal_runs_have_no_difference(self):
        pair = stilb.paired(built().measure(paths=PATHS), built().measure(paths=PATHS))
        self.assertEqual((pair["desk"].mean.value, pair["desk"].mean.standard_error), (0, 0))
        self.assertEqual(pair["desk"].minimum.standard_error, 0)
        self.assertIn("desk: 0", repr(pair))

    def test_runs_that_do_not_belong_together_are_refused(self):
        scene = built()
        a = scene.measure(paths=PATHS)
        with self.assertRaisesRegex(stilb.InputError, "seeds 7 and 8, so that their errors are independent"):
            stilb.paired(a, scene.measure(paths=PATHS, seed=8))
        other = stilb.Scene.from_dict(scene.to_dict())
        other.sensors["desk"].count = (3, 2)
        self.assertEqual(list(stilb.paired(a, other.measure(paths=PATHS))), ["eye"])
        with self.assertRaisesRegex(stilb.InputError, "no sensor of the same name and size in common: desk; eye"):
            stilb.paired(scene.measure(paths=PATHS, sensors=["desk"]), scene.measure(paths=PATHS, sensors=["eye"]))
        with self.assertRaisesRegex(stilb.InputError, "before: found a value of type Reading. Allowed: results of scene.measure"):
            stilb.paired(a, a["desk"])
        with self.assertRaisesRegex(KeyError, "no sensor 'desc' in common; they have: desk, eye"):
            stilb.paired(a, scene.measure(paths=PATHS))["desc"]


if __name__ == "__main__":
    unittest.main()
