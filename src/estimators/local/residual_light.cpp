#include "estimators/local/residual_light.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "transport/weights.h"

namespace stilb::estimators {
namespace {

/// Packets of rays on which a path's start spends its r: all receivers share it.
constexpr std::uint64_t kResidualPackets = 2;
/// Samples of direct light there.
constexpr int kResidualDirect = 4;
/// Paths start with a density that is at least this share of what it would be if r were as large as the
/// guess; and on sides that seem dark, in so small a share of all paths.
constexpr double kFloor = 0.1;
constexpr double kDarkShare = 0.02;
/// Points of each side at which r is estimated for that.
constexpr std::uint64_t kPilots = 2;

Rgb magnitude(const Rgb& value) { return {{std::abs(value[0]), std::abs(value[1]), std::abs(value[2])}}; }

}  // namespace

ResidualLight::ResidualLight(const Scene& scene, const rays::RayCaster& caster,
                             const transport::LightSampler& lights, const transport::PathTracer& tracer,
                             const LightGuess& guess, math::RandomKey key, const Monitor& monitor)
    : scene_(scene), caster_(caster), lights_(lights), tracer_(tracer), guess_(guess) {
    const patches::Patches& patches = guess.patches();
    std::vector<std::uint8_t> is_lit(2 * patches.count());
    for (const std::uint32_t side : guess.lit_sides()) is_lit[side] = 1;
    for (std::uint32_t side = 0; side < is_lit.size(); ++side) {
        if (guess.reflectance(side).max() > 0) sides_.push_back(side);
    }
    std::vector<double> weights(sides_.size());
    parallel_for_parts(
        sides_.size(),
        [&](std::size_t first, std::size_t last) {
            monitor.require_more();
            for (std::size_t i = first; i < last; ++i) {
                if (is_lit[sides_[i]] == 0) continue;
                double square = 0;
                for (std::uint64_t k = 0; k < kPilots; ++k) {
                    math::SampleStream stream(key.derived(sides_[i]), k, 4);
                    const auto u = stream.next_two();
                    const Start start = start_on(sides_[i], u, 1, stream);
                    const double missing =
                        magnitude(start.missing_lx * guess.reflectance(sides_[i])).luminance() / kPi;
                    const double guessed =
                        guess.luminance_cd_m2(sides_[i], start.point.barycentric).luminance();
                    square += missing * missing + kFloor * kFloor * guessed * guessed;
                }
                weights[i] = double{patches.areas_m2[patches.patch_of(sides_[i])]} *
                             std::sqrt(square / static_cast<double>(kPilots));
            }
        },
        64);
    double lit_weight = 0, dark_area = 0;
    for (std::size_t i = 0; i < sides_.size(); ++i) {
        lit_weight += weights[i];
        if (is_lit[sides_[i]] == 0) dark_area += double{patches.areas_m2[patches.patch_of(sides_[i])]};
    }
    if (!(lit_weight > 0)) lit_weight = 1;
    for (std::size_t i = 0; i < sides_.size(); ++i) {
        if (is_lit[sides_[i]] == 0)
            weights[i] =
                kDarkShare * lit_weight / dark_area * double{patches.areas_m2[patches.patch_of(sides_[i])]};
    }
    by_residual_ = math::DiscreteDistribution(weights);
}

auto ResidualLight::start_on(std::uint32_t side, const std::array<double, 2>& u, std::uint64_t packets,
                             math::SampleStream& stream) const -> Start {
    const patches::Patches& patches = guess_.patches();
    Start start{side_point(patches, caster_, side, u[0], u[1]), side, {}};
    for (int i = 0; i < kResidualDirect; ++i)
        start.missing_lx += sample_direct_lx(lights_, caster_, start.point, stream) * (1. / kResidualDirect);
    const Frame frame = Frame::around(start.point.normal);
    const auto [shift_1, shift_2] = stream.next_two();
    const auto rays = static_cast<std::uint32_t>(packets * kPacketWidth);
    RayPacket packet;
    LaneMask lanes;
    lanes.fill(-1);
    GuessedLight light;
    Rgb sum;
    for (std::uint32_t first = 0; first < rays; first += kPacketWidth) {
        std::array<Vec3, kPacketWidth> directions;
        for (std::uint32_t i = 0; i < kPacketWidth; ++i) {
            const double u1 = std::min((first + i + shift_1) / rays, math::kBelowOne);
            const double u2 = math::unit_interval(math::sobol(first + i, 0)) + shift_2;
            directions[i] = frame.to_world(math::sample_cosine_hemisphere(u1, u2 - std::floor(u2)).direction);
            packet.set(i, start.point.lifted - patches.center, directions[i],
                       std::numeric_limits<float>::infinity());
        }
        guess_.look(packet, lanes, rays::Coherence::scattered, light);
        for (std::size_t i = 0; i < kPacketWidth; ++i) {
            sum += Rgb{{light.luminance[0][i], light.luminance[1][i], light.luminance[2][i]}};
            if ((light.specular_lanes >> i & 1u) == 0) continue;
            if (const auto hit = caster_.closest(start.point.lifted, directions[i]))
                sum += tracer_.luminance_without_direct(*hit, directions[i], transport::kUnlimited, stream);
        }
    }
    start.missing_lx += sum * (kPi / rays);
    const Rgb guessed = guess_.luminance_cd_m2(side, start.point.barycentric) * kPi;
    const Rgb& reflectance = guess_.reflectance(side);
    for (std::size_t b = 0; b < kBands; ++b) {
        if (reflectance[b] > 0) start.missing_lx[b] -= guessed[b] / reflectance[b];
    }
    return start;
}

std::vector<transport::LightVertex> ResidualLight::trace(math::RandomKey key, std::uint64_t first,
                                                         std::uint64_t end) const {
    std::vector<transport::LightVertex> nodes;
    if (sides_.empty()) return nodes;
    for (std::uint64_t path = first; path < end; ++path) trace_one(math::SampleStream(key, path, 8), nodes);
    return nodes;
}

void ResidualLight::trace_one(math::SampleStream stream, std::vector<transport::LightVertex>& nodes) const {
    const patches::Patches& patches = guess_.patches();
    const math::DiscreteChoice choice = by_residual_.choose(stream.next());
    const std::uint32_t side = sides_[choice.index];
    const auto u = stream.next_two();
    const Start start = start_on(side, u, kResidualPackets, stream);
    const std::uint32_t patch = patches.patch_of(side);
    const double per_density = double{patches.areas_m2[patch]} / choice.probability;
    const Material* material = &scene_.material(patches.materials[patch]);
    Rgb flux = start.missing_lx * per_density;
    Vec3 normal = start.point.normal, lifted = start.point.lifted;
    // The direction of the light that comes in does not matter on diffuse surfaces.
    nodes.push_back({start.point.position, lifted, normal, normal, normal, material, flux, 1});
    for (;;) {
        const Rgb reflectance = reflectance_bound(*material);
        const double survival = transport::survival_probability(magnitude(flux), reflectance);
        if (stream.next() >= survival) return;
        flux *= reflectance * (1 / survival);
        const auto [u1, u2] = stream.next_two();
        const Vec3 direction =
            Frame::around(normal).to_world(math::sample_cosine_hemisphere(u1, u2).direction);
        const auto hit = caster_.closest(lifted, direction);
        if (!hit) return;
        material = &scene_.material(hit->material);
        if (is_specular(*material) || !(reflectance_bound(*material).max() > 0)) return;
        normal = hit->normal, lifted = hit->lifted;
        nodes.push_back({hit->position, lifted, normal, normal, -direction, material, flux, 1});
    }
}

}  // namespace stilb::estimators
