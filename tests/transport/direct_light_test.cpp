#include "transport/direct/direct_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "exact/configuration_factors.h"
#include "lights/opening_shape.h"
#include "materials/thin_dielectric.h"
#include "support/scene_builder.h"
#include "transport/direct/one_receiver.h"

namespace stilb::transport {
namespace {

const Rectangle kPanel{{1.5, 1.5, 2.9}, {0, 1, 0}, {1, 0, 0}};  // faces down

Scene room(const Shape& lamp) {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {4, 4, 3}}, diffuse(0.5));
    add_area_light(scene, lamp, Rgb{{1000, 800, 600}});
    return scene;
}

/// Unequal planes, so that the light varies over an opening.
PhotometricSolid uneven_solid() {
    PhotometricSolid::Grid grid;
    grid.planes_deg = {0, 90, 180, 270, 360};
    grid.polar_deg = {0, 30, 60, 90};
    grid.intensity_cd = {300, 250, 150, 5,   300, 350, 90,  5,   300, 100,
                         50,  5,   300, 250, 20,  5,   300, 250, 150, 5};
    return PhotometricSolid(grid);
}

const Vec3 kOpeningMiddle{2, 2, 2.9};
constexpr double kOpeningWidth_m = 0.6, kOpeningDepth_m = 0.3;

/// A room with a luminaire that shines down from an opening.
Scene room_with_opening(const lights::Opening& opening) {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {4, 4, 3}}, diffuse(0.5));
    add_opening(scene, kOpeningMiddle, uneven_solid(), opening);
    return scene;
}

/// Scene, lights and receivers; direct light of these by both ways.
struct Setting {
    Scene scene;
    rays::RayCaster caster{scene};
    LightSampler lights{scene, caster};
    DirectLight direct{scene, caster, lights};
    std::vector<Receiver> receivers;

    explicit Setting(Scene built) : scene(std::move(built)) {}
    void add(const Vec3& position, const Vec3& normal) {
        receivers.emplace_back(static_cast<std::uint32_t>(receivers.size()), MeasuringPoint{position, normal},
                               caster);
    }
    /// Sixteen points on a horizontal plane.
    void add_tile(double x, double y, double z, double step = 0.1) {
        for (int i = 0; i < kPacketWidth; ++i) add({x + step * (i % 4), y + step * (i / 4), z}, {0, 0, 1});
    }
};

std::vector<math::SampleStream> streams(std::uint64_t key, std::uint64_t index) {
    std::vector<math::SampleStream> all;
    for (std::uint64_t j = 0; j < kPacketWidth; ++j) all.emplace_back(math::RandomKey{key}.derived(j), index);
    return all;
}

struct Estimate {
    double mean = 0, standard_error = 0;
};
template <typename Sample>
Estimate estimate(int count, const Sample& sample) {
    double sum = 0, squares = 0;
    for (int i = 0; i < count; ++i) {
        const double x = sample(static_cast<std::uint64_t>(i));
        sum += x, squares += x * x;
    }
    const double mean = sum / count;
    return {mean, std::sqrt(std::max(0.0, squares / count - mean * mean) / (count - 1))};
}

/// As pictures take it.
void add_all(const DirectLight& direct, std::span<const Receiver> tile, std::span<math::SampleStream> streams,
             DirectLight::TileLight& light) {
    const DirectLight::Remainder remainder = direct.add_certain(tile, light);
    if (!remainder.is_empty()) direct.add_sample(tile, remainder, streams, light);
}

