"""scripts/check-includes: that it finds planted violations, and that this project has none."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
SCRIPT = PROJECT / "scripts" / "check-includes"


def check(root):
    return subprocess.run([sys.executable, str(SCRIPT), str(root)], capture_output=True, text=True, check=False)


class CheckIncludes(unittest.TestCase):
    def check_file(self, path, text):
        with tempfile.TemporaryDirectory() as root:
            base = "experiments" if path.startswith("papers/") else "src"
            file = Path(root) / base / path
            file.parent.mkdir(parents=True)
            file.write_text(text, encoding="utf-8")
            return check(root)

    def assert_accepted(self, path, text):
        result = self.check_file(path, text)
        self.assertEqual((result.returncode, result.stdout), (0, ""))

    def assert_rejected(self, path, text, message):
        result = self.check_file(path, text)
        self.assertEqual(result.returncode, 1, result.stdout)
        self.assertIn(message, result.stdout)

    def test_this_project_has_no_violation(self):
        result = check(PROJECT)
        self.assertEqual((result.returncode, result.stdout), (0, ""))

    def test_lower_folders_and_standard_headers_are_allowed(self):
        self.assert_accepted("run/run.cpp", '#include "scene/scene.h"\n#include <vector>\n#include "statistics/interval.h"\n')
        self.assert_accepted("cli/verify.cpp", '#include "exact/sphere.h"\n#include "io/scene/scene_file.h"\n')
        self.assert_accepted("papers/figure.cpp", '#include "plot/plot.h"\n#include "cli/progress.h"\n')

    def test_higher_folders_are_not(self):
        self.assert_rejected("scene/scene.h", '#pragma once\n\n#include "sensors/sensor.h"\n',
                             "src/scene/scene.h:3: includes sensors/sensor.h: scene must not see sensors")
        self.assert_rejected("estimators/path/path.cpp", '#include "run/options.h"\n', "estimators must not see run")
        self.assert_rejected("cli/measure.cpp", '#include "papers/reproduce.h"\n', "cli must not see papers")
        self.assert_accepted("cli/main.cpp", '#include "papers/reproduce.h"\n')  # where all commands come together

    def test_folders_side_by_side_do_not_see_each_other(self):
        self.assert_accepted("estimators/path/path.cpp", '#include "patches/patches.h"\n#include "sensors/sensor.h"\n')
        self.assert_rejected("sensors/sensor.h", '#include "patches/patches.h"\n', "sensors must not see patches")
        self.assert_rejected("patches/patches.h", '#include "sensors/sensor.h"\n', "patches must not see sensors")
        self.assert_rejected("geometry/shape.h", '#include "materials/material.h"\n', "geometry must not see materials")
        self.assert_rejected("fit/mesh_fit.h", '#include "patches/patches.h"\n', "fit must not see patches")

    def test_a_method_does_not_see_its_siblings(self):
        self.assert_rejected("estimators/path/path.cpp", '#include "estimators/local/gather.h"\n',
                             "a method never includes a sibling")
        self.assert_rejected("estimators/patch_light/radiosity/radiosity.cpp",
                             '#include "estimators/patch_light/ray_bundle/ray_bundle.h"\n', "never includes a sibling")
        self.assert_accepted("estimators/path/path.cpp", '#include "estimators/estimator.h"\n')
        self.assert_accepted("estimators/patch_light/radiosity/radiosity.cpp",
                             '#include "estimators/patch_light/patch_transport.h"\n')

    def test_the_side_folders_see_only_base(self):
        self.assert_rejected("exact/sphere.cpp", '#include "scene/scene.h"\n', "exact must not see scene")
        self.assert_rejected("statistics/interval.h", '  # include "exact/sphere.h"\n', "statistics must not see exact")
        self.assert_rejected("base/vec.h", '#include "statistics/interval.h"\n', "base must not see statistics")
        self.assert_rejected("transport/light_path.cpp", '#include "statistics/interval.h"\n', "must not see statistics")
        self.assert_accepted("estimators/auto.cpp", '#include "statistics/interval.h"\n')

    def test_libraries_stay_behind_their_files(self):
        homes = {
            "embree3/rtcore.h": ("rays/ray_caster.cpp", "scene/scene.cpp"),
            "toml++/toml.h": ("io/scene/scene_file.cpp", "scene/scene.cpp"),
            "epoxy/gl.h": ("patches/visibility/opengl_item_buffers.cpp", "patches/patches.cpp"),
            "cairo-svg.h": ("plot/canvas.cpp", "plot/plot.cpp"),
            "CLI/CLI.hpp": ("cli/command_line.cpp", "cli/commands/measure.cpp"),
            "nlohmann/json.hpp": ("io/results/results_json.cpp", "estimators/path/path.cpp"),
            "tbb/parallel_for.h": ("base/parallel.cpp", "rays/ray_caster.cpp"),
            "boost/math/distributions/normal.hpp": ("statistics/interval.cpp", "scene/scene.cpp"),
            "Random123/philox.h": ("math/random.cpp", "estimators/path.cpp"),
        }
        for header, (home, elsewhere) in homes.items():
            with self.subTest(header=header):
                self.assert_accepted(home, f"#include <{header}>\n")
                self.assert_rejected(elsewhere, f"#include <{header}>\n", "may include it")

    def test_unknown_libraries_and_folders_are_named(self):
        self.assert_rejected("base/vec.h", "#include <Eigen/Dense>\n", "unknown library")
        self.assert_rejected("base/vec.h", "#include <netdb.h>\n", "unknown library")
        self.assert_rejected("base/vec.h", "#include <sys/random.h>\n", "only src/cli/* and src/walk/service/server.cpp may include it")
        self.assert_rejected("misc/helpers.h", "#pragma once\n", "in no folder of the architecture")
        self.assert_rejected("base/vec.h", '#include "../scene/scene.h"\n', "not a path from src/")
        self.assert_rejected("base/vec.h", '#include "units.h"\n', "not a path from src/")

    def test_an_empty_tree_does_not_pass(self):
        with tempfile.TemporaryDirectory() as root:
            self.assertEqual(check(root).returncode, 2)


if __name__ == "__main__":
    unittest.main()
