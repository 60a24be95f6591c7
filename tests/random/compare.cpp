#include "random/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "estimators/estimator_list.h"
#include "io/scene/scene_file.h"
#include "run/run.h"
#include "statistics/hypothesis.h"
#include "stilb/error.h"

namespace stilb::random {
namespace {

constexpr int kReplicates = 16, kPictures = 8;
/// What rounding may do to a reading, relative to it.
constexpr double kRounding = 2e-4;
/// What patches may do to a reading: they must be wrong by a factor to count here.
constexpr double kOfPatches = 0.3, kOfPatchesOfLargest = 0.1;
/// The same, relative to the largest reading of the scene.
constexpr double kRoundingOfLargest = 1e-7;

/// Samples of the first comparison: about as much processor time by each method.
std::uint64_t samples_of(const std::string& method, std::size_t readings) {
    if (method == "path") return std::max<std::uint64_t>(256, 16384 / std::max<std::size_t>(readings, 8));
    if (method == "guided") return 64;
    if (method == "auto") return 2048;
    if (method == "ray-bundle") return 512;
    if (method == "radiosity") return 32;
    if (method == "particles") return 131'072;
    return 8192;
}

/// The standard error in the direction of the other value, with what the interval adds for rare light.
double error_towards(const MeasuredReading& reading, double other) {
    if (reading.replicates == 0) return 0;
    const statistics::Estimate& estimate = reading.estimate;
    const double half =
        other > estimate.value ? estimate.upper - estimate.value : estimate.value - estimate.lower;
    return std::max(estimate.standard_error,
                    half / statistics::student_t_quantile(0.975, reading.replicates - 1));
}

double largest_of(const Measured& measured) {
    double largest = 0;
    for (const MeasuredReading& reading : measured.readings)
        if (std::isfinite(reading.estimate.value))
            largest = std::max(largest, std::abs(reading.estimate.value));
    return largest;
}

/// Welch's t as a normal deviate; rounding counts as an error that is known.
Difference difference(const MeasuredReading& a, const MeasuredReading& b, double largest, bool on_patches) {
    Difference result;
    result.value = a.estimate.value;
    result.other = b.estimate.value;
    result.value_error = error_towards(a, result.other);
    result.other_error = error_towards(b, result.value);
    if (!std::isfinite(result.value + result.other + result.value_error + result.other_error)) {
        // UGR before a background that may be black is only known to be above a bound.
        const bool overlap = !(a.estimate.lower > b.estimate.upper) && !(b.estimate.lower > a.estimate.upper);
        result.z = overlap ? 0 : std::numeric_limits<double>::infinity();
        return result;
    }
    const double larger = std::max(std::abs(result.value), std::abs(result.other));
    const double rounding = on_patches ? (kOfPatches * larger + kOfPatchesOfLargest * largest) / kThresholdZ
                                       : kRounding * larger + kRoundingOfLargest * largest;
    double all = rounding * rounding, squares = 0;
    for (const auto& [error, replicates] :
         {std::pair{result.value_error, a.replicates}, {result.other_error, b.replicates}}) {
        const double variance = error * error;
        all += variance;
        if (replicates > 1) squares += variance * variance / (replicates - 1);
    }
    if (all == 0) return result;
    const double freedom = squares > 0 ? all * all / squares : 1e6;
    result.z = std::abs(statistics::equivalent_z((result.value - result.other) / std::sqrt(all),
                                                 static_cast<int>(std::clamp(freedom, 1.0, 1e6))));
    return result;
}

void add(Measured& measured, const std::string& name, statistics::Estimate estimate, int replicates,
         double factor) {
    for (double* const number : {&estimate.value, &estimate.standard_error, &estimate.lower, &estimate.upper})
        *number *= factor;
    measured.readings.push_back({name, estimate, replicates});
}

/// A light scene with a factor of its own for each light, and the one that takes it back.
std::array<LightScene, 2> dimming(const Scene& scene, Draw& draw) {
    std::array<LightScene, 2> scenes;
    for (const Light& light : scene.lights) {
        const double factor = std::exp(draw.between(-2, 2));
        scenes[0].factors.push_back({light.name, Rgb::grey(factor)});
        scenes[1].factors.push_back({light.name, Rgb::grey(1 / factor)});
    }
    return scenes;
}

/// The scene and the options by which light is kept apart.
void keep_apart(Apart apart, Draw& draw, Scene& scene, RunOptions& options) {
    if (apart == Apart::lights) options.by = "light";
    if (apart == Apart::bounces) options.by = "bounce";
    if (apart != Apart::light_scene) return;
    auto [dimmed, back] = dimming(scene, draw);
    scene = scene::lit(std::move(scene), dimmed);
    options.light_scenes = {std::move(back)};
}

/// The whole reading by its shares, with the interval of the whole.
statistics::Estimate put_together(const SensorResult& sensor, std::size_t reading) {
    statistics::Estimate estimate = sensor.readings[reading].estimate;
    if (sensor.shares.empty()) return estimate;
    double sum = 0;
    for (const run::Share& share : sensor.shares) sum += share.readings[reading].value;
    const double shift = sum - estimate.value;
    for (double* const number : {&estimate.value, &estimate.lower, &estimate.upper}) *number += shift;
    return estimate;
}

/// The mean luminance of pictures with several seeds.
void add_picture(Measured& measured, const Scene& scene, const Sensor& camera, RunOptions options,
                 double factor) {
    options.paths = 4 * std::max<std::uint64_t>(1, *options.paths / 2048);
    std::vector<double> means;
    for (int i = 0; i < kPictures; ++i) {
        const RenderResult picture = run::render(scene, camera, options);
        means.push_back(picture.mean_luminance_cd_m2);
        options.seed += 1'000'003;
        if (i > 0) continue;
        std::ranges::move(texts_of(picture.warnings), std::back_inserter(measured.warnings));
    }
    add(measured, camera.name + " mean", statistics::estimate_from_replicates(means), kPictures, factor);
}

}  // namespace

std::string Setting::words() const {
    std::string text = method;
    if (form != Form::as_it_is) text += fmt::format(", {}", random::words(form));
    constexpr std::array words{"", ", by light", ", by bounce", ", in a light scene"};
    return text + words[static_cast<std::size_t>(apart)];
}

Measured measure(const Draft& draft, const Setting& setting, const std::filesystem::path& folder) {
    Measured measured;
    Draw draw(setting.seed, 0);
    const std::optional<OtherForm> other = in_form(draft, setting.form, draw);
    if (!other) {
        measured.refusal = "the form does not apply";
        return measured;
    }
    measured.is_on_patches = estimators::find_estimator(setting.method).lights_patches;
    try {
        io::SceneFile file = io::read_scene(other->draft.document(), "random scene", folder);
        std::size_t readings = 0;
        for (const Sensor& sensor : file.sensors) readings += sensor.size();
        RunOptions options = file.run;
        options.method = setting.method;
        options.seed = setting.seed;
        options.paths = setting.work * samples_of(setting.method, readings);
        options.replicates = kReplicates;
        options.threads = 1;
        keep_apart(setting.apart, draw, file.scene, options);
        if (readings > 0) {
            const RunResult result = run::measure(file.scene, file.sensors, options);
            measured.warnings = texts_of(result.warnings);
            const bool is_lit = setting.apart == Apart::light_scene;
            for (const SensorResult& sensor : is_lit ? result.light_scenes.front().sensors : result.sensors) {
                // The order of an area's points depends on the direction of its edges.
                if (std::holds_alternative<Area>(sensor.sensor.kind)) {
                    add(measured, sensor.sensor.name + " mean", sensor.summary.mean, kReplicates,
                        other->factor);
                    continue;
                }
                for (std::size_t i = 0; i < sensor.readings.size(); ++i)
                    add(measured, fmt::format("{} reading {}", sensor.sensor.name, i),
                        put_together(sensor, i), kReplicates, other->factor);
            }
        }
        options.replicates.reset();
        for (const Sensor& sensor : file.sensors) {
            if (std::holds_alternative<Camera>(sensor.kind) && setting.method != "local" &&
                setting.apart == Apart::nothing)
                add_picture(measured, file.scene, sensor, options, other->factor);
        }
    } catch (const InputError& error) {
        measured.refusal = error.what();
    }
    return measured;
}

Difference worst_difference(const Measured& a, const Measured& b) {
    const double largest = std::max(largest_of(a), largest_of(b));
    Difference worst;
    for (std::size_t i = 0; i < std::min(a.readings.size(), b.readings.size()); ++i) {
        Difference found =
            difference(a.readings[i], b.readings[i], largest, a.is_on_patches || b.is_on_patches);
        found.reading = i;
        if (!(found.z <= worst.z)) worst = found;
    }
    return worst;
}

Difference worst_difference(const Measured& a, const std::vector<double>& exact) {
    Measured known;
    for (const double value : exact) known.readings.push_back({"", {value, 0, value, value}, 0});
    return worst_difference(a, known);
}

}  // namespace stilb::random
