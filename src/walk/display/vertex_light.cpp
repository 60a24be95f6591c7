#include "walk/display/vertex_light.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "estimators/patch_light/first_shot/shadow_rays.h"

namespace stilb::walk {
namespace {

/// How far samples are moved, as a share of the way; where all are covered, the next one is tried.
constexpr std::array<double, 6> kMoves{0.007, 0.2, 0.4, 0.6, 0.8, 0.97};
/// The distance of surfaces that touch, as a share of the scene's extent: 1.5 mm in a room of 6 m.
constexpr double kHair = 1. / 4000;
/// The least cosine between normals of triangles in one plane.
constexpr double kFlat = 1 - 1e-6;

}  // namespace

VertexLight::VertexLight(const Scene& scene, const rays::RayCaster& caster, const patches::Patches& patches,
                         const DirectLight& direct)
    : scene_(scene),
      caster_(caster),
      patches_(patches),
      direct_(direct),
      hair_m_(2 * kHair * caster.half_extent_m()),
      is_reached_(2 * scene.objects.size(), true) {}

VertexLight::Result VertexLight::at(const Vec3& position, const Vec3& normal,
                                    std::span<const Adjoining> around, std::span<float> lx) const {
    std::vector<Sample> free;
    for (const double share : kMoves) {
        free = free_samples(position, normal, around, share);
        if (free.empty()) continue;
        if (free.size() == around.size() && !are_divided(free)) free.resize(1);
        break;
    }
    Result result{0, free.empty()};
    for (const Sample& sample : free)
        result.squared_error += direct_.add(sample.point, 1 / static_cast<double>(free.size()), lx);
    return result;
}

std::vector<VertexLight::Sample> VertexLight::free_samples(const Vec3& position, const Vec3& normal,
                                                           std::span<const Adjoining> around,
                                                           double share) const {
    std::vector<Sample> samples;
    for (const auto& [towards, side] : around) {
        const Vec3 moved = position + share * (towards - position);
        const Vec3 lifted = estimators::lifted_off(scene_, patches_, caster_, side, moved);
        const Sample sample{{lifted, normal}, side};
        if (!is_covered(sample)) samples.push_back(sample);
    }
    return samples;
}

bool VertexLight::is_covered(const Sample& sample) const {
    const auto hit = caster_.closest(sample.point.lifted, patches_.normal_of(sample.side));
    return hit &&
           (hit->distance_m < hair_m_ || !is_reached_[ObjectSide{hit->object, hit->on_front}.number()]);
}

bool VertexLight::are_divided(std::span<const Sample> samples) const {
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const Sample &a = samples[i], &b = samples[(i + 1) % samples.size()];
        const bool in_one_plane = dot(patches_.normal_of(a.side), patches_.normal_of(b.side)) > kFlat;
        if (in_one_plane && caster_.occluded(a.point.lifted, b.point.lifted)) return true;
    }
    return false;
}

}  // namespace stilb::walk