/// Both ways agree for the first tile: the z-scores of the differences to the sampling of
/// sample_direct_from_areas() and direct_from_points().
void expect_agreement(const Setting& s, int count = 4000) {
    const auto prepared = s.direct.prepare(s.receivers, Monitor::none());
    const std::span<const Receiver> tile =
        std::span(s.receivers).first(std::min<std::size_t>(16, s.receivers.size()));
    std::vector<DirectLight::TileLight> readings, pictures;
    for (int i = 0; i < count; ++i) {
        const auto index = static_cast<std::uint64_t>(i);
        auto& reading = readings.emplace_back();
        // A key for each sample: independent, for the standard error.
        auto own = streams(1'000'000 + index, 0);
        if (!prepared.remainders[0].is_empty())
            s.direct.add_sample(tile, prepared.remainders[0], own, reading);
        own = streams(2'000'000 + index, 0);
        add_all(s.direct, tile, own, pictures.emplace_back());
    }
    for (std::size_t j = 0; j < tile.size(); ++j) {
        const double known = prepared.known[j].luminance();
        const Estimate by_reading =
            estimate(count, [&](auto i) { return known + readings[i][j].luminance(); });
        const Estimate by_picture = estimate(count, [&](auto i) { return pictures[i][j].luminance(); });
        const double points = direct_from_points(tile[j], s.caster, s.lights).luminance();
        const Estimate old = estimate(4 * count, [&](auto i) {
            math::SampleStream stream(math::RandomKey{9}.derived(j).derived(i), 0);
            return points + sample_direct_from_areas(tile[j], s.caster, s.lights, stream).luminance();
        });
        for (const Estimate& e : {by_reading, by_picture}) {
            const double error = std::hypot(e.standard_error, old.standard_error) + 1e-9 * old.mean;
            EXPECT_NEAR(e.mean, old.mean, 4 * error) << j;
        }
    }
}

TEST(DirectLight, IsExactInAnEmptyRoom) {
    Setting s(room(kPanel));
    s.add_tile(0.5, 0.5, 0.8);
    const auto prepared = s.direct.prepare(s.receivers, Monitor::none());
    EXPECT_TRUE(prepared.remainders[0].is_empty());
    for (std::size_t j = 0; j < s.receivers.size(); ++j) {
        const double expected = exact::illuminance_by_rectangle_lx(
            {s.receivers[j].position(), {0, 0, 1}}, kPanel.corner, kPanel.edge_u, kPanel.edge_v,
            Rgb{{1000, 800, 600}}.luminance());
        EXPECT_NEAR(prepared.known[j].luminance(), expected, 1e-9 * expected);
        DirectLight::TileLight light{};
        auto own = streams(1, 0);
        add_all(s.direct, s.receivers, own, light);
        EXPECT_EQ(light[j], prepared.known[j]);
    }
}

TEST(DirectLight, AgreesWithSamplingBehindOccluders) {
    for (const Shape& lamp :
         {Shape{kPanel}, Shape{Sphere{{2, 2, 2.5}, 0.2}}, Shape{Disk{{2, 2, 2.9}, {0, 0, -1}, 0.5}},
          Shape{Box{{1.8, 1.8, 2.4}, {2.2, 2.2, 2.6}}}}) {
        Scene scene = room(lamp);
        add_object(scene, Rectangle{{0.8, 0.8, 1.2}, {0.8, 0, 0}, {0, 0.8, 0.2}}, diffuse(0.5));
        Setting s(std::move(scene));
        s.add_tile(0.3, 0.3, 0.01, 0.4);
        EXPECT_TRUE(s.direct.prepare(s.receivers, Monitor::none()).remainders[0].has_lamps());
        expect_agreement(s);
    }
}

TEST(DirectLight, AgreesWhereTheHorizonCrossesTheLamp) {
    for (const Shape& lamp : {Shape{kPanel}, Shape{Sphere{{2, 2, 2.5}, 0.4}}}) {
        Scene scene = room(lamp);
        add_object(scene, Rectangle{{1.2, 1.2, 2}, {0.8, 0, 0}, {0, 0.8, 0}}, diffuse(0.5));
        Setting s(std::move(scene));
        for (int i = 0; i < kPacketWidth; ++i)
            s.add({1 + 0.1 * i, 2, 1.5}, normalized(Vec3{1, 0, 0.05 * i - 0.2}));
        expect_agreement(s);
    }
}

TEST(DirectLight, ThereIsNoNoiseWhereAllOrNothingIsSeen) {
    Scene scene = room(kPanel);
    add_object(scene, Rectangle{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}, diffuse(0.5));
    Setting s(std::move(scene));
    // Below the shelf, beside it, and above it.
    for (const Vec3& at : {Vec3{0.1, 0.1, 0.9}, {2.5, 2.5, 0.1}, {0.5, 0.5, 1.1}}) s.add(at, {0, 0, 1});
    // As if no shaft were empty.
    DirectLight::Remainder all;
    all.lamps.fill(1);
    for (std::uint64_t i = 0; i < 100; ++i) {
        DirectLight::TileLight light{};
        auto own = streams(3, i);
        s.direct.add_sample(s.receivers, all, own, light);
        EXPECT_EQ(light[0].max(), 0);
        for (const std::size_t j : {1u, 2u}) {
            const double expected = exact::illuminance_by_rectangle_lx(
                {s.receivers[j].position(), {0, 0, 1}}, kPanel.corner, kPanel.edge_u, kPanel.edge_v,
                Rgb{{1000, 800, 600}}.luminance());
            EXPECT_NEAR(light[j].luminance(), expected, 1e-9 * expected);
        }
    }
}

