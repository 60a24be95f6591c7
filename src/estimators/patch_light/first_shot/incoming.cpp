#include "estimators/patch_light/first_shot/incoming.h"

#include <utility>

namespace stilb::estimators {

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
