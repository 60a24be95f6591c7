"""Exact solutions and hypothesis tests in Python, against formulas written out here."""

import math
import unittest

import numpy as np
import stilb
from stilb import exact, statistics


class Exact(unittest.TestCase):
    def test_sobolev_has_the_direct_light_of_a_point_source(self):
        radius = np.array([[0.0, 0.5], [1.0, 3.0]])
        direct = exact.sobolev(radius, plane=2, distances=(1, 2), intensity=100, part="direct")
        np.testing.assert_allclose(direct, 100 * 2 / (4 + radius**2) ** 1.5)
        parts = [exact.sobolev(radius, part=part) for part in ("total", "direct", "indirect")]
        np.testing.assert_allclose(parts[0], parts[1] + parts[2])
        np.testing.assert_array_equal(exact.sobolev(radius, reflectances=(0, 0), part="indirect"), 0)
        with self.assertRaisesRegex(ValueError, "Allowed: total, direct, indirect"):
            exact.sobolev(1, part="all")
        with self.assertRaises(ValueError):
            exact.sobolev(-1)

    def test_closed_rooms(self):
        luminance, illuminance = exact.furnace(10, [0, 0.5, 0.9])
        np.testing.assert_allclose(luminance, [10, 20, 100])
        np.testing.assert_allclose(illuminance, math.pi * luminance)
        sphere = exact.photometric_sphere(2, 0.8, 1000)
        self.assertAlmostEqual(float(sphere), 1000 / (4 * math.pi * 4) * 0.8 / 0.2)
        walls = exact.photometric_sphere(2, 0.8, 1000, source=(0, 0, 0), to_wall=np.eye(3))
        np.testing.assert_allclose(walls, sphere + 1000 / (4 * math.pi * 4))
        mean = exact.diffuse_cube_mean(2, 1000, 0.5)
        self.assertAlmostEqual(mean, 1000 / 24 / (1 - 0.5))
        self.assertEqual(exact.diffuse_cube(2, 1000, 0.5, [0, 0.1], 0, part="direct").shape, (2,))

    def test_form_factors(self):
        factors = exact.concentric_sphere_form_factors(1, 2)
        np.testing.assert_allclose(factors, [[0, 1], [0.25, 0.75]])
        np.testing.assert_allclose(exact.two_surfaces((10, 0), (0, 0), factors), [0, 2.5])
        disks = exact.coaxial_disk_form_factors(1, 1, 1)
        self.assertAlmostEqual(disks[0, 1], (3 - math.sqrt(5)) / 2)

    def test_lights_of_simple_shape(self):
        floor = np.zeros((4, 3))
        up = (0, 0, 1)
        np.testing.assert_allclose(exact.illuminance_by_point(floor, up, (0, 0, 2), 100), 25)
        np.testing.assert_allclose(exact.illuminance_by_disk(floor, up, (0, 0, 2), (0, 0, -1), 1, 100), math.pi * 100 / 5)
        np.testing.assert_allclose(exact.illuminance_by_sphere(floor, up, (0, 0, 2), 1, 100), math.pi * 100 / 4)
        half = math.atan(0.5 / math.hypot(2, 0.5))
        expected = 4 * 100 * 0.5 / math.hypot(2, 0.5) * half
        np.testing.assert_allclose(exact.illuminance_by_rectangle(floor, up, (-0.5, -0.5, 2), (0, 1, 0), (1, 0, 0), 100),
                                   expected)
        self.assertAlmostEqual(float(exact.pane_transmittance(0)), 0.96 / 1.04)


class Statistics(unittest.TestCase):
    def test_probabilities(self):
        self.assertAlmostEqual(statistics.two_sided_p_of_z(1.959963985), 0.05)
        self.assertAlmostEqual(statistics.two_sided_p_of_t(12.70620474, 1), 0.05)
        self.assertAlmostEqual(statistics.student_t_quantile(0.975, 1), 12.70620474)
        self.assertAlmostEqual(statistics.equivalent_z(12.70620474, 1), 1.959963985)
        self.assertAlmostEqual(statistics.two_sided_p_of_z(statistics.sidak_threshold_z(0.05, 10)), 1 - 0.95**0.1)
        chi2 = statistics.chi2_test([30, 20, 10], [20, 20, 20])
        self.assertEqual((chi2.statistic, chi2.degrees_of_freedom), (10, 2))
        self.assertAlmostEqual(chi2.p_value, math.exp(-5))
        self.assertGreater(statistics.uniformity_p(np.linspace(0.05, 0.95, 10)), 0.99)

    def test_z_scores_of_results(self):
        class Mean:
            value, standard_error = 10.0, 3.0

        class Other:
            value, standard_error = 15.0, 4.0

        self.assertEqual(statistics.z_score(Mean, Other), -1)
        self.assertEqual(statistics.z_score(Mean, 7), 1)


if __name__ == "__main__":
    unittest.main()
