// What the tests of the two luminaire readers share.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "io/photometry/photometry_file.h"
#include "stilb/error.h"
#include "support/source_directory.h"

namespace stilb::photometry_test {

inline constexpr double kDegree = std::numbers::pi / 180;

/// Expects `action` to throw an InputError whose message has `part` in it.
inline void expect_message(const std::function<void()>& action, const std::string& part) {
    try {
        action();
        ADD_FAILURE() << "accepted, expected: " << part;
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find(part), std::string::npos)
            << "found: " << error.what() << "\nexpected: " << part;
    }
}

/// `text` with its only occurrence of `from` replaced.
inline std::string with(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    EXPECT_EQ(text.find(from, at + 1), std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

/// Towards plane C and angle gamma, in the luminaire's frame.
inline Vec3 towards(double c_deg, double gamma_deg) {
    const double c = c_deg * kDegree, gamma = gamma_deg * kDegree;
    return {std::sin(gamma) * std::cos(c), std::sin(gamma) * std::sin(c), std::cos(gamma)};
}

/// The flux of a solid by the midpoint rule.
inline double midpoint_flux(const PhotometricSolid& solid) {
    constexpr int kPlanes = 360, kRings = 1440;
    double sum = 0;
    for (int i = 0; i < kRings; ++i) {
        const double gamma = (i + 0.5) * 180 / kRings;
        for (int k = 0; k < kPlanes; ++k) {
            sum += solid.intensity_cd(towards((k + 0.5) * 360 / kPlanes, gamma)) * std::sin(gamma * kDegree);
        }
    }
    return sum * (360 * kDegree / kPlanes) * (180 * kDegree / kRings);
}

inline std::filesystem::path shared_photometry() { return source_directory() / "../shared/data/photometry"; }

}  // namespace stilb::photometry_test
