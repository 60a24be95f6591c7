// How far a material's reflection is from a diffuse one's, for materials without a closed expression.
#pragma once

#include <numbers>

#include "base/vec.h"
#include "materials/scatter_sample.h"

namespace stilb::materials {

/// pi f / albedo at normal incidence, averaged over the reflected light: 1 for a diffuse material, large for
/// a narrow lobe, 0 where nothing is reflected. By an even grid of samples; to a few per cent.
template <typename Material>
double concentration_at_normal_incidence(const Material& material) {
    constexpr int kSteps = 96;
    const Vec3 in{0, 0, 1};
    double reflected = 0, squared = 0;
    for (int i = 0; i < kSteps; ++i) {
        for (int j = 0; j < kSteps; ++j) {
            const auto sample = material.sample(in, (i + 0.5) / kSteps, (j + 0.5) / kSteps);
            if (!sample) continue;
            const double weight = sample->weight.luminance() / (kSteps * kSteps);
            reflected += weight;
            squared += weight * std::numbers::pi * material.brdf_per_sr(in, sample->direction).luminance();
        }
    }
    return reflected > 0 ? squared / (reflected * reflected) : 0;
}

}  // namespace stilb::materials
