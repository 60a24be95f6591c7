"""What is the daylight factor of a side-lit room, and does it meet EN 17037, under the overcast sky of the CIE?

    python daylight_factor.py --error 1%

EN 17037 asks for a daylight factor on half of the working plane, thus for its median, for which Stilb has no sensor. The
replicates of the readings give its error. The sky is Radiance's, by a scene file of a few lines; everything else is added
to it.
"""

import argparse
import tempfile
from pathlib import Path

import numpy as np

import stilb

OUTSIDE_LX = 10000
OVERCAST_SKY = f"""
!gensky -ang 45 0 -c -B {OUTSIDE_LX / 179}
skyfunc glow sky_glow
0
0
4 1 1 1 0
sky_glow source sky
0
0
4 0 0 1 360
"""

WIDTH, DEPTH, HEIGHT = 4, 5, 2.8
WINDOW = {"left": 0.4, "right": 3.6, "sill": 0.9, "head": 2.3}


def overcast_sky(folder: str) -> stilb.Scene:
    """A scene with nothing but the sky, whose file stays in the folder: it is read again after changes of the scene."""
    file = Path(folder, "sky.rad")
    file.write_text(OVERCAST_SKY)
    return stilb.load(file)


def add_room(scene: stilb.Scene) -> None:
    scene.materials["walls"] = stilb.Diffuse(reflectance=0.5)
    scene.materials["ceiling"] = stilb.Diffuse(reflectance=0.8)
    scene.materials["floor"] = stilb.Diffuse(reflectance=0.2)
    scene.materials["glass"] = stilb.Pane(ior=1.52, internal_transmittance=0.87)
    scene.objects["floor"] = stilb.Rectangle(corner=(0, 0, 0), edge_u=(WIDTH, 0, 0), edge_v=(0, DEPTH, 0), material="floor")
    scene.objects["ceiling"] = stilb.Rectangle(corner=(0, 0, HEIGHT), edge_u=(0, DEPTH, 0), edge_v=(WIDTH, 0, 0),
                                               material="ceiling")
    corners = [(x, y, z) for z in (0, HEIGHT) for x, y in ((0, 0), (WIDTH, 0), (WIDTH, DEPTH), (0, DEPTH))]
    scene.objects["closed walls"] = stilb.Polygons(vertices=corners, material="walls",
                                                   faces=[(1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0)])
    left, right, sill, head = WINDOW.values()
    window = [(left, 0, sill), (right, 0, sill), (right, 0, head), (left, 0, head)]
    outline = [(0, 0, 0), (0, 0, HEIGHT), (WIDTH, 0, HEIGHT), (WIDTH, 0, 0)]
    # A polygon with a hole: around the outside, across to the hole, around that the other way, and back.
    scene.objects["wall of the window"] = stilb.Polygons(vertices=outline + window, material="walls",
                                                         faces=[(0, 1, 2, 3, 0, 4, 5, 6, 7, 4)])
    scene.objects["window"] = stilb.Polygons(vertices=window, faces=[(0, 1, 2, 3)], material="glass")


def add_sensors(scene: stilb.Scene) -> None:
    scene.sensors["plane"] = stilb.Plane(height=0.85, margin=0.5)
    scene.sensors["outside"] = stilb.Illuminance(position=(WIDTH / 2, DEPTH / 2, HEIGHT + 10), normal=(0, 0, 1))
    scene.sensors["mean factor"] = stilb.Derived(value="100 * plane.mean / outside")
    scene.sensors["least factor"] = stilb.Derived(value="100 * plane.minimum / outside", require={"minimum": 0.7})


def median_factor(result: stilb.Result) -> tuple[float, float]:
    """The median of the daylight factors [%], and half of its 95 % interval."""
    plane, outside = result["plane"], result["outside"]
    replicates = 100 * np.median(plane.replicates / outside.replicates, axis=1)
    error = replicates.std(ddof=1) / np.sqrt(len(replicates))
    half_width = stilb.statistics.student_t_quantile(0.975, len(replicates) - 1) * error
    return 100 * float(np.median(plane.value / outside.value)), half_width


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--error", default="5%", help="the relative half-width of the 95 %% intervals (5%%)")
    parser.add_argument("--target", type=float, default=2.0, help="of the median [%%], by the site's sky (2.0)")
    arguments = parser.parse_args()

    with tempfile.TemporaryDirectory() as folder:
        scene = overcast_sky(folder)
        add_room(scene)
        add_sensors(scene)
        result = scene.measure(error=arguments.error, time=60)

    print(f"outside        {result['outside'].mean}")
    print(f"working plane  {result['plane'].mean} at {result['plane'].size} points")
    print(f"mean factor    {result['mean factor'].mean} %")
    limit, verdict = result["least factor"].requirements["minimum"]
    print(f"least factor   {result['least factor'].mean} %; at least {limit:g} % is required: {verdict}")
    median, half_width = median_factor(result)
    certain = abs(median - arguments.target) > half_width
    verdict = ("met" if median > arguments.target else "not met") if certain else "not certain yet"
    print(f"median factor  {median:.2f} ± {half_width:.2f} %; EN 17037 asks for {arguments.target:g} %: {verdict}")


if __name__ == "__main__":
    main()
