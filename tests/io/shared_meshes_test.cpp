// Copies of a mesh file: of their own, or instances that share it, from the number of triangles on that this
// saves (scene/instances.cpp, kSaved 100,000). The light is the same.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "io/scene_text.h"
#include "run/run.h"
#include "scene/instances.h"
#include "statistics/interval.h"
#include "support/test_folder.h"

namespace stilb::io {
namespace {

TEST(SharedMeshes, AreInstancesWhereThatSavesEnough) {
    EXPECT_FALSE(scene::are_instances(10'000'000, 1));
    for (const std::size_t uses : {2, 3, 101}) {
        const std::size_t enough = 100'000 / (uses - 1);
        EXPECT_FALSE(scene::are_instances(enough - 1, uses)) << uses;
        EXPECT_TRUE(scene::are_instances(enough, uses)) << uses;
        EXPECT_TRUE(scene::are_instances(enough + 1, uses)) << uses;
    }
}

/// A plate of 0.4 m x 0.2 m that is cut into so many triangles.
void write_plate(const std::filesystem::path& file, std::size_t triangles) {
    std::ofstream out(file);
    for (std::size_t i = 0; i < triangles + 2; ++i) {
        const double end = static_cast<double>(triangles + 1);
        // The corners of a strip of triangles; the first and the last two lie on its ends.
        const double along = i < 2 ? 0 : (i + 2 > triangles + 1 ? 0.4 : 0.4 * static_cast<double>(i) / end);
        out << "v " << along << ' ' << 0.2 * static_cast<double>(i % 2) << " 0\n";
    }
    for (std::size_t t = 1; t <= triangles; ++t) {
        if (t % 2 == 1)
            out << "f " << t << ' ' << t + 2 << ' ' << t + 1 << '\n';
        else
            out << "f " << t << ' ' << t + 1 << ' ' << t + 2 << '\n';
    }
}

TEST(SharedMeshes, GiveTheSameLightAsCopies) {
    const TestFolder directory;
    std::string text =
        "[materials.wall]\ntype = \"diffuse\"\nreflectance = 0.5\n"
        "[objects.room]\nshape = \"box\"\nmin = [0, 0, 0]\nmax = [5, 3, 2.5]\nmaterial = \"wall\"\n"
        "[lights.bulb]\ntype = \"point\"\nposition = [2.5, 1.5, 2.2]\nflux = 1000\n"
        "[sensors.floor]\ntype = \"grid\"\ncorner = [0.5, 0.5, 0]\nedge_u = [4, 0, 0]\nedge_v = [0, 2, 0]\n"
        "count = [4, 2]\n";
    for (int i = 0; i < 101; ++i) {
        text += fmt::format(
            "[objects.plate_{}]\nshape = \"mesh\"\nfile = \"plate.obj\"\nmaterial = \"wall\"\n"
            "translate = [{}, {}, {}]\n",
            i, 0.1 + 0.45 * (i % 10), 0.1 + 0.25 * (i / 10), 0.7 + 0.01 * (i % 7));
    }
    std::vector<std::vector<statistics::Estimate>> found;
    for (const std::size_t triangles : {999, 1000, 1001}) {
        write_plate(directory / "plate.obj", triangles);
        const SceneFile file = read_scene_text(text, directory);
        ASSERT_EQ(file.scene.objects.size(), 102u);
        EXPECT_EQ(std::holds_alternative<Instance>(file.scene.objects[1].shape), triangles >= 1000);
        run::RunOptions options;
        options.method = "path";
        options.paths = 32768;
        auto& values = found.emplace_back();
        const run::RunResult result = run::measure(file.scene, file.sensors, options);
        for (const run::Reading& reading : result.sensors[0].readings) values.push_back(reading.estimate);
    }
    for (const auto& other : {found[1], found[2]}) {
        for (std::size_t i = 0; i < other.size(); ++i) {
            EXPECT_NEAR(other[i].value, found[0][i].value,
                        5 * std::hypot(other[i].standard_error, found[0][i].standard_error))
                << i;
            EXPECT_LT(other[i].standard_error, 0.02 * other[i].value) << i;
        }
    }
}

}  // namespace
}  // namespace stilb::io
