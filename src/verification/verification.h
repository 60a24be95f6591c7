// Estimators held against exact values.
#pragma once

#include <atomic>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "run/measure.h"
#include "verification/verification_cases.h"

namespace stilb::verification {

/// The |z| from which a reading contradicts the exact value.
inline constexpr double kContradictionZ = 4;
/// The share of a value by which sums in double precision may be off; counted as a standard error of its own,
/// so that readings that are made without sampling have a z too.
inline constexpr double kRounding = 1e-9;

struct CheckedReading {
    ExactReading exact;
    statistics::Estimate measured;
    double z = 0;  ///< of a normal deviate, whatever the number of replicates
};

/// What one method makes of one case.
struct Verification {
    std::string name, variant, method;  ///< of the case, of the estimator
    std::string_view unit;
    std::vector<CheckedReading> readings;
    StopReason stop_reason = StopReason::target_reached;
    double elapsed_s = 0;

    const CheckedReading& worst() const;  ///< the one with the largest |z|
    /// Of the readings' intervals, half, relative.
    double widest_interval() const;
    bool contradicts() const;
};

CheckedReading check(const ExactReading& exact, const statistics::Estimate& measured, int replicates);

/// Measures with `options`; the error asked for is met by every reading, not only by 95 % of them.
Verification verify(const VerificationCase& verification_case, const RunOptions& options,
                    ProgressSink* progress = nullptr, const std::atomic<bool>* interrupt = nullptr);

/// The chance that one of so many readings seems to contradict its exact value though none does.
double false_alarm_chance(std::size_t readings);

}  // namespace stilb::verification
