"""Which of many rooms have too little light? Each room in a process of its own, the results in one table.

    python many_rooms.py --rooms 500 --processes 8

The rooms go to the processes as scenes, and whole results come back: both can be pickled. Processes are spawned, since a
process that is forked has the locks of threads that it does not have. Needs pandas.
"""

import argparse
import warnings
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context

import numpy as np
import pandas

import stilb

REQUIRED = {"mean": 100, "uniformity": 0.4}


def room(number: int) -> stilb.Scene:
    """Rooms of various sizes and reflectances, with one lamp below the middle of the ceiling."""
    random = np.random.default_rng(number)
    width, depth, height = random.uniform((3, 3, 2.5), (8, 6, 3.2))
    scene = stilb.Scene(f"room {number}")
    scene.materials["wall"] = stilb.Diffuse(reflectance=random.uniform(0.4, 0.7))
    scene.objects["room"] = stilb.Box(min=(0, 0, 0), max=(width, depth, height), material="wall")
    scene.lights["lamp"] = stilb.SphereLight(center=(width / 2, depth / 2, height - 0.3), radius=0.1, flux=4000)
    scene.sensors["task"] = stilb.Grid(corner=(0.5, 0.5, 0.75), edge_u=(width - 1, 0, 0), edge_v=(0, depth - 1, 0),
                                       count=(6, 5), require=REQUIRED)
    return scene


def measured(scene: stilb.Scene, error: float) -> stilb.Result:
    """A process has one thread, since as many processes run as there are processors. The table has the warnings."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", stilb.ResultWarning)
        return scene.measure(error=error, time=10, threads=1)


def table(scenes: list[stilb.Scene], results: list[stilb.Result]) -> pandas.DataFrame:
    return pandas.DataFrame([{
        "room": scene.name,
        "mean [lx]": str(result["task"].mean),
        "uniformity": str(result["task"].uniformity),
        **{key: result["task"].requirements[key][1] for key in REQUIRED},
        "converged": result.converged,
        "warnings": len(result.warnings),
    } for scene, result in zip(scenes, results)])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rooms", type=int, default=12)
    parser.add_argument("--processes", type=int, default=2)
    parser.add_argument("--error", default="2%", help="the relative half-width of the 95 %% intervals (2%%)")
    arguments = parser.parse_args()

    scenes = [room(number) for number in range(arguments.rooms)]
    with ProcessPoolExecutor(arguments.processes, mp_context=get_context("spawn")) as pool:
        results = list(pool.map(measured, scenes, [arguments.error] * len(scenes)))
    rows = table(scenes, results)
    print(rows.to_string(index=False))
    met = (rows[list(REQUIRED)] == "pass").all(axis=1).sum()
    print(f"{met} of {len(rows)} rooms have {REQUIRED['mean']} lx and a uniformity of {REQUIRED['uniformity']} for certain.")


if __name__ == "__main__":
    main()