TEST(DirectLight, NothingArrivesInTheLampsPlaneAndBehindIt) {
    Setting s(room(kPanel));
    s.add({0.5, 2, 2.9}, {1, 0, 0});
    s.add({2, 2, 2.95}, {0, 0, -1});
    s.add({2, 2, 1}, {0, 0, -1});
    DirectLight::TileLight light{};
    auto own = streams(1, 0);
    add_all(s.direct, s.receivers, own, light);
    for (const Rgb& received : light.sum) EXPECT_EQ(received.max(), 0);
}

TEST(DirectLight, ThinOccludersAreSampled) {
    Scene scene = room(kPanel);
    add_object(scene, Rectangle{{2, 0, 1.5}, {1e-4, 0, 0}, {0, 4, 0}}, diffuse(0.5));  // a wire
    Setting s(std::move(scene));
    s.add_tile(1.8, 1.8, 0.8);
    const auto prepared = s.direct.prepare(s.receivers, Monitor::none());
    for (const std::uint32_t lamps : prepared.remainders[0].lamps) EXPECT_EQ(lamps, 1u);
}

TEST(DirectLight, GoesThroughPanesWithTheirTransmittance) {
    Scene scene = room(kPanel);
    add_object(scene, Rectangle{{0, 0, 1.5}, {4, 0, 0}, {0, 4, 0}}, ThinDielectric{});
    Setting s(std::move(scene));
    s.add_tile(0.5, 0.5, 0.8);
    EXPECT_TRUE(s.direct.prepare(s.receivers, Monitor::none()).remainders[0].has_lamps());
    expect_agreement(s);
}

TEST(DirectLight, ReceiversOfATileAreProvedApart) {
    Scene scene = room(kPanel);
    add_object(scene, Rectangle{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}, diffuse(0.5));
    Setting s(std::move(scene));
    // In the shelf's shadow, in its penumbra, beside it, and above it.
    for (const Vec3& at : {Vec3{0.1, 0.1, 0.9}, {0.6, 0.6, 0.1}, {2.5, 2.5, 0.1}, {0.5, 0.5, 1.1}})
        s.add(at, {0, 0, 1});
    const auto prepared = s.direct.prepare(s.receivers, Monitor::none());
    const auto& lamps = prepared.remainders[0].lamps;
    EXPECT_EQ(lamps[0], 0u);
    EXPECT_EQ(lamps[1], 1u);
    EXPECT_EQ(lamps[2], 0u);
    EXPECT_EQ(lamps[3], 0u);
    EXPECT_EQ(prepared.known[0].max(), 0);
    expect_agreement(s, 1000);
}

/// Shadow rays confirm it; it is known at most of the points that no shadow ray reaches.
TEST(DirectLight, LampsBehindOneFaceAreHidden) {
    for (const Shape& lamp : {Shape{kPanel}, Shape{Sphere{{2, 2, 2.5}, 0.2}}}) {
        Scene scene = room(lamp);
        add_object(scene, Box{{0.5, 0.5, 0.6}, {1.7, 1.5, 1.2}}, diffuse(0.5));
        add_object(scene, Disk{{3, 1, 1}, {0, 0, 1}, 0.5}, diffuse(0.5));
        add_object(scene, Rectangle{{2.5, 2.5, 1}, {1, 0, 0}, {0, 1, 0}}, ThinDielectric{});
        Setting s(std::move(scene));
        for (int row = 0; row < 8; ++row) s.add_tile(0.05, 0.02 + 0.5 * row, 0.2, 0.25);
        for (int row = 0; row < 8; ++row) s.add_tile(2.05, 0.02 + 0.5 * row, 0.2, 0.25);
        const auto prepared = s.direct.prepare(s.receivers, Monitor::none());
        DirectLight::Remainder all;
        all.lamps.fill(1);
        int hidden = 0, dark = 0;
        for (std::size_t t = 0; t < prepared.remainders.size(); ++t) {
            const auto tile = std::span(s.receivers).subspan(t * kPacketWidth, kPacketWidth);
            DirectLight::TileLight light{};
            for (std::uint64_t i = 0; i < 200; ++i) {
                auto own = streams(5, i);
                s.direct.add_sample(tile, all, own, light);
            }
            for (std::size_t i = 0; i < kPacketWidth; ++i) {
                const bool is_hidden =
                    prepared.remainders[t].lamps[i] == 0 && prepared.known[t * kPacketWidth + i].max() == 0;
                if (is_hidden) {
                    EXPECT_EQ(light[i].max(), 0) << t << " " << i;
                }
                hidden += is_hidden;
                dark += light[i].max() == 0;
            }
        }
        EXPECT_GT(hidden, 10);
        EXPECT_GT(hidden, dark / 2);
    }
}

