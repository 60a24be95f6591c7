#include "verification/verification.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "statistics/hypothesis.h"

namespace stilb::verification {

namespace {

struct SensorOf {
    Sensor operator()(const MeasuringPoint& point) const { return {"", IlluminancePoints{{point}}}; }
    Sensor operator()(const BodyPoint&) const { throw std::logic_error("no case has bodies"); }
    Sensor operator()(const LineOfSight& sight) const { return {"", Luminance{{sight}}}; }
    Sensor operator()(const EmergentRay& ray) const { return {"", Luminance{{ray}}}; }
};

}  // namespace

const CheckedReading& Verification::worst() const {
    return *std::max_element(readings.begin(), readings.end(),
                             [](const auto& a, const auto& b) { return std::abs(a.z) < std::abs(b.z); });
}

double Verification::widest_interval() const {
    double widest = 0;
    for (const CheckedReading& reading : readings) {
        widest = std::max(widest, relative_half_width(reading.measured));
    }
    return widest;
}

bool Verification::contradicts() const { return !(std::abs(worst().z) < kContradictionZ); }

CheckedReading check(const ExactReading& exact, const statistics::Estimate& measured, int replicates) {
    statistics::Estimate estimate = measured;
    estimate.standard_error = std::hypot(measured.standard_error, kRounding * exact.value);
    const double off = exact.tolerance * exact.value;
    const double nearest = std::clamp(measured.value, exact.value - off, exact.value + off);
    return {exact, measured, statistics::equivalent_z(z_score(estimate, nearest), replicates - 1)};
}

Verification verify(const VerificationCase& verification_case, const RunOptions& options,
                    ProgressSink* progress, const std::atomic<bool>* interrupt) {
    std::vector<Sensor> sensors;  // one for each reading: a run's target is met by 95 % of each sensor's
    for (const ExactReading& reading : verification_case.readings) {
        sensors.push_back(std::visit(SensorOf{}, reading.measurand));
    }
    const RunResult measured = run::measure(verification_case.scene, sensors, options, progress, interrupt);
    Verification result{verification_case.name,
                        verification_case.variant,
                        options.method,
                        verification_case.quantity().unit,
                        {},
                        measured.stop_reason,
                        measured.elapsed_s};
    for (std::size_t j = 0; j < sensors.size(); ++j) {
        result.readings.push_back(check(verification_case.readings[j],
                                        measured.sensors[j].readings[0].estimate, measured.replicates));
    }
    return result;
}

double false_alarm_chance(std::size_t readings) {
    return 1 - std::pow(1 - statistics::two_sided_p_of_z(kContradictionZ), static_cast<double>(readings));
}

}  // namespace stilb::verification
