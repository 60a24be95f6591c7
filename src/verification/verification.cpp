
#include "verification/verification.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

#include "math/sampling.h"
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

bool Verification::contradicts() const { return worst().contradicts(); }

CheckedReading check(const ExactReading& exact, const statistics::Estimate& measured, int replicates,
                     double patch_error) {
    statistics::Estimate estimate = measured;
    estimate.standard_error = std::hypot(measured.standard_error, kRounding * exact.value);
    const double off = exact.tolerance * exact.value + patch_error;
    const double nearest = std::clamp(measured.value, exact.value - off, exact.value + off);
    return {exact, measured, statistics::equivalent_z(z_score(estimate, nearest), replicates - 1)};
}

Verification verify(const VerificationCase& verification_case, const RunOptions& options,
                    ProgressSink* progress, const std::atomic<bool>* interrupt) {
    std::vector<Sensor>
        sensors;  // one for each reading, because a run's target is met by 95 % of each sensor's readings
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
        const Reading& reading = measured.sensors[j].readings[0];
        result.readings.push_back(check(verification_case.readings[j], reading.estimate, measured.replicates,
                                        reading.patch_error.value_or(0)));
    }
    return result;
}

double false_alarm_chance(std::size_t readings) {
    return 1 - std::pow(1 - statistics::two_sided_p_of_z(kContradictionZ), static_cast<double>(readings));
}

bool VerificationCase::is_for(const estimators::EstimatorEntry& method) const {
    if (!only_method.empty()) return method.name == only_method;
    // At points double-local is local.
    return measures_luminance() ? method.measures_luminance : method.name != "double-local";
}

std::vector<VerificationCase> verification_cases() {
    std::vector<VerificationCase> all;
    for (const auto family :
         {sobolev_cases, sphere_cases, furnace_cases, source_cases, seen_source_cases, environment_cases}) {
        std::vector<VerificationCase> cases = family();
        all.insert(all.end(), std::make_move_iterator(cases.begin()), std::make_move_iterator(cases.end()));
    }
    return all;
}

MaterialId add_material(Scene& scene, const Material& material) {
    const auto number = static_cast<std::uint32_t>(scene.materials.size());
    scene.materials.push_back({fmt::format("material {}", number + 1), material});
    return MaterialId{number};
}

ObjectId add_object(Scene& scene, const Shape& shape, const Material& material) {
    const auto number = static_cast<std::uint32_t>(scene.objects.size());
    scene.objects.push_back({fmt::format("object {}", number + 1), shape, {add_material(scene, material)}});
    return ObjectId{number};
}

void add_area_light(Scene& scene, ObjectId object, double luminance_cd_m2) {
    scene.lights.push_back({"light", AreaLight{object, Rgb::grey(luminance_cd_m2)}});
}

void add_environment(Scene& scene, double luminance_cd_m2) {
    scene.lights.push_back({"environment", EnvironmentLight{Rgb::grey(luminance_cd_m2)}});
}

std::vector<Vec3> spread_directions(int count) {
    std::vector<Vec3> directions;
    for (int i = 0; i < count; ++i) {
        const double z = 1 - (2 * i + 1.0) / count;
        const double radius = std::sqrt(1 - z * z);
        directions.push_back(
            {radius * std::cos(i * math::kGoldenAngle), radius * std::sin(i * math::kGoldenAngle), z});
    }
    return directions;
}

}  // namespace stilb::verification
