#include "random/check.h"

#include <algorithm>
#include <chrono>

namespace stilb::random {
namespace {

constexpr std::uint64_t kMoreWork = 16;

/// With so many times the samples, no rare light explains a value below this share of the other; only light
/// that local estimation as published finds rarely does.
constexpr double kLeastExplained = 0.5;
/// Seconds of processor time for the reduction of a scene.
constexpr double kReductionSeconds = 15;

bool contains(const std::string& text, const char* words) { return text.find(words) != std::string::npos; }

/// Whether a warning says that values of this sensor may be too low by more than their errors: rare light.
bool explains(const std::string& warning, const std::string& sensor) {
    return contains(warning, "sharply, and few samples find such light") ||
           (contains(warning, "a few rare light paths make up much of the light") &&
            contains(warning, ('"' + sensor + '"').c_str()));
}

/// Whether a method says that it cannot compute all light of a scene: point lamps and mirrors.
bool is_incomplete(const Measured& measured) {
    return std::ranges::any_of(measured.warnings, [](const std::string& warning) {
        return contains(warning, "path tracing cannot find light") ||
               contains(warning, "local estimation cannot find light");
    });
}

/// Local estimation as published has infinite variance in corners, and a very large one above a large ground:
/// its values are too low, and seldom far too high.
bool has_heavy_tails(const Setting& setting) {
    return setting.method == "local" || setting.method == "double-local";
}

/// One comparison of a scene.
class Comparison {
  public:
    /// `exact`: the scene whose exact values are compared with; null where they are those of the reference
    /// method.
    Comparison(Setting setting, std::string reference, const RandomScene* exact, const Options& options)
        : setting_(std::move(setting)), reference_(std::move(reference)), exact_(exact), options_(options) {}

    /// The largest difference, and the measurement.
    struct Outcome {
        Difference difference;
        Measured measured;
        std::vector<std::string> warnings;           ///< of both
        std::vector<std::string> warnings_of_lower;  ///< of the measurement that gave the lower value
    };
    Outcome of(const Draft& draft, const Measured* reference, std::uint64_t work, std::uint64_t seed) const {
        Setting setting = setting_;
        setting.work = work;
        setting.seed = seed;
        Outcome outcome;
        outcome.measured = measure(draft, setting, options_.folder);
        outcome.warnings = outcome.measured.warnings;
        if (exact_) {
            outcome.difference = worst_difference(outcome.measured, exact_->exact);
            outcome.warnings_of_lower = outcome.warnings;
            if (!exact_->may_be_twice) return outcome;
            ExactValues twice = exact_->exact;
            for (double& value : twice) value *= 2;
            const Difference of_twice = worst_difference(outcome.measured, twice);
            if (of_twice.z < outcome.difference.z) outcome.difference = of_twice;
            return outcome;
        }
        Measured own;
        if (!reference) {
            own = measure(draft, {reference_, Form::as_it_is, seed + 1, work}, options_.folder);
            reference = &own;
        }
        outcome.difference = worst_difference(outcome.measured, *reference);
        outcome.warnings_of_lower = outcome.difference.value < outcome.difference.other
                                        ? outcome.measured.warnings
                                        : reference->warnings;
        std::ranges::copy(reference->warnings, std::back_inserter(outcome.warnings));
        return outcome;
    }
    const Setting& setting() const { return setting_; }
    bool is_exact() const { return exact_ != nullptr; }

