// The products of lamps and receivers up to which readings look at each lamp once, and above which some are
// chosen for each sample: both ways give the exact light.
//
//     direct_light.h   kMostExact 100,000,000   point lights
//                      kMostSettled 300,000     lamps with an area
#include <gtest/gtest.h>

#include <cmath>

#include "exact/configuration_factors.h"
#include "support/scene_builder.h"
#include "transport/direct/direct_light.h"

namespace stilb::transport {
namespace {

struct Counts {
    std::size_t lamps, receivers;
    bool is_settled;
};

std::vector<Receiver> receivers_below(std::size_t count, const rays::RayCaster& caster) {
    std::vector<Receiver> receivers;
    for (std::size_t i = 0; i < count; ++i) {
        const auto x = static_cast<double>(i % 16), y = static_cast<double>(i / 16 % 16);
        receivers.emplace_back(static_cast<std::uint32_t>(i),
                               MeasuringPoint{{0.1 * x, 0.1 * y, 0.5}, {0, 0, 1}}, caster);
    }
    return receivers;
}

/// The light of the first tile against `exact_lx`, which takes a receiver; z-scores where it is sampled.
template <typename ExactLx>
void expect_exact(const DirectLight& direct, std::span<const Receiver> receivers,
                  const DirectLight::Prepared& prepared, const ExactLx& exact_lx) {
    const DirectLight::Remainder& remainder = prepared.remainders[0];
    constexpr std::uint64_t samples = 20000;
    std::array<double, kPacketWidth> sums{}, squares{};
    for (std::uint64_t k = 0; k < (remainder.is_empty() ? 0 : samples); ++k) {
        std::vector<math::SampleStream> streams;
        for (std::uint64_t j = 0; j < kPacketWidth; ++j)
            streams.emplace_back(math::RandomKey{k}.derived(j), 0);
        DirectLight::TileLight light{};
        direct.add_sample(receivers.first(kPacketWidth), remainder, streams, light);
        for (std::size_t j = 0; j < kPacketWidth; ++j)
            sums[j] += light[j].luminance(), squares[j] += light[j].luminance() * light[j].luminance();
    }
    for (std::size_t j = 0; j < kPacketWidth; ++j) {
        const double exact = exact_lx(receivers[j].position()), mean = sums[j] / samples;
        const double error = std::sqrt(std::max(squares[j] / samples - mean * mean, 0.0) / samples);
        EXPECT_NEAR(prepared.known[j].luminance() + mean, exact, 4 * error + 1e-6 * exact) << j;
        EXPECT_LT(error, 0.02 * exact);
    }
}

class ManyPoints : public testing::TestWithParam<Counts> {};

/// All but 40 shine from below.
TEST_P(ManyPoints, AreExactOrChosen) {
    const auto [count, receiver_count, is_settled] = GetParam();
    Scene scene;
    add_object(scene, Rectangle{{-50, -50, -1}, {100, 0, 0}, {0, 100, 0}}, diffuse(0));
    const auto place = [](std::size_t i) {
        const auto n = static_cast<double>(i);
        return i < 40 ? Vec3{0.2 * n - 4, 3 - 0.1 * n, 2 + 0.05 * n} : Vec3{0.001 * n, 1, -0.9};
    };
    for (std::size_t i = 0; i < count; ++i)
        add_point_light(scene, place(i), Rgb::grey(1.0 + static_cast<double>(i % 7)));
    const rays::RayCaster caster(scene);
    const LightSampler lights(scene, caster);
    const DirectLight direct(scene, caster, lights);
    const std::vector<Receiver> receivers = receivers_below(receiver_count, caster);
    const auto prepared = direct.prepare(receivers, Monitor::none());
    EXPECT_EQ(prepared.remainders[0].points, !is_settled);
    expect_exact(direct, receivers, prepared, [&](const Vec3& at) {
        double sum_lx = 0;
        for (std::size_t i = 0; i < 40; ++i)
            sum_lx +=
                exact::illuminance_by_point_lx({at, {0, 0, 1}}, place(i), 1.0 + static_cast<double>(i % 7));
        return sum_lx;
    });
}

// The least product above the constant is that of a prime number with 17 lamps and millions of receivers.
INSTANTIATE_TEST_SUITE_P(Around, ManyPoints,
                         testing::Values(Counts{9'999, 10'001, true}, Counts{10'000, 10'000, true},
                                         Counts{10'001, 10'000, false}));

class ManyLamps : public testing::TestWithParam<Counts> {};

TEST_P(ManyLamps, AreSettledOrChosen) {
    const auto [count, receiver_count, is_settled] = GetParam();
    Scene scene;
    add_object(scene, Rectangle{{-50, -50, -1}, {100, 0, 0}, {0, 100, 0}}, diffuse(0));
    const auto panel = [](std::size_t i) {
        const auto x = static_cast<double>(i % 25), y = static_cast<double>(i / 25);
        return Rectangle{{0.3 * x - 3, 0.3 * y - 3, 3}, {0, 0.2, 0}, {0.2, 0, 0}};
    };
    const auto luminance_cd_m2 = [](std::size_t i) { return 10.0 * static_cast<double>(1 + i % 7); };
    for (std::size_t i = 0; i < count; ++i) add_area_light(scene, panel(i), Rgb::grey(luminance_cd_m2(i)));
    const rays::RayCaster caster(scene);
    const LightSampler lights(scene, caster);
    const DirectLight direct(scene, caster, lights);
    const std::vector<Receiver> receivers = receivers_below(receiver_count, caster);
    const auto prepared = direct.prepare(receivers, Monitor::none());
    EXPECT_EQ(prepared.remainders[0].chooses_by_tree, !is_settled);
    expect_exact(direct, receivers, prepared, [&](const Vec3& at) {
        double sum_lx = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const Rectangle p = panel(i);
            sum_lx += exact::illuminance_by_rectangle_lx({at, {0, 0, 1}}, p.corner, p.edge_u, p.edge_v,
                                                         luminance_cd_m2(i));
        }
        return sum_lx;
    });
}

INSTANTIATE_TEST_SUITE_P(Around, ManyLamps,
                         testing::Values(Counts{119, 2'521, true},   // 299,999
                                         Counts{120, 2'500, true},   // 300,000
                                         Counts{611, 491, false}));  // 300,001

}  // namespace
}  // namespace stilb::transport
