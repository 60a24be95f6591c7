
#include "estimators/patch_light/first_shot/variants.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/parallel.h"
#include "materials/black.h"
#include "materials/split_material.h"
#include "stilb/error.h"

namespace stilb::estimators {

namespace {

constexpr double kTurn = 2 * std::numbers::pi;
/// Directions whose mean represents a bin.
constexpr std::array<std::pair<double, double>, 4> kBinSamples{
    {{0.25, 0.25}, {0.25, 0.75}, {0.75, 0.25}, {0.75, 0.75}}};

}  // namespace

HemisphereBins::HemisphereBins(int rings) : rings_(static_cast<std::uint32_t>(rings)), sectors_(4 * rings_) {
    constexpr int kMost = 256;
    if (rings >= 1 && rings <= kMost) return;
    throw InputError(fmt::format(
        "classical first shot with {} rings of bins: reflected light needs at least one ring. Use 1 "
        "to {}; r rings are 4 r^2 bins of directions for each patch.",
        rings, kMost));
}

std::uint32_t HemisphereBins::bin_of(const Vec3& local) const {
    const double squared_sine = local.x * local.x + local.y * local.y;
    const double angle = std::atan2(local.y, local.x);
    const double turn = angle < 0 ? angle + kTurn : angle;
    const auto index = [](double share, std::uint32_t count) {
        return std::min(static_cast<std::uint32_t>(share * count), count - 1);
    };
    return index(squared_sine, rings_) * sectors_ + index(turn / kTurn, sectors_);
}

Vec3 HemisphereBins::direction(std::uint32_t bin, double u1, double u2) const {
    const std::uint32_t ring = bin / sectors_, sector = bin % sectors_;
    const double squared_sine = (ring + u1) / rings_;
    const double angle = kTurn * (sector + u2) / sectors_;
    const double sine = std::sqrt(squared_sine);
    return {sine * std::cos(angle), sine * std::sin(angle), std::sqrt(1 - squared_sine)};
}

ClassicalFirstShot::ClassicalFirstShot(const Scene& scene, const patches::Patches& patches,
                                       const IncomingFirstShot& incoming, const HemisphereBins& bins)
    : patches_(patches), bins_(bins), first_{0} {
    const auto sides = static_cast<std::uint32_t>(2 * patches.count());
    first_.reserve(sides + 1);
    for (std::uint32_t side = 0; side < sides; ++side) {
        const Material& material = material_of(scene, patches, side);
        const bool is_dark = incoming.factors().of(side).empty() || reflects_nothing(material);
        first_.push_back(first_.back() + (is_dark ? 0 : reflects_alike(material) ? 1 : bins_.count()));
    }
    radiance_cd_m2_.resize(first_.back());
    parallel_for(sides, [&](std::size_t side) { store(static_cast<std::uint32_t>(side), incoming); });
}

void ClassicalFirstShot::store(std::uint32_t side, const IncomingFirstShot& incoming) {
    const std::size_t count = bins_of(side);
    if (count == 0) return;
    const Frame frame = frame_of(patches_, side);
    std::vector<Vec3> outs;
    if (count == 1) outs.push_back(frame.w);
    for (std::uint32_t bin = 0; count > 1 && bin < count; ++bin) {
        for (const auto& [u1, u2] : kBinSamples) outs.push_back(frame.to_world(bins_.direction(bin, u1, u2)));
    }
    std::vector<Rgb> sums(outs.size());
    incoming.add_reflected(side, {}, {}, outs, sums);
    const std::size_t per_bin = outs.size() / count;
    for (std::size_t bin = 0; bin < count; ++bin) {
        Rgb mean;
        for (std::size_t i = 0; i < per_bin; ++i) mean += sums[bin * per_bin + i];
        radiance_cd_m2_[first_[side] + bin] = in_floats(mean * (1 / static_cast<double>(per_bin)));
    }
}

void ClassicalFirstShot::add_reflected(std::uint32_t side, const Vec3&, math::RandomKey,
                                       std::span<const Vec3> outs, std::span<Rgb> sums) const {
    const std::size_t count = bins_of(side);
    if (count == 0) return;
    const Frame frame = frame_of(patches_, side);
    for (std::size_t i = 0; i < outs.size(); ++i) {
        const Vec3 out = frame.to_local(outs[i]);
        if (out.z <= 0) continue;
        const std::size_t bin = count == 1 ? 0 : bins_.bin_of(out);
        sums[i] += to_spectrum(radiance_cd_m2_[first_[side] + bin]);
    }
}

DiffuseFirstShot::DiffuseFirstShot(const Scene& scene, const patches::Patches& patches,
                                   const IncomingFirstShot& incoming, const ShadowRays& rays)
    : scene_(scene), patches_(patches), rays_(rays), radiance_cd_m2_(2 * patches.count()) {
    std::vector<Rgb> diffuse;
    for (const NamedMaterial& named : scene.materials) {
        const materials::SplitMaterial parts = materials::split(named.material);
        diffuse.push_back(parts.diffuse_reflectance * std::numbers::inv_pi);
        rest_.push_back(parts.gloss.value_or(Black{}));
    }
    for (std::uint32_t side = 0; side < radiance_cd_m2_.size(); ++side) {
        const MaterialId material = patches.material_of(scene, side);
        radiance_cd_m2_[side] = in_floats(diffuse[index_of(material)] * incoming.illuminance_lx(side));
    }
}

void DiffuseFirstShot::add_reflected(std::uint32_t side, const Vec3& position, math::RandomKey key,
                                     std::span<const Vec3> outs, std::span<Rgb> sums) const {
    const Vec3 normal = patches_.normal_of(side);
    for (std::size_t i = 0; i < outs.size(); ++i) {
        if (dot(outs[i], normal) > 0) sums[i] += to_spectrum(radiance_cd_m2_[side]);
    }
    const Material& rest = rest_[index_of(patches_.material_of(scene_, side))];
    rays_.add_reflected_by(rest, side, position, key, outs, sums);
}

IncomingFirstShot::IncomingFirstShot(const Scene& scene, const patches::Patches& patches,
                                     const FirstShotLights& lights, FirstShotFactors factors)
    : scene_(scene), patches_(patches), factors_(std::move(factors)) {
    for (const LightSample& sample : lights.samples) {
        sources_.push_back({sample.viewpoint.position, lights.lights[sample.light].colour});
    }
}

Rgb IncomingFirstShot::illuminance_lx(std::uint32_t side) const {
    Rgb sum;
    for (const auto& factor : factors_.of(side)) {
        sum += sources_[factor.sample].colour * factor.illuminance_lx;
    }
    return sum;
}

void IncomingFirstShot::add_reflected(std::uint32_t side, const Vec3&, math::RandomKey,
                                      std::span<const Vec3> outs, std::span<Rgb> sums) const {
    const auto factors = factors_.of(side);
    if (factors.empty()) return;
    const Vec3 middle = patches_.middle(patches_.patch_of(side));
    const auto for_each_arrival = [&](const auto& visit) {
        for (const auto& factor : factors) {
            const Source& source = sources_[factor.sample];
            visit(normalized(source.position - middle), source.colour * factor.illuminance_lx);
        }
    };
    reflect(material_of(scene_, patches_, side), frame_of(patches_, side), for_each_arrival, outs, sums);
}

bool IncomingFirstShot::is_constant(std::uint32_t side) const {
    return factors_.of(side).empty() || reflects_alike(material_of(scene_, patches_, side));
}

}  // namespace stilb::estimators
