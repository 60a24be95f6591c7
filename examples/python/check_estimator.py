"""Are the numbers unbiased, and do 95 % intervals contain the truth in 95 % of runs? Many seeds against an exact solution.

    python check_estimator.py --seeds 400 --methods auto path local

The room is a sphere, whose walls all get the same reflected light: `stilb.exact` has its illuminances. Each line tells for a
method the mean deviation from the exact values in standard errors (about 0 to 2), the scatter between seeds over the stated
standard error (about 1), the share of intervals that contain the exact value, and how probable such deviations are if
the stated errors are right: by the chi-square test of their counts in bins, and by that of Kolmogorov and Smirnov.
"""

import argparse

import numpy as np

import stilb

FLUX = 1000
REFLECTANCE = 0.8
LAMP = (0, 0, 0.5)
TO_WALL = np.array([(0, 0, -1), (1, 0, 0), (0, 0.6, 0.8), (0.6, -0.8, 0)])
BINS = 6


def sphere() -> stilb.Scene:
    scene = stilb.Scene("sphere")
    scene.materials["white"] = stilb.Diffuse(reflectance=REFLECTANCE)
    scene.objects["wall"] = stilb.Sphere(center=(0, 0, 0), radius=1, material="white")
    scene.lights["lamp"] = stilb.PointLight(position=LAMP, flux=FLUX)
    return scene


def describe(scene: stilb.Scene, method: str, seeds: int, paths: float) -> str:
    exact = stilb.exact.photometric_sphere(1, REFLECTANCE, FLUX, source=LAMP, to_wall=TO_WALL)
    readings = [scene.illuminance(TO_WALL, -TO_WALL, method=method, paths=paths, seed=seed) for seed in range(1, seeds + 1)]
    values = np.array([reading.value for reading in readings])
    errors = np.array([reading.standard_error for reading in readings])
    low, high = np.array([reading.interval() for reading in readings]).swapaxes(0, 1)

    bias = (values.mean(0) - exact) / (values.std(0, ddof=1) / np.sqrt(seeds))
    scatter = values.std(0, ddof=1) / np.sqrt((errors**2).mean(0))
    coverage = ((low <= exact) & (exact <= high)).mean()
    # The readings of one run have errors in common, those of the first alone are independent.
    degrees = readings[0].run.replicates - 1
    deviations = (values[:, 0] - exact[0]) / errors[:, 0]
    probabilities = [stilb.statistics.two_sided_p_of_t(t, degrees) for t in deviations]
    counts, _ = np.histogram(probabilities, np.linspace(0, 1, BINS + 1))
    by_bins = stilb.statistics.chi2_test(counts, [seeds / BINS] * BINS).p_value
    by_order = stilb.statistics.uniformity_p(probabilities)
    return (f"{method:12s} {np.abs(bias).max():10.2f}   {scatter.min():.2f} to {scatter.max():.2f}   {100 * coverage:6.1f} %"
            f"   {by_bins:10.3f} {by_order:11.3f}")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seeds", type=int, default=60, help="30 or more (60)")
    parser.add_argument("--paths", type=float, default=512, help="of each run (512)")
    parser.add_argument("--methods", nargs="+", default=["auto", "path", "local"])
    arguments = parser.parse_args()

    print("method      largest bias   scatter/stated    covered   chi-square p   K.-S. p")
    for method in arguments.methods:
        print(describe(sphere(), method, arguments.seeds, arguments.paths))


if __name__ == "__main__":
    main()
