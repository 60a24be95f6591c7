// Bundles of parallel rays, by each way of casting them: what lines go through, and that transfer along them
// is the transfer of light.
#include "patches/visibility/bundle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <future>
#include <memory>
#include <numeric>
#include <optional>
#include <vector>

#include "math/sampling.h"
#include "patches/backends.h"
#include "patches/rooms.h"
#include "stilb/error.h"
#include "support/random_pairs.h"

namespace stilb::patches {
namespace {

/// Of what comes out of each of many independent bundles.
struct Moments {
    double count = 0, sum = 0, squares = 0;

    void add(double value) { count += 1, sum += value, squares += value * value; }
    double mean() const { return sum / count; }
    double variance() const { return std::max(squares / count - mean() * mean(), 0.0); }
    double standard_error() const { return std::sqrt(variance() / (count - 1)); }
    double z_score(double expected) const { return (mean() - expected) / standard_error(); }
};

/// No whole number that is `mean` on average varies less.
double least_variance(double mean) {
    const double part = mean - std::floor(mean);
    return part * (1 - part);
}

class BundlesOf : public testing::TestWithParam<BufferBackend> {
  protected:
    void SetUp() override {
        if (GetParam() == BufferBackend::rays) return;
        if (const auto why_not = missing_opengl()) GTEST_SKIP() << *why_not;
    }
    void look_at(const Scene& scene, double patch_size_m) {
        patches_ = make_patches(scene, patch_size_m);
        caster_.emplace(patches_);
        bundles_ = make_bundles(GetParam(), *caster_);
    }

    /// A direction uniform over the sphere, the axes of the grid turned about it, and an offset.
    Bundle random_bundle(double spacing_m) {
        const auto [u1, u2] = random_.next_pair();
        const Frame around = Frame::around(math::sample_sphere(u1, u2).direction);
        const double angle = 2 * kPi * random_.next();
        const Vec3 u = std::cos(angle) * around.u + std::sin(angle) * around.v;
        return {{u, cross(around.w, u), around.w}, spacing_m, {random_.next(), random_.next()}};
    }

    template <typename Visitor>
    void for_each_line(const Bundle& bundle, const Visitor& visit) {
        bundles_->cast(bundle, [&](const CrossedLines& lines) {
            for (std::size_t i = 0; i < lines.count(); ++i) visit(lines.line(i));
        });
    }

    /// At outlines, where a line enters and leaves at once, rounding decides on what comes first. OpenGL
    /// rounds to 1/256 of the spacing.
    double most_turned_around() const { return GetParam() == BufferBackend::rays ? 1e-5 : 2e-4; }

