"""Runs on a cluster of Dask, of which a worker is lost."""

import logging
import os
import signal
import subprocess
import sys
import unittest
import unittest.mock
import warnings

import distributed
import numpy as np
import stilb
from room import built

logging.getLogger("distributed").setLevel(logging.CRITICAL)  # it speaks of the worker that this kills


class Clusters(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.cluster = distributed.LocalCluster(n_workers=3, threads_per_worker=1, processes=True, dashboard_address=None,
                                               silence_logs=logging.CRITICAL)
        cls.addClassCleanup(cls.cluster.close)
        cls.client = distributed.Client(cls.cluster)
        cls.addClassCleanup(cls.client.close)

    def same(self, a, b):
        """Their intervals may differ: those of runs that stopped by their error are a little wider."""
        self.assertEqual((list(a), a.paths, a.technique), (list(b), b.paths, b.technique))
        for name in a:
            np.testing.assert_array_equal(a[name].value, b[name].value)
            np.testing.assert_array_equal(a[name].replicates, b[name].replicates)
            np.testing.assert_array_equal(a[name].standard_error, b[name].standard_error)

    def setUp(self):
        caught = warnings.catch_warnings()
        caught.__enter__()
        self.addCleanup(caught.__exit__, None, None, None)
        warnings.simplefilter("ignore", stilb.ResultWarning)

    def measured(self, scene, **limits):
        return stilb.distributed.measure(scene, self.client, **limits)

    def test_paths_give_the_bits_of_one_process(self):
        scene = built()
        for limits in ({"method": "path"}, {"sensors": ["desk"], "seed": 3}, {"parts": 40, "by": "light"}):
            with self.subTest(**limits):
                own = {key: value for key, value in limits.items() if key != "parts"}
                result = self.measured(scene, paths=8192, **limits)
                self.same(result, scene.measure(paths=8192, **own))
                self.assertEqual(result.stopped, "paths done")
        self.assertEqual(list(result.shares), ["bulb"])

    def test_large_grids_have_the_bits_of_one_process(self):
        scene = built()
        scene.sensors["desk"].count = (16, 8)
        self.same(self.measured(scene, paths=65536, sensors="desk"), scene.measure(paths=65536, sensors="desk"))

    def test_a_lost_worker_is_made_up_for(self):
        scene = built()
        pids = self.client.run(os.getpid)
        lost = []

        def lose_one(result):
            busy = [address for address, tasks in self.client.processing().items() if tasks]
            if busy and not lost:
                lost.append(busy[0])
                os.kill(pids[busy[0]], signal.SIGKILL)

        result = self.measured(scene, error=0.006, method="path", parts=6, progress=lose_one)
        self.assertEqual(len(lost), 1, "no part was running")
        self.assertNotIn(pids[lost[0]], self.client.run(os.getpid).values())
        self.assertEqual((result.converged, result.stopped), (True, "target reached"))
        self.assertLessEqual(result.error, 0.006)
        self.same(result, scene.measure(paths=result.paths, method="path"))

    def test_the_function_of_progress_ends_the_run(self):
        with self.assertWarnsRegex(stilb.ResultWarning, "The requested error of 0.01 % is not reached"):
            result = self.measured(built(), error=1e-4, method="path", progress=lambda result: False)
        self.assertGreater(result.error, 1e-4)

    def test_wrong_arguments_are_refused(self):
        with self.assertRaisesRegex(stilb.InputError, "error or paths"):
            self.measured(built(), time=3)
        with self.assertRaisesRegex(stilb.InputError, "parts: 0 is not allowed"):
            self.measured(built(), paths=64, parts=0)
        with self.assertRaisesRegex(stilb.InputError, "ray-bundle|method"):
            self.measured(built(), paths=64, method="magic")
        for scene, client, progress, message in [(built(), "tcp://scheduler:8786", None, "client: found a value of type str. Allowed: a dist"),
                                                 ("room.toml", self.client, None, "scene: found a value of type str"),
                                                 (built(), self.client, True, "progress: found a value of type bool. Allowed: a function")]:
            with self.assertRaisesRegex(stilb.InputError, message):
                stilb.distributed.measure(scene, client, paths=64, progress=progress)

    def test_errors_of_workers_arrive(self):
        scene = built()
        scene.sensors["task"] = stilb.Goniometer(point=(2, 1.5, 1.2), normal=(0, 0, 1), plane=0, step=30)
        with self.assertRaisesRegex(stilb.InputError, "its point .* is not on a surface"):
            self.measured(scene, paths=64)


class Ended(unittest.TestCase):
    def test_a_round_that_is_cancelled_leaves_no_message(self):
        """Not even where the cluster is closed while its parts are still worked on."""
        made = subprocess.run([sys.executable, "-B", "-c", CLOSED_EARLY], capture_output=True, text=True, check=False,
                              cwd=os.path.dirname(__file__))
        self.assertEqual((made.returncode, made.stderr), (0, ""))
        self.assertIn("working", made.stdout)


CLOSED_EARLY = """
import distributed
import stilb
from room import built

scene = built()
scene.sensors["desk"].count = (16, 16)
with distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=False, dashboard_address=None) as cluster:
    with distributed.Client(cluster) as client:
        stilb.distributed.measure(scene, client, error=0.2, method="path", sensors="desk")
        print("working" if any(client.processing().values()) else "idle")
"""


class WithoutDask(unittest.TestCase):
    def test_a_missing_package_is_named(self):
        with unittest.mock.patch.dict(sys.modules, {"distributed": None}):
            with self.assertRaisesRegex(ImportError, r'needs the package distributed: pip install "stilb\[distributed\]"'):
                stilb.distributed.measure(built(), None, paths=64)


if __name__ == "__main__":
    unittest.main()
