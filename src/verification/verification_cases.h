// Scenes whose illuminance or luminance is known exactly, for `stilb verify`.
#pragma once

#include <numbers>
#include <string>
#include <vector>

#include "estimators/estimator_list.h"
#include "scene/scene.h"
#include "sensors/sensor.h"

namespace stilb::verification {

/// One reading and what it must be.
struct ExactReading {
    Measurand measurand;
    double value = 0;  ///< [lx] or [cd/m2]
    /// The share of it by which the tables of the scene's materials may be off, as docs/materials.md has it,
    /// or which too few samples bring for their errors to be known.
    double tolerance = 0;
};

struct VerificationCase {
    std::string name;     ///< of the exact solution; variants share it
    std::string variant;  ///< which one
    Scene scene;
    std::vector<ExactReading> readings;  ///< all of one quantity
    /// The one method to run; empty: all that measure the quantity.
    std::string only_method{};
    /// What the reader of the results has to know; variants share it.
    std::string note{};

    bool measures_luminance() const { return is_luminance(readings.front().measurand); }
    Quantity quantity() const { return measures_luminance() ? sensors::kLuminance : sensors::kIlluminance; }
    bool is_for(const estimators::EstimatorEntry& method) const;
};

std::vector<VerificationCase> verification_cases();

// The verification cases by the exact solutions that they are of.

std::vector<VerificationCase> sobolev_cases();
std::vector<VerificationCase> sphere_cases();
std::vector<VerificationCase> furnace_cases();
/// Elements lit by single sources.
std::vector<VerificationCase> source_cases();
/// Single sources that are looked at, straight, in a mirror and through a pane.
std::vector<VerificationCase> seen_source_cases();
/// Elements and things in light from infinity.
std::vector<VerificationCase> environment_cases();

// What the verification cases' scenes are made of.

/// Directions each turned by it against the last never line up.
inline constexpr double kGoldenAngle = 2 * std::numbers::pi * (2 - std::numbers::phi);

MaterialId add_material(Scene& scene, const Material& material);
ObjectId add_object(Scene& scene, const Shape& shape, const Material& material);
void add_area_light(Scene& scene, ObjectId object, double luminance_cd_m2);
/// Of the same luminance all around.
void add_environment(Scene& scene, double luminance_cd_m2);

inline Diffuse diffuse(double reflectance) { return {Rgb::grey(reflectance)}; }

/// `count` unit vectors spread evenly over the sphere: a Fibonacci spiral, from +z to -z.
std::vector<Vec3> spread_directions(int count);

}  // namespace stilb::verification