  private:
    Setting setting_;
    std::string reference_;
    const RandomScene* exact_;
    const Options& options_;
};

/// Leaves out parts as long as the comparison still fails.
Draft reduced(Draft draft, const Comparison& comparison, std::uint64_t work) {
    const auto start = std::chrono::steady_clock::now();
    const auto still_fails = [&](const Draft& smaller) {
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
        return took.count() < kReductionSeconds &&
               comparison.of(smaller, nullptr, work, 77).difference.is_real();
    };
    for (auto parts : {&Draft::sensors, &Draft::lights, &Draft::objects}) {
        for (std::size_t step = std::max<std::size_t>(1, (draft.*parts).size() / 2);; step /= 2) {
            for (std::size_t first = 0; first < (draft.*parts).size();) {
                Draft smaller = draft;
                auto& list = smaller.*parts;
                const auto begin = list.begin() + static_cast<std::ptrdiff_t>(first);
                const auto count = std::min(step, list.size() - first);
                list.erase(begin, begin + static_cast<std::ptrdiff_t>(count));
                // Lamps go with their objects.
                std::erase_if(smaller.lights, [&](const Part& light) {
                    const std::string object = light.text("object");
                    return !object.empty() && !smaller.object(object);
                });
                if (parts != &Draft::sensors || !list.empty()) {
                    if (still_fails(smaller)) {
                        draft = std::move(smaller);
                        continue;
                    }
                }
                first += step;
            }
            if (step == 1) break;
        }
    }
    const std::string all = draft.text();
    std::erase_if(draft.materials,
                  [&](const Part& material) { return !contains(all, ('"' + material.name + '"').c_str()); });
    return draft;
}

std::vector<Setting> settings_of(const RandomScene& random, const Options& options, Draw& draw) {
    std::vector<Setting> settings;
    const bool has_luminance = std::ranges::any_of(random.draft.sensors, [](const Part& sensor) {
        const std::string type = sensor.text("type");
        return type == "luminance" || type == "goniometer" || type == "ugr" || type == "dgp" ||
               type == "camera";
    });
    for (const char* const method :
         {"auto", "light-paths", "guided", has_luminance ? "double-local" : "local"})
        settings.push_back({method});
    for (std::size_t i = 0; i < options.forms; ++i) {
        const auto form = static_cast<Form>(1 + draw.below(static_cast<std::size_t>(Form::count) - 1));
        settings.push_back({draw.one_of({"auto", "path", "light-paths", "guided"}), form});
    }
    Setting apart{draw.one_of({"auto", "path", "light-paths", "guided"})};
    apart.apart = draw.one_of({Apart::lights, Apart::bounces, Apart::light_scene});
    settings.push_back(apart);
    // Patches keep the light that surfaces reflect only.
    const bool has_no_patches = std::ranges::any_of(random.draft.materials, [](const Part& material) {
        const std::string type = material.text("type");
        return type == "translucent" || type == "fabric" || type == "frosted";
    });
    if (options.is_long && !has_no_patches) {
        for (const char* const method : {"ray-bundle", "radiosity", "particles"})
            settings.push_back({method});
    }
    std::erase_if(settings, [&](const Setting& setting) {
        return setting.words().find(options.only) == std::string::npos;
    });
    return settings;
}

}  // namespace

Checked check(const RandomScene& random, std::uint64_t scene, const Options& options) {
    Checked checked;
    Draw draw(options.seed, ~scene);
    const std::uint64_t seed = 1000 + 100 * scene;
    std::string reference_method = "path";
    Measured reference =
        measure(random.draft, {reference_method, Form::as_it_is, seed, options.work}, options.folder);
    if (!reference.refusal.empty()) {
        checked.refusal = reference.refusal;
        return checked;
    }
    if (is_incomplete(reference)) {
        reference_method = "light-paths";
        reference =
            measure(random.draft, {reference_method, Form::as_it_is, seed, options.work}, options.folder);
    }
    std::vector<Comparison> comparisons;
    for (const Setting& setting : settings_of(random, options, draw))
        comparisons.emplace_back(setting, reference_method, nullptr, options);
    if (!random.exact.empty()) {
        for (const char* const method : {"path", "auto"})
            comparisons.emplace_back(Setting{method}, reference_method, &random, options);
    }
    std::uint64_t next_seed = seed + 1;
    for (const Comparison& comparison : comparisons) {
        const Comparison::Outcome first = comparison.of(random.draft, &reference, options.work, next_seed);
        next_seed += 2;
        if (!first.measured.refusal.empty()) continue;
        if (comparison.setting().method != "light-paths" && is_incomplete(first.measured)) continue;
        checked.comparisons += first.measured.readings.size();
        if (!first.difference.is_real()) continue;
        const Comparison::Outcome again =
            comparison.of(random.draft, nullptr, kMoreWork * options.work, next_seed + 50);
        if (!again.difference.is_real()) continue;
        Finding finding;
        finding.scene = scene;
        finding.setting = comparison.setting();
        finding.is_exact = comparison.is_exact();
        finding.reference = reference_method;
        finding.difference = again.difference;
        finding.reading = again.measured.readings[again.difference.reading].name;
        finding.kind = random.kind;
        finding.warnings = again.warnings;
        std::ranges::sort(finding.warnings);
        const auto repeated = std::ranges::unique(finding.warnings);
        finding.warnings.erase(repeated.begin(), repeated.end());
        const std::string sensor = finding.reading.substr(0, finding.reading.find(' '));
        const auto is_explained_by = [&](const std::vector<std::string>& warnings) {
            return std::ranges::any_of(warnings,
                                       [&](const std::string& warning) { return explains(warning, sensor); });
        };
        const bool lacks_near_light =
            has_heavy_tails(finding.setting) && finding.difference.value < finding.difference.other;
        finding.is_explained = lacks_near_light || is_explained_by(finding.warnings);
        // Such a method may lack any share of the light, but it has to warn.
        const auto [lower, higher] = std::minmax(finding.difference.value, finding.difference.other);
        if (lower < kLeastExplained * higher &&
            !(lacks_near_light && is_explained_by(again.measured.warnings)))
            finding.is_explained = false;
        const bool is_explained = finding.is_explained;
        if (!is_explained)
            finding.draft = finding.is_exact ? random.draft : reduced(random.draft, comparison, options.work);
        checked.findings.push_back(std::move(finding));
        if (!is_explained) break;  // its other differences mostly have the same cause
    }
    return checked;
}

}  // namespace stilb::random
