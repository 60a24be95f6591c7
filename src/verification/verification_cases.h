// Scenes whose illuminance or luminance is known exactly, for `stilb verify`.
#pragma once

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

}  // namespace stilb::verification
