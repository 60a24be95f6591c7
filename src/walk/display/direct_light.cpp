#include "walk/display/direct_light.h"

#include <algorithm>
#include <cmath>

#include "math/random.h"

namespace stilb::walk {
namespace {

using transport::direct_sample;

/// Points on a light with a surface, and on light from infinity, which is seen through small windows.
constexpr std::size_t kFewOnSurface = 16, kManyOnSurface = 64, kFewOutside = 64, kManyOutside = 256;
/// Shadow rays of a surface point, about, where there are many extended lights.
constexpr std::size_t kMostFew = 256, kLeastFew = 4;
/// Groups of points for a standard error.
constexpr std::size_t kGroups = 4;
/// Relative standard error for which few points suffice.
constexpr double kSmallError = 0.005;

}  // namespace

DirectLight::DirectLight(const Scene& scene, const rays::RayCaster& caster)
    : caster_(caster), sampler_(scene, caster) {
    const auto is_extended = [](const Light& light) { return location_of(light) != LightLocation::point; };
    const auto extended = static_cast<std::size_t>(std::ranges::count_if(scene.lights, is_extended));
    const std::size_t share = kMostFew / std::max<std::size_t>(extended, 1) / kLeastFew * kLeastFew;
    for (const Light& light : scene.lights) {
        const bool outside = location_of(light) == LightLocation::infinity;
        const std::size_t few = outside ? kFewOutside : std::clamp(share, kLeastFew, kFewOnSurface);
        efforts_.push_back({few, few * (kManyOnSurface / kFewOnSurface)});
    }
    for (std::size_t k = 0; k < kManyOutside; ++k)
        pattern_.push_back(math::SampleStream(math::RandomKey{1}, k).next_two());
}

double DirectLight::add(const SurfacePoint& point, double share, std::span<float> sums) const {
    double squared_error = 0;
    for (std::size_t light = 0; light < count(); ++light) {
        const Estimate estimate =
            sampler_.is_point(light) ? by_point_light(light, point) : by_extended_light(light, point);
        sums[light] += static_cast<float>(share * estimate.lx);
        squared_error += share * share * estimate.squared_error;
    }
    return squared_error;
}

DirectLight::Estimate DirectLight::by_point_light(std::size_t light, const SurfacePoint& point) const {
    const auto sample = direct_sample(sampler_.sample_incident(light, point, {}), point);
    if (!sample) return {};
    return {(sample->illuminance_lx * caster_.transmittance(sample->segment)).luminance()};
}

DirectLight::Estimate DirectLight::by_extended_light(std::size_t light, const SurfacePoint& point) const {
    const auto [few, many] = efforts_[light];
    const Estimate first = by_points(light, point, few);
    const double small = kSmallError * first.lx;
    if (!first.is_partly_hidden && first.squared_error <= small * small) return first;
    return by_points(light, point, many);
}

DirectLight::Estimate DirectLight::by_points(std::size_t light, const SurfacePoint& point,
                                             std::size_t points) const {
    std::vector<rays::Segment> segments;
    std::vector<Rgb> arriving_lx;
    std::vector<std::size_t> groups;
    for (std::size_t k = 0; k < points; ++k) {
        const auto sample = direct_sample(sampler_.sample_incident(light, point, pattern_[k]), point);
        if (!sample) continue;
        segments.push_back(sample->segment);
        arriving_lx.push_back(sample->illuminance_lx);
        groups.push_back(k * kGroups / points);
    }
    std::vector<Rgb> transmittances(segments.size());
    caster_.transmittances(segments, rays::Coherence::coherent, transmittances);
    std::array<double, kGroups> means{};
    std::size_t hidden = 0;
    for (std::size_t i = 0; i < segments.size(); ++i) {
        const double lx = (arriving_lx[i] * transmittances[i]).luminance();
        means[groups[i]] += lx * kGroups / static_cast<double>(points);
        hidden += transmittances[i].max() > 0 ? 0 : 1;
    }
    Estimate estimate{0, 0, hidden > 0 && hidden < segments.size()};
    for (const double mean : means) estimate.lx += mean / kGroups;
    for (const double mean : means)
        estimate.squared_error += (mean - estimate.lx) * (mean - estimate.lx) / (kGroups * (kGroups - 1));
    return estimate;
}

}  // namespace stilb::walk
