#include "estimators/local/guess/certain_light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/parallel.h"
#include "estimators/estimator_list.h"
#include "estimators/local/guess/guided_light.h"
#include "estimators/receivers.h"
#include "lights/solid_angle/projected_solid_angle.h"
#include "materials/thin_dielectric.h"
#include "statistics/hypothesis.h"
#include "support/scene_builder.h"

namespace stilb::estimators {
namespace {

/// A room with a cupboard on a wall, a box on the floor, a pane and a ball: at table height.
class Furniture : public testing::Test {
  protected:
    static Scene room() {
        Scene scene;
        add_object(scene, Box{{0, 0, 0}, {3, 3, 3}}, diffuse(0.6));
        add_object(scene, Box{{0.001, 0.8, 1.2}, {0.5, 2.2, 2}}, diffuse(0.5));
        add_object(scene, Box{{1.7, 0.6, 0.001}, {2.5, 1.4, 1.1}}, diffuse(0.4));
        add_object(scene, Rectangle{{2.2, 1.8, 0.5}, {0, 0.8, 0}, {0, 0, 1}}, ThinDielectric{});
        add_object(scene, Sphere{{1.2, 2.3, 1.6}, 0.2}, diffuse(0.7));
        add_area_light(scene, Rectangle{{1.1, 1.1, 2.99}, {0, 0.8, 0}, {0.8, 0, 0}}, Rgb::grey(2000));
        return scene;
    }
    /// Blocks of sixteen points: beside a wall, below the cupboard, behind the pane, in the middle; tilted
    /// points; points on the floor, and on floor and wall about a corner.
    static std::vector<MeasuringPoint> points() {
        std::vector<MeasuringPoint> all;
        for (const Vec3 corner : {Vec3{0.02, 0.02, 0.8}, Vec3{0.1, 1.4, 0.8}, Vec3{2.4, 2, 0.8},
                                  Vec3{1.3, 1.2, 0.8}, Vec3{2.7, 0.3, 0.4}}) {
            for (int i = 0; i < 16; ++i)
                all.push_back({corner + Vec3{0.05 * (i % 4), 0.05 * (i / 4), 0}, {0, 0, 1}});
        }
        for (int i = 0; i < 16; ++i)
            all.push_back({{1 + 0.05 * (i % 4), 0.3, 1 + 0.05 * (i / 4)},
                           normalized(Vec3{-1, 0.1 * (i % 3), 0.05 * (i % 2)})});
        for (int i = 0; i < 16; ++i)
            all.push_back({{0.3 + 0.1 * (i % 4), 2.5 + 0.1 * (i / 4), 0}, {0, 0, 1}});
        for (int i = 0; i < 8; ++i) {
            all.push_back({{0.02 * i, 0.5, 0}, {0, 0, 1}});
            all.push_back({{0, 0.5, 0.01 + 0.02 * i}, {1, 0, 0}});
        }
        return all;
    }
    std::vector<Sights> sights() const {
        std::vector<CertainSides::Group> groups;
        for (std::size_t first = 0; first < receivers_.size(); first += kPacketWidth)
            groups.push_back(std::span(receivers_).subspan(first, kPacketWidth));
        return guided_->sides.find(groups);
    }
    const patches::Patches& patches() const { return guided_->guess.patches(); }

