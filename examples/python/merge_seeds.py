"""How are runs of several seeds put together, and what is wrong with the mean of their results?

    python merge_seeds.py ../../scenes/simple/room.toml table --seeds 6

Each run could be made on another machine: its state is a file, and the files are merged. The merged result is that of one run
with as many samples, with errors of everything, also of the minimum and of the uniformity. The mean of the runs' minima
is too small instead, since each minimum is that of a noisier grid.
"""

import argparse
import tempfile
from pathlib import Path

import numpy as np

import stilb

SIMPLE_ROOM = Path(__file__).resolve().parents[2] / "scenes/simple/room.toml"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", nargs="?", default=SIMPLE_ROOM, help="a scene file (that of the simple room)")
    parser.add_argument("sensor", nargs="?", default="table", help="the name of a grid in it (table)")
    parser.add_argument("--seeds", type=int, default=8)
    parser.add_argument("--paths", type=float, default=32, help="of each reading and seed (32)")
    arguments = parser.parse_args()

    scene = stilb.load(arguments.scene)
    with tempfile.TemporaryDirectory() as folder:
        files = [Path(folder, f"seed{seed}.run") for seed in range(1, arguments.seeds + 1)]
        singles = []
        for seed, file in enumerate(files, 1):
            run = scene.start(sensors=[arguments.sensor], method="path", seed=seed, paths=arguments.paths)
            singles.append(run.finish()[arguments.sensor])
            run.save(file)
        merged = stilb.merge(files).result

    grid = merged[arguments.sensor]
    for seed, single in enumerate(singles, 1):
        print(f"seed {seed}        mean {single.mean}   minimum {single.minimum}   uniformity {single.uniformity}")
    print(f"merged        mean {grid.mean}   minimum {grid.minimum}   uniformity {grid.uniformity}")
    mean = sum(single.mean for single in singles) / len(singles)  # seeds are independent
    print(f"mean of runs  mean {mean}   minimum {np.mean([single.minimum.value for single in singles]):.1f} (too small)")

    covariance = merged.covariance(arguments.sensor)
    errors = np.sqrt(np.diag(covariance))
    correlation = covariance / np.outer(errors, errors)
    print(f"{merged.paths} paths in {merged.replicates} replicates; the errors of the first reading and its neighbour have a "
          f"correlation of {correlation[0, 1]:.2f}, those of the first and the last one {correlation[0, -1]:.2f}")


if __name__ == "__main__":
    main()
