"""What do lighter walls and a stronger lamp change on a desk? A table of variants, with errors of their differences.

    python sweep.py --paths 2048

All variants have the same random numbers, so that most of the noise cancels in differences, and each ± behind a change is far
smaller than that of the value. `stilb.sweep` varies what a key of the scene file has; for any other change, here a shelf, one
measures twice, and `stilb.paired` has the difference. Needs pandas.
"""

import argparse

import numpy as np

import stilb

REFLECTANCE = "materials.wall.reflectance"
FLUX = "lights.bulb.flux"


def room() -> stilb.Scene:
    scene = stilb.Scene("room with a desk")
    scene.materials["wall"] = stilb.Diffuse(reflectance=0.5)
    scene.objects["room"] = stilb.Box(min=(0, 0, 0), max=(4, 3, 2.5), material="wall")
    scene.objects["desk"] = stilb.Box(min=(1, 1, 0), max=(2.6, 1.8, 0.74), material="wall")
    scene.lights["bulb"] = stilb.SphereLight(center=(2, 1.5, 2.2), radius=0.1, flux=800)
    scene.sensors["desk"] = stilb.Grid(corner=(1, 1, 0.75), edge_u=(1.6, 0, 0), edge_v=(0, 0.8, 0), count=(8, 4))
    return scene


def with_error(row, name: str, low: str, high: str, digits: int) -> str:
    return f"{row[name]:.{digits}f} ± {(row[high] - row[low]) / 2:.{digits}f}"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--paths", type=float, default=1024, help="of each reading in each variant (1024)")
    parser.add_argument("--reflectances", type=float, nargs="+", default=[0.5, 0.52, 0.6, 0.7])
    parser.add_argument("--fluxes", type=float, nargs="+", default=[800, 840], help="[lm]")
    arguments = parser.parse_args()

    variations = {REFLECTANCE: arguments.reflectances, FLUX: arguments.fluxes}
    table = stilb.sweep(room(), variations, paths=arguments.paths)

    print("walls    lamp    mean [lx]        change           uniformity")
    means, uniformities = (table[table["statistic"] == name].set_index([REFLECTANCE, FLUX]) for name in ("mean", "uniformity"))
    for (reflectance, flux), mean in means.iterrows():
        print(f"{reflectance:.2f}  {flux:4.0f} lm  "
              f"{with_error(mean, 'value', 'interval_low', 'interval_high', 2):15s}  "
              f"{with_error(mean, 'difference', 'difference_low', 'difference_high', 3):15s}  "
              f"{with_error(uniformities.loc[reflectance, flux], 'value', 'interval_low', 'interval_high', 4)}")

    before, after = room(), room()
    after.objects["shelf"] = stilb.Box(min=(1, 2.7, 1.2), max=(2.6, 3, 1.24), material="wall")
    without, with_shelf = (scene.measure(paths=arguments.paths, method="path") for scene in (before, after))
    difference = stilb.paired(with_shelf, without)["desk"].mean
    independent = np.hypot(with_shelf["desk"].mean.standard_error, without["desk"].mean.standard_error)
    print(f"A shelf above the desk changes the mean by {difference.value:.3f} lx, with a standard error of "
          f"{difference.standard_error:.3f} lx: {independent / difference.standard_error:.1f} times less than of independent runs.")


if __name__ == "__main__":
    main()
