// Every solution that is written can be read again, and shows its light: over random scenes. A room of a few
// large walls, which all other tests of solutions have, does not show what a vertex does that hardly any
// light reaches.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "io/results/solution_file.h"
#include "materials/black.h"
#include "materials/diffuse.h"
#include "materials/mirror.h"
#include "materials/phong.h"
#include "materials/plastic.h"
#include "materials/rough_conductor.h"
#include "materials/thin_dielectric.h"
#include "materials/ward.h"
#include "math/random.h"
#include "run/run.h"
#include "run/solve.h"
#include "stilb/error.h"
#include "support/coarser.h"
#include "support/scene_builder.h"

namespace stilb::io {
namespace {

/// Draws scenes of things that touch: boxes on the floor and on each other, open sheets, rooms of separate
/// walls, one in another, from millimetres to kilometres, at the origin and at map coordinates.
class RandomScene {
  public:
    explicit RandomScene(std::uint64_t seed) : stream_(math::RandomKey{seed}, 0) {
        size_m_ = std::pow(10., between(-2, 3));
        if (is_chosen(0.25)) origin_m_ = {512'345.6, 5'212'345.6, 87.6};
        scene_.name = "seed " + std::to_string(seed);
        add_room();
        const int things = whole(8);
        for (int i = 0; i < things; ++i) add_thing();
        add_lamps();
    }

    const Scene& scene() const { return scene_; }
    double size_m() const { return size_m_; }
    Vec3 place(double x, double y, double z) const { return origin_m_ + size_m_ * Vec3{x, y, z}; }
    int whole(int below) { return static_cast<int>(stream_.next() * below); }

  private:
    double between(double low, double high) { return low + (high - low) * stream_.next(); }
    bool is_chosen(double probability) { return stream_.next() < probability; }
    Vec3 scaled(double x, double y, double z) const { return size_m_ * Vec3{x, y, z}; }
    Rgb colour() { return {{between(0, 0.9), between(0, 0.9), between(0, 0.9)}}; }

    Material material() {
        switch (whole(10)) {
            case 0:
                return Phong{0.5 * colour(), 0.5 * colour(), std::pow(10., between(0, 3))};
            case 1:
                return Plastic({colour(), between(1.1, 2), between(0.05, 1)});
            case 2:
                return RoughConductor({colour(), between(0.05, 1)});
            case 3:
                return Ward({0.5 * colour(), 0.5 * colour(), {0.3, 0.3}});  // others take a second each
            case 4:
                return Mirror{colour()};
            case 5:
                return ThinDielectric{1.5, colour()};
            case 6:
                return Black{};
            default:
                return Diffuse{colour()};
        }
    }

    void add_room() {
        const Vec3 low = place(0, 0, 0), high = place(1, 0.7, 0.5);
        const int kind = whole(4);
        if (kind == 0) add_object(scene_, Box{low, high}, material());
        if (kind == 1) {
            for (std::size_t i = 0; i < 6; ++i)
                add_object(scene_, wall({low, high}, i / 2, i % 2 == 0 ? Side::low : Side::high), material());
        }
        if (kind == 2) {  // walls are boxes that touch
            for (const double x : {-0.05, 1.})
                add_object(scene_, Box{place(x, -0.05, 0), place(x + 0.05, 0.75, 0.5)}, material());
            for (const double y : {-0.05, 0.7})
                add_object(scene_, Box{place(0, y, 0), place(1, y + 0.05, 0.5)}, material());
            for (const double z : {-0.05, 0.5})
                add_object(scene_, Box{place(-0.05, -0.05, z), place(1.05, 0.75, z + 0.05)}, material());
        }
        if (kind == 3) add_object(scene_, Rectangle{low, scaled(1, 0, 0), scaled(0, 0.7, 0)}, material());
        if (is_chosen(0.2))  // a room in the room
            add_object(scene_, Box{place(0.2, 0.2, 0), place(0.8, 0.5, 0.45)}, material());
    }

    /// On the floor or on a table of 0.2, larger or smaller than it.
    void add_thing() {
        const double x = between(0.1, 0.7), y = between(0.1, 0.5), wide = between(0.02, 0.25);
        const double floor = is_chosen(0.5) ? 0.2 : 0;
        switch (whole(5)) {
            case 0:
                add_object(scene_, Sphere{place(x, y, floor + wide / 4), size_m_ * wide / 4}, material());
                break;
            case 1:
                add_object(scene_, Rectangle{place(x, y, floor), scaled(wide, 0, 0), scaled(0, wide, 0)},
                           material());
                break;
            case 2: {  // a strip and a point among its triangles
                Mesh mesh;
                mesh.vertices = {place(x, y, floor), place(x + wide, y, floor + 0.1),
                                 place(x + wide, y + 1e-6, floor + 0.1), place(x, y + wide, floor)};
                mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {1, 1, 2}};
                add_object(scene_, std::move(mesh), material());
                break;
            }
            default:
                add_object(scene_,
                           Box{place(x, y, floor), place(x + wide, y + between(0.02, 0.15), floor + 0.2)},
                           material());
        }
    }