    const Scene scene_ = room();
    const rays::RayCaster caster_{scene_};
    const std::vector<transport::Receiver> receivers_ = receivers_of(points(), caster_);
    const std::vector<Measurand> measurands_ = [] {
        std::vector<Measurand> all;
        for (const MeasuringPoint& point : points()) all.push_back(point);
        return all;
    }();
    const transport::LightSampler lights_{scene_, caster_};
    const transport::PathTracer tracer_{scene_, caster_, lights_};
    const math::RandomKey key_{31};
    const Problem problem_{.scene = scene_,
                           .caster = caster_,
                           .max_reflections = transport::kUnlimited,
                           .preparation_key = {key_.derived(0)},
                           .measurands = measurands_};
    const std::unique_ptr<GuidedLight> guided_ =
        GuidedLight::make(problem_, lights_, tracer_, {key_.derived(1)});
};

TEST_F(Furniture, NothingHidesWhatIsCertain) {
    const std::vector<Sights> all = sights();
    std::size_t certain = 0, none = 0;
    for (std::size_t group = 0; group < all.size(); ++group) {
        for (const std::uint32_t side : guided_->guess.lit_sides()) {
            const Sight sight = all[group][side];
            if (sight == Sight::uncertain) continue;
            (sight == Sight::certain ? certain : none) += 1;
            math::SampleStream stream(key_.derived(2).derived(group), side);
            for (std::size_t i = 0; i < kPacketWidth; ++i) {
                const transport::Receiver& receiver = receivers_[group * kPacketWidth + i];
                const SurfacePoint point =
                    side_point(patches(), caster_, side, math::sample_triangle(stream.next(), stream.next()));
                const Vec3 to_side = point.position - receiver.position();
                if (!(dot(to_side, receiver.normal()) > 1e-4 && dot(to_side, point.normal) < -1e-4)) continue;
                EXPECT_EQ(sight, Sight::certain);
                EXPECT_EQ(caster_.transmittance({receiver.lifted(), point.lifted}), Rgb::grey(1))
                    << "side " << side << ", receiver " << group * kPacketWidth + i;
            }
        }
    }
    EXPECT_GT(certain, guided_->guess.lit_sides().size());
    EXPECT_GT(none, guided_->guess.lit_sides().size() / 2);
}

/// The closed form in double precision, side by side.
TEST_F(Furniture, CertainLightIsThatOfTheProjectedSolidAngles) {
    const std::vector<Sights> all = sights();
    const std::vector<PointTile> tiles =
        tiles_of(receivers_, std::vector<double>(receivers_.size(), 1), caster_, transport::kUnlimited);
    for (std::size_t group = 0; group < all.size(); ++group) {
        const auto lx = CertainLight(guided_->guess, all[group]).illuminances_lx(tiles[group]);
        for (std::size_t i = 0; i < kPacketWidth; ++i) {
            const transport::Receiver& receiver = receivers_[group * kPacketWidth + i];
            Rgb expected;
            for (const std::uint32_t side : guided_->guess.lit_sides()) {
                if (all[group][side] != Sight::certain) continue;
                Mesh mesh;
                for (const std::uint32_t corner : patches().corners[patches().patch_of(side)])
                    mesh.vertices.push_back(patches().center + Vec3(patches().vertices[corner]));
                mesh.triangles.push_back(patches().is_front(side) ? Triangle{0, 1, 2} : Triangle{0, 2, 1});
                expected += lights::projected_solid_angle_sr(lights::emitter_elements(mesh)[0],
                                                             {receiver.position(), receiver.normal()}) *
                            guided_->guess.mean(side).whole;
            }
            for (std::size_t b = 0; b < kBands; ++b)
                EXPECT_NEAR(double{lx[0][b][i]}, expected[b], 2e-5 * expected[b]) << group << " " << i;
        }
    }
}

statistics::Estimate mean_of(const Estimator& method, std::size_t readings, math::RandomKey key,
                             std::uint64_t samples) {
    std::vector<double> means(32);
    parallel_for(means.size(), [&](std::size_t r) {
        Tally sums(readings);
        method.run_batch({key.derived(r), 0, samples}, sums);
        for (std::size_t j = 0; j < readings; ++j)
            means[r] +=
                (method.known_part()[j] + sums.sum[j] * (1 / static_cast<double>(samples))).luminance() /
                static_cast<double>(readings);
    });
    return statistics::estimate_from_replicates(means);
}

/// Closed forms, connections and rays share the light of every side without gap or overlap.
TEST_F(Furniture, TheMeanIsThatOfLocalEstimation) {
    const auto guided = mean_of(*make_guided(problem_), measurands_.size(), key_.derived(3), 96);
    const auto balanced_method = make_balanced(problem_);
    const std::uint64_t granularity = balanced_method->batch_granularity();
    const auto balanced = mean_of(*balanced_method, measurands_.size(), key_.derived(4),
                                  std::max<std::uint64_t>(1, 6144 / granularity) * granularity);
    EXPECT_LT(guided.standard_error, 0.0015 * guided.value);
    EXPECT_LT(balanced.standard_error, 0.0015 * balanced.value);
    EXPECT_LT(std::abs(statistics::z_score(guided, balanced)), 3.5)
        << guided.value << " +- " << guided.standard_error << ", " << balanced.value << " +- "
        << balanced.standard_error;
}

}  // namespace
}  // namespace stilb::estimators
