
#include "estimators/patch_light/patch_transport.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

#include "materials/black.h"
#include "materials/diffuse.h"

namespace stilb::estimators {

namespace {

/// Rays of a bundle that meet a patch of mean size that is perpendicular to it.
constexpr double kRaysPerPatch = 2;

double area_m2(const patches::Patches& patches) {
    return std::accumulate(patches.areas_m2.begin(), patches.areas_m2.end(), 0.0);
}

}  // namespace

PatchTransport::PatchTransport(const Scene& all, const rays::RayCaster& rays, const PatchOptions& asked,
                               const Monitor& monitor)
    : FirstShotPatches(all, rays, asked, monitor) {
    describe_patches();
}

void PatchTransport::describe_patches() {
    const auto count = static_cast<std::uint32_t>(patches.count());
    glossy_number.assign(2 * count, kConstant);
    constant_brdf.resize(2 * count);
    first_reflection.resize(2 * count);
    emission.resize(count);
    for (std::uint32_t side = 0; side < 2 * count; ++side) add_reflection(side);
    const auto reflectance_of = [&](std::uint32_t side) {
        const Material& material = material_of(side);
        return is_specular(material) ? 0 : reflectance_bound(material).luminance();
    };
    for (std::uint32_t patch = 0; patch < count; ++patch) {
        const double of_both = reflectance_of(patch) + reflectance_of(patches.other_side(patch));
        mean_reflectance += double{patches.areas_m2[patch]} * of_both / 2;
    }
    for (std::size_t light = 0; light < scene.lights.size(); ++light) add_emission(light);
    const double all_m2 = area_m2(patches);
    mean_reflectance /= all_m2;
    spacing_m = std::sqrt(all_m2 / static_cast<double>(count) / kRaysPerPatch);
}

void PatchTransport::add_reflection(std::uint32_t side) {
    const Material& material = material_of(side);
    if (is_specular(material) || material.is<Black>()) return;
    const auto* diffuse = material.get_if<Diffuse>();
    if (!diffuse) {
        glossy_number[side] = static_cast<std::uint32_t>(glossy_sides.size());
        glossy_sides.push_back(side);
        return;
    }
    constant_brdf[side] = to_float_rgb(diffuse->reflectance * std::numbers::inv_pi);
    if (first_shot.needs_position(side)) return;
    first_reflection[side] = to_float_rgb(
        first_shot.reflected(side, patches.middle(patches.patch_of(side)), {}, patches.normal_of(side)));
}

void PatchTransport::add_emission(std::size_t light) {
    const auto surface = lights::uniform_emission(scene.lights[light]);
    if (!surface || first_shot.replaces(light)) return;
    const std::size_t object = index_of(surface->object);
    for (std::uint32_t p = patches.first_of_object[object]; p < patches.first_of_object[object + 1]; ++p) {
        emission[p] = to_float_rgb(surface->luminance_cd_m2);
    }
}

Rgb PatchTransport::first_reflected(std::uint32_t side, const Vec3& out) const {
    if (reflects_alike(side)) return to_rgb(first_reflection[side]);
    if (first_shot.needs_position(side)) return {};
    return first_shot.reflected(side, patches.middle(patches.patch_of(side)), {}, out);
}

std::vector<std::optional<PatchLocation>> find_patch_locations(const patches::PatchCaster& caster,
                                                               std::span<const ViewedHit> points,
                                                               rays::Coherence coherence) {
    // The segment to the hit is free. So is a short stretch beyond it, where rays meet patches that protrude
    // from the true surface by rounding.
    constexpr double stretch = 1e-3;
    std::vector<std::optional<PatchLocation>> locations(points.size());
    for (std::size_t first = 0; first < points.size(); first += kPacketWidth) {
        const std::size_t count = std::min<std::size_t>(kPacketWidth, points.size() - first);
        RayPacket packet;
        LaneMask lanes{};
        for (std::size_t lane = 0; lane < count; ++lane) {
            const auto& [hit, outgoing] = points[first + lane];
            packet.set(lane, hit.position + (stretch * hit.distance_m) * outgoing - caster.patches().center,
                       -outgoing, std::numeric_limits<float>::infinity());
            lanes[lane] = -1;
        }
        const patches::PatchHits hits = caster.closest(packet, lanes, coherence);
        for (std::size_t lane = 0; lane < count; ++lane) {
            if (hits.sides[lane] == patches::kNoSide) continue;
            locations[first + lane] = PatchLocation{hits.sides[lane], hits.barycentric(lane)};
        }
    }
    return locations;
}

}  // namespace stilb::estimators