    void add_lamps() {
        const double per_m2 = std::pow(10., between(-6, 2));
        const int kinds = is_chosen(0.5) ? 4 : 3;
        const int lamps = 1 + (is_chosen(0.1) ? 32 + whole(4) : whole(5));
        for (int i = 0; i < lamps; ++i) {
            const double x = between(0.1, 0.9), y = between(0.1, 0.6);
            const int kind = i == 0 ? whole(kinds) : whole(3);
            if (kind == 0) add_point_light(scene_, place(x, y, 0.45), size_m_ * size_m_ * per_m2 * colour());
            if (kind == 1) {
                add_area_light(scene_, Rectangle{place(x, y, 0.48), scaled(0, 0.05, 0), scaled(0.05, 0, 0)},
                               10 * per_m2 * colour(), material());
            }
            if (kind == 2) {
                add_area_light(scene_, Sphere{place(x, y, 0.4), 0.02 * size_m_}, 10 * per_m2 * colour());
            }
            if (kind == 3) add_environment(scene_, per_m2 * colour());
            if (is_chosen(0.3)) scene_.lights.back().group = "group " + std::to_string(whole(3));
        }
    }

    math::SampleStream stream_;
    Scene scene_;
    double size_m_ = 1;
    Vec3 origin_m_;
};

void expect_readable(std::uint64_t seed) {
    RandomScene random(seed);
    const Scene& scene = random.scene();
    RunOptions options;
    options.method = "ray-bundle";
    options.seed = seed;
    options.paths = 16 + 8 * static_cast<std::uint64_t>(random.whole(12));
    options.patch_m = random.size_m() * (0.4 + 0.1 * random.whole(8));
    const bool has_points = std::ranges::any_of(
        scene.lights, [](const Light& light) { return location_of(light) == LightLocation::point; });
    if (!has_points && random.whole(2) == 0)
        options.patches.first_shot.variant = estimators::FirstShotVariant::none;
    const SolveResult solved = solve(scene, options, random.whole(9));
    const StoredSolution written{"0.1.0",        "room.toml",           "0123456789abcdef", seed,
                                 solved.samples, solved.attained_error, solved.solution};
    const std::string bytes = to_bytes(written);
    const StoredSolution read = read_solution(bytes, "a.solution");
    EXPECT_EQ(to_bytes(read), bytes);
    require_consistency(read.solution, scene);
    const Camera camera{random.place(0.05, 0.1, 0.3), random.place(0.6, 0.4, 0.2), {0, 0, 1}, 70, {6, 4},
                        Projection::perspective};
    const RenderResult picture = run::render_solution(scene, {"camera", camera}, read.solution);
    EXPECT_TRUE(std::isfinite(picture.mean_luminance_cd_m2));
}

TEST(ReadableSolutions, OfRandomScenes) {
    const auto scenes = static_cast<std::uint64_t>(24 / coarser(3));
    for (std::uint64_t seed = 1; seed <= scenes; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        EXPECT_NO_THROW(expect_readable(seed));
    }
}

/// What solve accepts, the reader accepts: just below and just above the size that a file can have.
TEST(ReadableSolutions, LargerThanTheirFilesAreRefusedBeforeTheyAreComputed) {
    // 12 bytes for each number of the light, 2 for its exponent, 1 MiB for the rest.
    const std::size_t most_terms = (estimators::kMostStoredBytes - (1 << 20)) / (2 + 12 * 32);
    EXPECT_NO_THROW(estimators::require_storable({.terms = most_terms, .groups = 32}));
    EXPECT_THROW(estimators::require_storable({.terms = most_terms + 1, .groups = 32}), InputError);
    EXPECT_THROW(estimators::require_storable({.patches = 70'000'000}), InputError);
}

}  // namespace
}  // namespace stilb::io