    Patches patches_;
    std::optional<PatchCaster> caster_;
    std::unique_ptr<Bundles> bundles_;
    RandomPairs random_{5};
};

TEST_P(BundlesOf, AConvexRoomCrossItTwice) {
    look_at(empty_room(), 0.3);
    double lines = 0, turned_around = 0;
    for (int i = 0; i < 20; ++i) {
        for_each_line(random_bundle(0.04), [&](const CrossedLine& line) {
            ++lines;
            ASSERT_EQ(line.sides.size(), 2u);
            EXPECT_NE(patches_.is_front(line.sides[0]), patches_.is_front(line.sides[1]));
            EXPECT_LE(line.distances_m[0], line.distances_m[1]);
            if (patches_.is_front(line.sides[0])) ++turned_around;
        });
    }
    EXPECT_GT(lines, 100'000);
    EXPECT_LT(turned_around, most_turned_around() * lines);
}

/// Lines exactly on edges and corners of patches, straight and at a slant: neighbours in a plane do not see
/// each other.
TEST_P(BundlesOf, AWallCrossItOnceWherePatchesMeet) {
    Scene scene;
    add_object(scene, inward({{-2, -2, -2}, {2, 2, 2}}), diffuse(0.5));
    look_at(scene, 0.8);  // vertices at multiples of half a metre
    for (const double angle : {0.0, 0.5, 1.5}) {
        const Vec3 x{1, 0, 0}, w{0, std::sin(angle), std::cos(angle)};
        std::size_t lines = 0;
        for_each_line({{x, cross(w, x), w}, 0.125, {0, 0}}, [&](const CrossedLine& line) {
            const bool is_on_outline = line.origin.x == -2 || lines < 32;
            ++lines;
            if (is_on_outline) return;
            EXPECT_EQ(line.sides.size(), 2u) << line.origin.x << ' ' << line.origin.y;
        });
        EXPECT_GE(lines, 1024u);
    }
}

/// One after another of what is inside of something else, in and out.
TEST_P(BundlesOf, NestedBoxesCrossAsManyOnBothWays) {
    Scene scene;
    constexpr int boxes = 5;
    for (int i = 1; i <= boxes; ++i) {
        const Vec3 half = (0.3 + 0.1 * i) * Vec3{1, 1.5, 0.7};
        add_object(scene, Box{-half, half}, diffuse(0.5));
    }
    look_at(scene, 0.2);
    std::size_t deepest = 0;
    double lines = 0, turned_around = 0;
    for (int i = 0; i < 20; ++i) {
        for_each_line(random_bundle(0.02), [&](const CrossedLine& line) {
            ++lines;
            const std::size_t n = line.sides.size();
            deepest = std::max(deepest, n);
            ASSERT_EQ(n % 2, 0u);
            const auto is_front = [&](std::uint32_t side) { return patches_.is_front(side); };
            EXPECT_EQ(std::ranges::count_if(line.sides, is_front), n / 2);
            if (!std::ranges::is_partitioned(line.sides, is_front)) ++turned_around;
            EXPECT_TRUE(std::ranges::is_sorted(line.distances_m));
        });
    }
    EXPECT_EQ(deepest, 2u * boxes);
    EXPECT_LT(turned_around, most_turned_around() * lines);
}

/// Sheets and a board that is thinner than the sheets' gap, a few hundredths of a millimetre in a room of 5
/// m.
TEST_P(BundlesOf, ThinThingsSeeWhatIsOnTheirSide) {
    Scene scene = empty_room();
    constexpr double z = 1.2, gap = 4e-5;
    add_object(scene, Rectangle{{1, 1, z}, {3, 0, 0}, {0, 2, 0}}, diffuse(0.5));
    add_object(scene, Rectangle{{1, 1, z + gap}, {3, 0, 0}, {0, 2, 0}}, diffuse(0.5));
    add_object(scene, Box{{1, 1, 2}, {4, 3, 2 + gap / 2}}, diffuse(0.5));
    look_at(scene, 0.5);
    const auto object = [&](std::uint32_t side) {
        return index_of(patches_.object_of(patches_.patch_of(side)));
    };
    const std::vector<std::uint32_t> upwards{0, 1, 2, 3, 3, 0};
    std::size_t through_all = 0;
    for (const double tilt : {0.0, 0.1}) {
        const Vec3 x{1, 0, 0}, w{0, std::sin(tilt), std::cos(tilt)};
        for_each_line({{x, cross(w, x), w}, 0.03, {0.3, 0.7}}, [&](const CrossedLine& line) {
            if (line.sides.size() <= 4) return;
            std::vector<std::uint32_t> met;
            for (const std::uint32_t side : line.sides) met.push_back(object(side));
            EXPECT_EQ(met, upwards);
            ++through_all;
        });
    }
    EXPECT_GT(through_all, 10'000u);
}

/// Where a line says that it meets a patch, the patch is.
TEST_P(BundlesOf, AFurnishedRoomMeetPatchesWhereTheyAre) {
    look_at(furnished_room(), 0.2);
    for (int i = 0; i < 4; ++i) {
        const Bundle bundle = random_bundle(0.05);
        for_each_line(bundle, [&](const CrossedLine& line) {
            for (std::size_t k = 0; k < line.sides.size(); ++k) {
                const Vec3 place = line.origin + line.distances_m[k] * bundle.frame.w;
                const Vec3 from_middle = place - patches_.middle(patches_.patch_of(line.sides[k]));
                const Vec3 normal = patches_.normal_of(line.sides[k]);
                EXPECT_LT(dot(normal, bundle.frame.w), 0);
                EXPECT_LT(std::abs(dot(from_middle, normal)), bundle.spacing_m / 256);
                EXPECT_LT(length(from_middle), 0.2);
            }
        });
    }
}

/// Patches are crossed by as many lines as cover their projection, on average over all offsets of the grid.
TEST_P(BundlesOf, AFurnishedRoomCrossPatchesByTheirProjectedArea) {
    look_at(furnished_room(), 0.6);
    Bundle bundle = random_bundle(0.1);
    const int offsets = GetParam() == BufferBackend::rays ? 400 : 100;
    std::vector<Moments> crossings(patches_.count());
    for (int i = 0; i < offsets; ++i) {
        bundle.offset = {random_.next(), random_.next()};
        std::vector<double> of_patch(patches_.count());
        for_each_line(bundle, [&](const CrossedLine& line) {
            for (const std::uint32_t side : line.sides) of_patch[patches_.patch_of(side)] += 1;
        });
        for (std::size_t p = 0; p < patches_.count(); ++p) crossings[p].add(of_patch[p]);
    }
    Moments squared_z;
    for (std::uint32_t p = 0; p < patches_.count(); ++p) {
        const double cosine = std::abs(dot(patches_.normal_of(p), bundle.frame.w));
        const double expected = patches_.areas_m2[p] * cosine / (bundle.spacing_m * bundle.spacing_m);
        constexpr int seldom = 10;
        if (expected * offsets < seldom) continue;
        const double variance = std::max(crossings[p].variance(), least_variance(expected));
        const double z = (crossings[p].mean() - expected) / std::sqrt(variance / offsets);
        EXPECT_LT(std::abs(z), 5) << p;
        squared_z.add(z * z);
    }
    EXPECT_GT(squared_z.count, 0.9 * static_cast<double>(patches_.count()));
    EXPECT_NEAR(squared_z.mean(), 1, 4 * squared_z.standard_error());
}

/// A cube's faces: opposite ones see each other with 0.1998, neighbours with 0.2000 (closed forms in
/// [Siegel, Howell, Thermal radiation heat transfer, C-11 and C-14]).
TEST_P(BundlesOf, ACubeHaveItsFormFactors) {
    Scene scene;
    for (std::size_t i = 0; i < 6; ++i) {
        const auto side = i % 2 == 0 ? Side::low : Side::high;
        add_object(scene, wall({{0, 0, 0}, {1, 1, 1}}, i / 2, side), diffuse(0.5));
    }
    look_at(scene, 0.6);
    const auto face = [&](std::uint32_t side) {
        return index_of(patches_.object_of(patches_.patch_of(side)));
    };
    const int directions = GetParam() == BufferBackend::rays ? 20'000 : 1'000;
    Moments opposite, adjacent;
    double pairs = 0, outside = 0;
    for (int i = 0; i < directions; ++i) {
        const Bundle bundle = random_bundle(0.06);
        double opposite_m2 = 0, adjacent_m2 = 0;
        bundles_->cast(bundle, [&](const CrossedLines& lines) {
            for_each_pair(patches_, lines, [&](std::uint32_t sender, std::uint32_t receiver) {
                ++pairs;
                if (!patches_.is_front(sender) || !patches_.is_front(receiver)) ++outside;
                (face(sender) / 2 == face(receiver) / 2 ? opposite_m2 : adjacent_m2) +=
                    bundle.spacing_m * bundle.spacing_m;
            });
        });
        // 6 ordered pairs of opposite faces and 24 of neighbours, of 1 m2 each.
        opposite.add(4 * opposite_m2 / 6);
        adjacent.add(4 * adjacent_m2 / 24);
    }
    constexpr double opposite_exact = 0.19982489569838746;
    EXPECT_LT(std::abs(opposite.z_score(opposite_exact)), 4) << opposite.mean();
    EXPECT_LT(std::abs(adjacent.z_score((1 - opposite_exact) / 4)), 4) << adjacent.mean();
    EXPECT_LT(opposite.standard_error() / opposite.mean(), 0.04);
    EXPECT_LT(outside, most_turned_around() * pairs);
}

/// Under a sky of luminance 1 everywhere, each surface has the illuminance pi: J = sum L dA / A_j is a
/// quarter on average over directions, of 4 pi.
TEST_P(BundlesOf, AClosedSceneLightEverySurfaceAlike) {
    look_at(room_without_overlaps(), 0.3);
    const std::size_t objects = patches_.first_of_object.size() - 1;
    std::vector<double> areas_m2(objects);
    for (std::uint32_t p = 0; p < patches_.count(); ++p)
        areas_m2[index_of(patches_.object_of(p))] += patches_.areas_m2[p];
    std::vector<std::array<Moments, 2>> illuminance_lx(objects);
    const int directions = GetParam() == BufferBackend::rays ? 500 : 100;
    for (int i = 0; i < directions; ++i) {
        const Bundle bundle = random_bundle(0.08);
        std::vector<std::array<double, 2>> received(objects);  // by fronts and backs
        const auto receive = [&](std::uint32_t side) {
            const std::uint32_t object = index_of(patches_.object_of(patches_.patch_of(side)));
            received[object][patches_.is_front(side) ? 0 : 1] +=
                bundle.spacing_m * bundle.spacing_m / areas_m2[object];
        };
        bundles_->cast(bundle, [&](const CrossedLines& lines) {
            for_each_pair(patches_, lines, [&](std::uint32_t a, std::uint32_t b) { receive(a), receive(b); });
        });
        for (std::size_t o = 0; o < objects; ++o) {
            for (std::size_t f = 0; f < 2; ++f) illuminance_lx[o][f].add(4 * kPi * received[o][f] / 2);
        }
    }
    constexpr std::size_t room = 0, table = 2, disk = 4;
    for (std::size_t o = 0; o < objects; ++o) {
        const auto& [front, back] = illuminance_lx[o];
        EXPECT_LT(std::abs(front.z_score(kPi)), 4) << o << ": " << front.mean();
        EXPECT_LT(front.standard_error() / kPi, 0.1);
        if (o == table || o == disk) {
            EXPECT_LT(std::abs(back.z_score(kPi)), 4) << o << ": " << back.mean();
        }
        if (o == room) {
            EXPECT_LT(back.mean(), most_turned_around() * kPi);
        }
    }
}

/// A cube of 1 m above a ground of 2 km, and a sheet of 1 m far away: small patches and large ones. Each is
/// crossed by lines that stand for its cross-section on average, whatever else there is, and the lines are
/// about as many as the patches.
TEST(Bundles, CrossThePatchesOfALargeSceneAsTheyNeed) {
    for (const double far_m : {100.0, 1e4, 1e8}) {
        Scene scene;
        add_object(scene, inward({{0, 0, 0}, {1, 1, 1}}), diffuse(0.5));
        add_object(scene, Rectangle{{-1000, -1000, -0.2}, {2000, 0, 0}, {0, 2000, 0}}, diffuse(0.5));
        add_object(scene, Rectangle{{far_m, 0, 0}, {0, 1, 0}, {0, 0, 1}}, diffuse(0.5));
        Patches patches = make_patches(scene, 100, Monitor::none(), Vec3{0.5, 0.5, 0});
        ASSERT_LT(patches.count(), 5000u);
        const PatchCaster caster(patches);
        const auto bundles = make_bundles(BufferBackend::rays, caster);
        RandomPairs random{7};
        std::array<Moments, 3> crossed;  // of each object, over what is expected
        Moments inside;                  // pairs of sides in the cube, over all that leave its inner sides
        double lines = 0;
        constexpr int directions = 2000;
        for (int i = 0; i < directions; ++i) {
            const auto [u1, u2] = random.next_pair();
            const Frame frame = Frame::around(math::sample_sphere(u1, u2).direction);
            std::array<double, 3> sums{}, expected{};
            double pairs_m2 = 0;
            bundles->cast({frame, 1, {random.next(), random.next()}}, [&](const CrossedLines& found) {
                lines += static_cast<double>(found.count());
                for (std::size_t n = 0; n < found.count(); ++n) {
                    const auto sides = found.line(n).sides;
                    for (const std::uint32_t side : sides)
                        sums[index_of(patches.object_of(patches.patch_of(side)))] += found.line_area_m2();
                }
                for_each_pair(patches, found, [&](std::uint32_t sender, std::uint32_t receiver) {
                    const auto is_inside = [&](std::uint32_t side) {
                        return patches.is_front(side) && index_of(patches.object_of(side)) == 0;
                    };
                    if (is_inside(sender) && is_inside(receiver)) pairs_m2 += found.line_area_m2();
                });
            });
            for (std::uint32_t p = 0; p < patches.count(); ++p) {
                expected[index_of(patches.object_of(p))] +=
                    patches.areas_m2[p] * std::abs(dot(frame.w, patches.normal_of(p)));
            }
            for (std::size_t o = 0; o < 3; ++o) crossed[o].add(sums[o] / expected[o]);
            inside.add(pairs_m2 / (expected[0] / 2));
        }
        for (std::size_t o = 0; o < 3; ++o) {
            if (o == 2 && far_m > 1e4) continue;  // single precision does not know its corners
            EXPECT_LT(std::abs(crossed[o].z_score(1)), 4) << far_m << ": " << o << ": " << crossed[o].mean();
            EXPECT_LT(crossed[o].standard_error(), 0.05) << far_m << ": " << o;
        }
        EXPECT_LT(std::abs(inside.z_score(1)), 4) << far_m << ": " << inside.mean();
        EXPECT_LT(lines, 8. * directions * static_cast<double>(patches.count())) << far_m;
    }
}

/// A box of 5 cm with a sheet 1 m and 60 m away: on one grid the lines between them would be millions.
TEST(Bundles, HaveNoMoreLinesWhereLittleIsInALargeSpace) {
    for (const double far_m : {1.0, 60.0}) {
        Scene scene;
        add_object(scene, inward({{0, 0, 0}, {0.05, 0.05, 0.05}}), diffuse(0.5));
        add_object(scene, Rectangle{{far_m, 0, 0}, {0, 0.05, 0}, {0, 0, 0.05}}, diffuse(0.5));
        const Patches patches = make_patches(scene, 0.005);
        const PatchCaster caster(patches);
        const auto bundles = make_bundles(BufferBackend::rays, caster);
        RandomPairs random{11};
        Moments pairs;
        for (int i = 0; i < 200; ++i) {
            const auto [u1, u2] = random.next_pair();
            const Frame frame = Frame::around(math::sample_sphere(u1, u2).direction);
            double crossed_m2 = 0, expected_m2 = 0;
            bundles->cast({frame, 1e-4, {random.next(), random.next()}}, [&](const CrossedLines& lines) {
                for (std::size_t n = 0; n < lines.count(); ++n)
                    crossed_m2 += lines.line_area_m2() * static_cast<double>(lines.line(n).sides.size());
            });
            for (std::uint32_t p = 0; p < patches.count(); ++p)
                expected_m2 += patches.areas_m2[p] * std::abs(dot(frame.w, patches.normal_of(p)));
            pairs.add(crossed_m2 / expected_m2);
        }
        EXPECT_LT(std::abs(pairs.z_score(1)), 4) << far_m << ": " << pairs.mean();
        EXPECT_LT(pairs.standard_error(), 0.005) << far_m;
    }
}

TEST_P(BundlesOf, AnythingCanBeCastOnSeveralThreads) {
    look_at(furnished_room(), 0.3);
    const Bundle bundle = random_bundle(0.03);
    const auto sum_of_sides = [&] {
        std::uint64_t sum = 0;
        for_each_line(bundle, [&](const CrossedLine& line) {
            sum = std::accumulate(line.sides.begin(), line.sides.end(), sum);
        });
        return sum;
    };
    const std::uint64_t alone = sum_of_sides();
    std::vector<std::future<std::uint64_t>> together;
    for (int i = 0; i < 4; ++i) together.push_back(std::async(std::launch::async, sum_of_sides));
    for (auto& sum : together) EXPECT_EQ(sum.get(), alone);
}

TEST_P(BundlesOf, NothingCrossNothing) {
    look_at(Scene{}, 1);
    for_each_line(random_bundle(0.1), [](const CrossedLine&) { FAIL(); });
}

TEST_P(BundlesOf, NoSpacingAreRefused) {
    look_at(empty_room(), 1);
    for (const double spacing_m : {0.0, -1.0, 1e-6, std::nan("")}) {
        EXPECT_THROW(bundles_->cast(random_bundle(spacing_m), [](const CrossedLines&) {}), InputError);
    }
}

INSTANTIATE_TEST_SUITE_P(Both, BundlesOf, testing::Values(BufferBackend::rays, BufferBackend::opengl),
                         name_of_backend);

}  // namespace
}  // namespace stilb::patches