TEST(DirectLight, IntegratesOpeningsThatAreSeen) {
    Setting s(room_with_opening({lights::Opening::Form::box, {kOpeningWidth_m, kOpeningDepth_m, 0}}));
    s.add_tile(0.3, 0.5, 0.8);
    const auto prepared = s.direct.prepare(s.receivers, Monitor::none());
    EXPECT_TRUE(prepared.remainders[0].is_empty());
    const auto& luminaire = std::get<LuminousOpening>(s.scene.lights[0].source).luminaire;
    const PhotometricSolid solid = uneven_solid();
    for (std::size_t j = 0; j < s.receivers.size(); ++j) {
        // Many points that share the file's intensity.
        constexpr int cells = 400;
        double expected = 0;
        for (int k = 0; k < cells * cells; ++k) {
            const double x = (k % cells + 0.5) / cells - 0.5, y = (k / cells + 0.5) / cells - 0.5;
            const Vec3 towards = kOpeningMiddle + kOpeningWidth_m * x * luminaire.c0 +
                                 kOpeningDepth_m * y * luminaire.c90 - s.receivers[j].position();
            const Vec3 direction = normalized(towards);
            expected += solid.intensity_cd(luminaire.in_solid(-direction)) * direction.z /
                        squared_length(towards) / (cells * cells);
        }
        // Beside the sum's error of 1e-5, the agreement of rules.
        EXPECT_NEAR(prepared.known[j].luminance(), expected, OpeningLamp::kAgreement * expected);
    }
}

TEST(DirectLight, AgreesWithSamplingOfOpenings) {
    using Form = lights::Opening::Form;
    for (const lights::Opening& opening : {lights::Opening{Form::box, {0.6, 0.3, 0}},
                                           {Form::box, {0.6, 0.3, 0.2}},
                                           {Form::vertical_cylinder, {0.5, 0.5, 0}},
                                           {Form::ball, {0.3, 0.3, 0.3}}}) {
        Setting open(room_with_opening(opening));
        open.add_tile(0.3, 0.5, 0.01, 0.3);
        expect_agreement(open);

        Scene scene = room_with_opening(opening);
        add_object(scene, Rectangle{{0.8, 0.8, 1.2}, {0.8, 0, 0}, {0, 0.8, 0.2}}, diffuse(0.5));
        Setting hidden(std::move(scene));
        hidden.add_tile(0.3, 0.3, 0.01, 0.4);
        EXPECT_TRUE(hidden.direct.prepare(hidden.receivers, Monitor::none()).remainders[0].has_lamps() ||
                    opening.form == Form::ball);
        expect_agreement(hidden);
    }
}

TEST(DirectLight, OpeningsAreSampledWhereTheHorizonOrTheirNearnessSpoilsTheIntegral) {
    Setting s(room_with_opening({lights::Opening::Form::box, {kOpeningWidth_m, kOpeningDepth_m, 0}}));
    s.add(kOpeningMiddle - Vec3{0.29, 0, 0.001}, {0, 0, 1});
    s.add(kOpeningMiddle - Vec3{0, 0, 0.5}, normalized(Vec3{1, 0, 0.1}));
    s.add(kOpeningMiddle - Vec3{1, 0.7, 1}, {0, 0, 1});
    const auto prepared = s.direct.prepare(s.receivers, Monitor::none());
    EXPECT_EQ(prepared.remainders[0].lamps[0], 1u);
    EXPECT_EQ(prepared.remainders[0].lamps[1], 1u);
    EXPECT_EQ(prepared.remainders[0].lamps[2], 0u);
    expect_agreement(s);
}

