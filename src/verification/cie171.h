// The analytical test cases of CIE 171:2006 for electric light, glass and diffuse reflection
// (docs/cie171.md), with exact values of our own: some of the published tables have misprints.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "run/run.h"
#include "scene/scene.h"
#include "sensors/sensor.h"
#include "verification/verification.h"

namespace stilb::verification {

/// A line of the table: a weighted sum of illuminances, mostly of one.
struct Cie171Row {
    struct Share {
        MeasuringPoint point;
        double weight = 1;
    };

    std::string point;
    std::vector<Share> shares;
    double exact = 0;
    double tolerance = 0;  ///< the share of it by which the scene or the exact value may be off
};

struct Cie171Case {
    std::string number, variant;
    std::string unit;
    Scene scene;
    std::vector<Cie171Row> rows;
    /// Instead of an error: not every reading of a sum needs to be exact.
    std::optional<std::uint64_t> paths{};
};

std::vector<Cie171Case> cie171_cases();

/// One reading for each row; without locations.
std::vector<CheckedReading> verify(const Cie171Case& verification_case, const RunOptions& options,
                                   ProgressSink* progress = nullptr,
                                   const std::atomic<bool>* interrupt = nullptr);

}  // namespace stilb::verification
