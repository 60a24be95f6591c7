"""The rooms of many_rooms.py on a cluster of Dask; and the worst of them once more, by all workers together.

    python many_rooms_dask.py --rooms 500 --scheduler tcp://scheduler:8786

Without a scheduler, a cluster of two processes on this machine does the work. Needs pip install "stilb[distributed]".
"""

import argparse
import contextlib
from pathlib import Path

import distributed

import stilb
from many_rooms import measured, room, table


@contextlib.contextmanager
def client_of(scheduler: str | None):
    if scheduler:
        with distributed.Client(scheduler) as client:
            client.upload_file(Path(__file__).with_name("many_rooms.py"))  # workers need the module of the function
            yield client
    else:
        with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
            with distributed.Client(cluster) as client:
                yield client


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rooms", type=int, default=12)
    parser.add_argument("--scheduler", help="the address of a cluster's scheduler (default: a cluster on this machine)")
    parser.add_argument("--error", default="2%", help="the relative half-width of the 95 %% intervals (2%%)")
    parser.add_argument("--small-error", default="1%", help="that of the room with the least light (1%%)")
    arguments = parser.parse_args()

    scenes = [room(number) for number in range(arguments.rooms)]
    with client_of(arguments.scheduler) as client:
        results = client.gather(client.map(measured, scenes, error=arguments.error))
        print(table(scenes, results).to_string(index=False))
        darkest = min(range(len(scenes)), key=lambda number: results[number]["task"].mean.value)
        result = stilb.distributed.measure(scenes[darkest], client, error=arguments.small_error)
        print(f"The least light is in {scenes[darkest].name}: {result['task'].mean}, by {result.paths} paths of all workers.")


if __name__ == "__main__":
    main()
