#include "walk/service/spot_measurement.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>

#include "base/monitor.h"
#include "run/run.h"
#include "sensors/sensor.h"
#include "stilb/error.h"
#include "walk/service/requests.h"

namespace stilb::walk {
namespace {

constexpr double kError = 0.01, kTime_s = 2;
/// A light with a smaller factor is off.
constexpr double kLeastFactor = 1e-9;

std::vector<LightFactor> factors_of(const nlohmann::json& request) {
    std::vector<LightFactor> factors;
    const auto given = request.find("factors");
    if (given == request.end()) return factors;
    if (!given->is_object())
        throw InputError("\"factors\" must be an object of names of light groups and numbers.");
    for (const auto& [name, factor] : given->items()) factors.push_back({name, factor_of(factor, name)});
    return factors;
}

Sensor sensor_of(const Measurand& measurand) {
    constexpr const char* name = "here";
    if (const auto* point = std::get_if<MeasuringPoint>(&measurand))
        return {name, sensors::IlluminancePoints{{*point}}};
    return {name, sensors::Luminance{{measurand}}};
}

}  // namespace

SpotRequest read_spot_request(std::string_view json) {
    const nlohmann::json request = parse_request(json);
    const std::string_view kind = text_of(request, "kind");
    const bool is_luminance = kind == "luminance";
    if (!is_luminance && kind != "illuminance")
        throw InputError("\"kind\" must be \"illuminance\" or \"luminance\".");
    const std::string_view direction = is_luminance ? "direction" : "normal";
    require_members(request, std::array<std::string_view, 4>{"kind", "position", direction, "factors"},
                    "The request");
    const Vec3 position = position_of(request, "position");
    const Vec3 unit = direction_of(request, direction);
    if (is_luminance) return {LineOfSight{position, unit}, factors_of(request)};
    return {MeasuringPoint{position, unit}, factors_of(request)};
}

std::string to_json(const SpotReading& reading) {
    // A half-width that is not known is null.
    return nlohmann::ordered_json{{"value", reading.value},
                                  {"half_width", reading.half_width},
                                  {"unit", reading.unit},
                                  {"time_s", reading.time_s},
                                  {"method", "auto"}}
        .dump();
}

Scene with_factors(const Scene& scene, const LightGroups& groups, std::span<const Rgb> factors) {
    Scene changed = scene;
    changed.lights.clear();
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        const Rgb& factor = factors[groups.of_light[i]];
        Light light = scene.lights[i];
        if (factor.max() < kLeastFactor) continue;
        if (factor != Rgb::grey(1)) light.source = lights::scaled(light.source, factor);
        changed.lights.push_back(std::move(light));
    }
    return changed;
}

SpotMeter::SpotMeter(const Scene& scene, const RunOptions& options)
    : scene_(scene), groups_(scene::light_groups(scene)) {
    options_.seed = options.seed;
    options_.threads = options.threads;
    options_.error = kError;
    options_.checks = run::Checks::refusals;
    options_.time_s = kTime_s;
}

const run::PreparedScene& SpotMeter::lit_by(std::span<const LightFactor> factors) {
    std::vector<Rgb> of_groups = scene::factors_of_groups(factors, groups_.names);
    if (std::ranges::all_of(of_groups, [](const Rgb& factor) { return factor == Rgb::grey(1); }))
        return scene_;
    if (!relit_ || relit_->factors != of_groups)
        relit_ = std::make_unique<const Relit>(scene_, groups_, std::move(of_groups));
    return relit_->prepared;
}

SpotReading SpotMeter::measure(const SpotRequest& request) {
    constexpr std::chrono::milliseconds glance{50};
    constexpr int most_glances = 80;
    std::unique_lock lock(mutex_, std::defer_lock);
    for (int glances = 0; !is_cancelled_ && glances < most_glances && !lock.try_lock_for(glance);) ++glances;
    if (is_cancelled_) throw Cancelled("Stilb is ending.");
    if (!lock) throw Cancelled("Other measurements are running. Try again in some seconds.");

    const std::array sensors{sensor_of(request.measurand)};
    const run::PreparedScene& scene = lit_by(request.factors);
    // The first measurement builds the acceleration structure, which may take longer than the run.
    scene.caster(sensors::measured_points(sensors), Monitor(&is_cancelled_, std::nullopt, {}));
    const RunResult result = run::measure(scene, sensors, options_, nullptr, &is_cancelled_);
    const statistics::Estimate& estimate = result.sensors.front().readings.front().estimate;
    return {estimate.value, std::max(estimate.upper - estimate.value, estimate.value - estimate.lower),
            sensors.front().quantity().unit, result.elapsed_s};
}

}  // namespace stilb::walk
