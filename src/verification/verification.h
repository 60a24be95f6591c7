// Comparison of estimators with exact values.
#pragma once

#include <atomic>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "estimators/estimator_list.h"
#include "exact/sobolev.h"
#include "materials/diffuse.h"
#include "run/run.h"
#include "scene/scene.h"
#include "sensors/sensor.h"

namespace stilb::verification {

// Scenes with exactly known illuminance or luminance, for `stilb verify`.

/// One reading and its exact value.
struct ExactReading {
    Measurand measurand;
    double value = 0;  ///< [lx] or [cd/m2]
    /// The share of it by which the tables of the scene's materials may be off, as stated in
    /// docs/materials.md, or by which too few samples leave the errors unknown.
    double tolerance = 0;
};

struct VerificationCase {
    std::string name;     ///< of the exact solution; variants share it
    std::string variant;  ///< variant of the solution
    Scene scene;
    std::vector<ExactReading> readings;  ///< all of one quantity
    /// The one method to run; empty: all methods for the quantity.
    std::string only_method{};
    /// An explanation for the reader of the results; variants share it.
    std::string note{};

    bool measures_luminance() const { return is_luminance(readings.front().measurand); }
    Quantity quantity() const { return measures_luminance() ? sensors::kLuminance : sensors::kIlluminance; }
    bool is_for(const estimators::EstimatorEntry& method) const;
};

std::vector<VerificationCase> verification_cases();

/// The |z| above which a reading contradicts the exact value.
inline constexpr double kContradictionZ = 4;
/// The share of a value by which sums in double precision may be off; it counts as an additional standard
/// error, so that readings computed without sampling have a z, too.
inline constexpr double kRounding = 1e-9;

struct CheckedReading {
    ExactReading exact;
    statistics::Estimate measured;
    double z = 0;  ///< as a normal deviate, for any number of replicates

    bool contradicts() const { return !(std::abs(z) < kContradictionZ); }
};

/// The result of one method for one case.
struct Verification {
    std::string name, variant, method;  ///< of the case, of the estimator
    std::string_view unit;
    std::vector<CheckedReading> readings;
    StopReason stop_reason = StopReason::target_reached;
    double elapsed_s = 0;

    const CheckedReading& worst() const;  ///< the one with the largest |z|
    /// The relative half-width of the readings' widest interval.
    double widest_interval() const;
    bool contradicts() const;
};

/// Whether a measured value contradicts the exact one. `patch_error`: the part of the measured interval that
/// stands for the bias of patches, on each side; nothing within it is a contradiction.
CheckedReading check(const ExactReading& exact, const statistics::Estimate& measured, int replicates,
                     double patch_error = 0);

/// Measures with `options`; every reading meets the requested error, not only 95 % of them.
Verification verify(const VerificationCase& verification_case, const RunOptions& options,
                    ProgressSink* progress = nullptr, const std::atomic<bool>* interrupt = nullptr);

/// The probability that one of so many readings seems to contradict its exact value though none does.
double false_alarm_chance(std::size_t readings);

// The verification cases, grouped by their exact solutions.

std::vector<VerificationCase> sobolev_cases();
std::vector<VerificationCase> sphere_cases();
std::vector<VerificationCase> furnace_cases();
/// Elements lit by single sources.
std::vector<VerificationCase> source_cases();
/// Single sources seen directly, in a mirror and through a pane.
std::vector<VerificationCase> seen_source_cases();
/// Elements and objects in light from infinity.
std::vector<VerificationCase> environment_cases();

// Building blocks of the verification cases' scenes.

MaterialId add_material(Scene& scene, const Material& material);
ObjectId add_object(Scene& scene, const Shape& shape, const Material& material);
void add_area_light(Scene& scene, ObjectId object, double luminance_cd_m2);
/// Light from infinity with constant luminance.
void add_environment(Scene& scene, double luminance_cd_m2);

inline Diffuse diffuse(double reflectance) { return {Rgb::grey(reflectance)}; }

/// `count` unit vectors spread evenly over the sphere: a Fibonacci spiral, from +z to -z.
std::vector<Vec3> spread_directions(int count);

// Sobolev's problem as a scene: finite planes replace the infinite ones.

/// The largest share of the exact illuminance that the finite planes may lose.
inline constexpr double kLargestTruncation = 2e-4;

/// Plane 1 is z = 0 and plane 2 above it; the source is on the z axis. `largest_radius_m`: up to there the
/// planes' finite size costs less than kLargestTruncation of the illuminance on either plane.
Scene make_sobolev_scene(const exact::ParallelPlanes& planes, double largest_radius_m);

/// The point of a plane at `radius_m` from the axis, in the direction of the azimuth.
MeasuringPoint sobolev_point(const exact::ParallelPlanes& planes, exact::Plane plane, double radius_m,
                             double azimuth_rad);

}  // namespace stilb::verification
