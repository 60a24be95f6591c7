// Scenes whose illuminance is known exactly, for `stilb verify`.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"
#include "sensors/sensor.h"

namespace stilb {

/// One reading and what it must be.
struct ExactReading {
    MeasuringPoint point;
    double illuminance_lx = 0;
};

struct VerificationCase {
    std::string name;     ///< of the exact solution; variants share it
    std::string variant;  ///< which one
    Scene scene;
    std::vector<ExactReading> readings;
    /// The one method to run; empty: all.
    std::string only_method{};
    /// What the reader of the results has to know; variants share it.
    std::string note{};
};

std::vector<VerificationCase> verification_cases();

}  // namespace stilb