TEST(DirectLight, BodiesAndLightFromOutsideAreSampledByDirections) {
    Scene scene;
    add_object(scene, Rectangle{{-5, -5, 0}, {10, 0, 0}, {0, 10, 0}}, diffuse(0.5));
    add_object(scene, Box{{0.5, 0.5, 0.2}, {1, 1, 1}}, diffuse(0.5));
    add_environment(scene, Rgb::grey(100));
    add_area_light(scene, Rectangle{{1.5, 1.5, 2.9}, {0, 1, 0}, {1, 0, 0}}, Rgb::grey(1000));
    Setting s(std::move(scene));
    s.add_tile(0.1, 0.1, 0.01, 0.2);
    EXPECT_TRUE(s.direct.prepare(s.receivers, Monitor::none()).remainders[0].by_directions);
    expect_agreement(s);
}

TEST(DirectLight, ManyPointLightsAreChosenWithoutBias) {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {40, 25, 3}}, diffuse(0.5));
    add_object(scene, Box{{3, 3, 0.5}, {4, 4, 2}}, diffuse(0.5));
    for (int i = 0; i < 1000; ++i)
        add_point_light(scene, {0.5 + i % 40, 0.5 + i / 40, 2.9}, Rgb::grey(1 + i % 7));
    Setting s(std::move(scene));
    // Various normals, one that sees hardly a light.
    for (int i = 0; i < kPacketWidth; ++i)
        s.add({3 + 0.2 * i, 2.5, 0.01 + 0.1 * i}, normalized(Vec3{0.1 * i - 1, 0.3, i % 5 - 1.0}));
    expect_agreement(s, 2000);
}

/// A hall with lamps of all kinds, and a screen that hides some of them from some receivers.
Scene hall_with_lamps(int count) {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {40, 10, 3}}, diffuse(0.5));
    add_object(scene, triangulated(Box{{2.2, 0.5, 0.5}, {2.3, 4, 2}}), diffuse(0.5));
    for (int i = 0; i < count; ++i) {
        const Vec3 corner{0.5 + i % 16, 0.7 + i / 16, 2.9};
        const Rgb luminance = Rgb::grey(100 + 10 * (i % 7));
        if (i % 4 == 0) add_area_light(scene, Rectangle{corner, {0, 0.4, 0}, {0.4, 0, 0}}, luminance);
        if (i % 4 == 1) add_area_light(scene, Sphere{corner, 0.1}, luminance);
        if (i % 4 == 2) {
            const lights::Opening opening{lights::Opening::Form::box, {0.5, 0.3, 0}};
            add_opening(scene, corner, uneven_solid(), opening);
        }
        if (i % 4 == 3) add_area_light(scene, icosphere({corner, 0.1}, 1), luminance);  // no closed form
    }
    return scene;
}

/// Around kFew lamps, up to which each has a bit and a shadow ray of its own.
TEST(DirectLight, ManyLampsAreSettledOrChosenWithoutBias) {
    for (const int count : {31, 32, 33, 64, 65, 130}) {
        SCOPED_TRACE(count);
        Setting s(hall_with_lamps(count));
        s.add_tile(1.5, 1.5, 0.8, 0.3);
        const auto remainder = s.direct.prepare(s.receivers, Monitor::none()).remainders[0];
        EXPECT_EQ(remainder.open.empty(), count <= 32);
        EXPECT_EQ(remainder.has_lamps(), count <= 32);
        EXPECT_FALSE(remainder.chooses_by_tree);
        expect_agreement(s, 500);
    }
}

/// 33 lamps at 9090 receivers are looked at one by one, at 9091 no more.
TEST(DirectLight, ManyLampsAtManyReceiversAreChosenByTheTree) {
    Setting s(hall_with_lamps(33));
    s.add_tile(1.5, 1.5, 0.8, 0.3);
    const Receiver below_the_floor(0, MeasuringPoint{{5, 5, -1}, {0, 0, -1}}, s.caster);  // quickly settled
    s.receivers.resize(9090, below_the_floor);
    EXPECT_FALSE(s.direct.prepare(s.receivers, Monitor::none()).remainders[0].chooses_by_tree);
    s.receivers.push_back(below_the_floor);
    EXPECT_TRUE(s.direct.prepare(s.receivers, Monitor::none()).remainders[0].chooses_by_tree);
    expect_agreement(s, 500);
}

}  // namespace
}  // namespace stilb::transport
