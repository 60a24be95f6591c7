// Measurements of a scene by one method, and how far apart two of them are.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "random/draft.h"
#include "random/forms.h"
#include "statistics/interval.h"

namespace stilb::random {

/// Two values disagree beyond so many standard errors: at 1e5 comparisons the largest deviate exceeds 5.2
/// once in fifty times.
inline constexpr double kThresholdZ = 5.5;

/// What a run keeps apart; its readings are put together again.
enum class Apart {
    nothing,
    lights,      ///< the sum of what all lights give
    bounces,     ///< the sum over all numbers of reflections
    light_scene  ///< of a scene with other factors, the light scene that takes them back
};

/// How a scene is measured.
struct Setting {
    std::string method;
    Form form = Form::as_it_is;
    std::uint64_t seed = 1;
    std::uint64_t work = 1;  ///< a factor on the samples
    Apart apart = Apart::nothing;

    std::string words() const;
};

struct MeasuredReading {
    std::string name;
    statistics::Estimate estimate;  ///< [lx or cd/m2], as in the scene as it is
    int replicates = 0;             ///< 0: the value is exact
};

struct Measured {
    std::vector<MeasuredReading> readings;
    bool is_on_patches = false;  ///< which biases the readings by their size
    std::vector<std::string> warnings;
    std::string refusal;  ///< the message where the scene was refused
};

/// `folder`: of the files that the scene refers to.
Measured measure(const Draft& draft, const Setting& setting, const std::filesystem::path& folder);

/// Two values of one reading.
struct Difference {
    std::size_t reading = 0;
    double z = 0;  ///< as a normal deviate
    double value = 0, other = 0, value_error = 0, other_error = 0;

    bool is_real() const { return z > kThresholdZ; }
};

/// The readings that differ most; by the intervals that are printed, which allow for rare light.
Difference worst_difference(const Measured& a, const Measured& b);
Difference worst_difference(const Measured& a, const std::vector<double>& exact);

}  // namespace stilb::random
