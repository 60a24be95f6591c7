// What is measured, with an error on every number.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "stilb/parameters.h"

namespace stilb::api {

/// A number and how sure it is. NaN where the method knows no error.
struct Estimate {
    double value = 0;
    double standard_error = 0;
    double lower = 0, upper = 0;  ///< 95 % interval
};

struct Reading : Estimate {
    Triple rgb{};       ///< linear Rec. 709, in the sensor's unit
    Triple position{};  ///< [m]
};

/// What one sensor has measured.
struct SensorResult {
    std::string name, type;
    std::string quantity, unit;  ///< such as "illuminance", "lx"
    std::vector<Reading> readings;
    Estimate mean, minimum, maximum;
    Estimate uniformity;        ///< minimum / mean
    double attained_error = 0;  ///< relative half-width that 95 % of the readings keep
};

/// How a run went.
struct Summary {
    std::string method;
    std::uint64_t seed = 0, samples = 0;
    double elapsed_s = 0;
    /// False where an error was asked for and is not met, or the run was interrupted.
    bool converged = true;
    double attained_error = 0;
    std::vector<std::string> warnings;
};

struct Result : Summary {
    std::vector<SensorResult> sensors;
    /// The document of `stilb measure --json` (docs/json.md).
    std::string json;

    /// Throws InputError where no sensor has the name.
    const SensorResult& operator[](std::string_view sensor) const;
};

}  // namespace stilb::api
