"""Does another program say the same? Stilb beside Mitsuba 3, at the points of a sensor of any scene.

    python compare_mitsuba.py ../../scenes/simple/room.toml table --samples 4096

Needs pip install mitsuba, and LLVM: where Mitsuba does not find it, DRJIT_LIBLLVM_PATH names its library.
"""

import argparse
import importlib
import sys
import tempfile
from pathlib import Path

import mitsuba
import numpy as np

import stilb

SIMPLE_ROOM = Path(__file__).resolve().parents[2] / "scenes/simple/room.toml"


def by_mitsuba(scene: stilb.Scene, sensor: str, runs: int, samples: int) -> tuple[np.ndarray, np.ndarray]:
    """The points (n, 3), and the illuminances in each of the runs (runs, n)."""
    with tempfile.TemporaryDirectory() as folder:
        scene.export(folder, "mitsuba")
        sys.path.insert(0, folder)
        measure = importlib.import_module("measure")  # written beside the scene
        exported, integrator = measure.load(folder), mitsuba.load_dict(measure.PATH_TRACER)
        points, normals = measure.read_points(Path(folder, f"{sensor}.pts"))
    size = samples // runs
    return points, np.array([
        measure.illuminance(exported, integrator, points, normals, size, measure.seeded_sampler(seed, size * len(points)))
        for seed in range(runs)])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", nargs="?", default=SIMPLE_ROOM, help="a scene file (that of the simple room)")
    parser.add_argument("sensor", nargs="?", default="table", help="the name of a sensor in it (table)")
    parser.add_argument("--error", default="1%", help="the relative half-width of Stilb's 95 %% intervals (1%%)")
    parser.add_argument("--samples", type=int, default=2048, help="of each reading by Mitsuba (2048)")
    arguments = parser.parse_args()

    scene = stilb.load(arguments.scene)
    reading = scene.measure(sensors=[arguments.sensor], error=arguments.error)[arguments.sensor]
    points, values = by_mitsuba(scene, arguments.sensor, 16, arguments.samples)
    if not np.allclose(points, reading.position.reshape(-1, 3), atol=1e-4):
        raise SystemExit("The points of the two programs are not the same.")

    means = values.mean(axis=1)
    error = means.std(ddof=1) / np.sqrt(len(means))
    half_width = stilb.statistics.student_t_quantile(0.975, len(means) - 1) * error
    distance = (reading.mean.value - means.mean()) / np.hypot(error, reading.mean.standard_error)
    print(f"Stilb    mean {reading.mean}")
    print(f"Mitsuba  mean {means.mean():.2f} ± {half_width:.2f} {reading.unit}")
    print(f"The means are {abs(distance):.1f} standard errors apart.")

    errors = np.hypot(values.std(axis=0, ddof=1) / np.sqrt(len(values)), reading.standard_error.ravel())
    distances = (reading.value.ravel() - values.mean(axis=0)) / errors
    threshold = stilb.statistics.sidak_threshold_z(0.01, len(distances))
    print(f"Of {len(distances)} readings, the farthest are {np.abs(distances).max():.1f} standard errors apart "
          f"(where all agree, 1 % of such comparisons exceed {threshold:.1f}).")


if __name__ == "__main__":
    main()
