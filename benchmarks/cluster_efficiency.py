#!/usr/bin/env python3
"""Compares runs on Dask workers with a run in one process, by samples per second of processor time.

Usage: cluster_efficiency.py [SCENE] [PATHS] [REPETITIONS]

Runs by `paths` and, to the error that they reach, by `error`, on one and on two workers with one thread each. Processor time
does not depend on what else the machine does, apart from caches.
"""

import statistics
import sys
import time
import warnings
from pathlib import Path

import distributed
import stilb

ROOT = Path(__file__).resolve().parents[1]


def alone(scene, **limits):
    before = time.process_time()
    result = scene.measure(threads=1, method="path", **limits)
    return result, time.process_time() - before, 0.0


def on_workers(client):
    def run(scene, **limits):
        before, own = client.run(time.process_time), time.process_time()
        result = stilb.distributed.measure(scene, client, method="path", **limits)
        after = client.run(time.process_time)
        return result, sum(after[worker] - before[worker] for worker in after), time.process_time() - own

    return run


def main():
    warnings.simplefilter("ignore", stilb.ResultWarning)
    scene = stilb.load(sys.argv[1] if len(sys.argv) > 1 else ROOT / "scenes/simple/room.toml")
    paths = int(float(sys.argv[2])) if len(sys.argv) > 2 else 1 << 19
    repetitions = int(sys.argv[3]) if len(sys.argv) > 3 else 3
    with (distributed.LocalCluster(n_workers=1, threads_per_worker=1, dashboard_address=":0") as one,
          distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=":0") as two,
          distributed.Client(one) as first, distributed.Client(two) as second):
        ways = {"one process": alone, "1 worker": on_workers(first), "2 workers": on_workers(second)}
        error = None
        for way in ways.values():
            error, *_ = [way(scene, paths=paths // 8)[0].error]  # libraries are loaded now
        for limits in ({"paths": paths}, {"error": error / 2}):
            rates = {name: [] for name in ways}
            for _ in range(repetitions):
                for name, way in ways.items():
                    result, workers_s, client_s = way(scene, **limits)
                    rates[name].append((result.paths / workers_s, result.paths / (workers_s + client_s), result.paths))
            base = statistics.median(rate for rate, *_ in rates["one process"])
            print(", ".join(f"{key}={value:.4g}" for key, value in limits.items()))
            for name, own in rates.items():
                rate, with_client = (statistics.median(column) for column in list(zip(*own))[:2])
                print(f"  {name:12} {own[0][2]:9} paths, {rate:9.0f} a second of the workers: {rate / base:.3f} of one process; "
                      f"with the client {with_client / base:.3f}")


if __name__ == "__main__":
    main()
