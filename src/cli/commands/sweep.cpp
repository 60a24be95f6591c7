#include "cli/commands/sweep.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <variant>

#include "cli/progress.h"
#include "io/results/results_text.h"
#include "io/text/table.h"
#include "run/readings/paired.h"
#include "run/run.h"
#include "stilb/error.h"

namespace stilb::cli {
namespace {

/// A key with the values that it takes.
struct Variation {
    std::string key;
    std::vector<std::string> values;
};

/// Splits at commas outside of brackets and quotation marks: a value may be an array or a text.
std::vector<std::string> split_values(std::string_view text) {
    std::vector<std::string> values{""};
    int depth = 0;
    bool is_quoted = false;
    for (const char c : text) {
        if (c == '"') is_quoted = !is_quoted;
        if (!is_quoted && c == '[') ++depth;
        if (!is_quoted && c == ']') --depth;
        if (c == ',' && depth == 0 && !is_quoted)
            values.emplace_back();
        else
            values.back() += c;
    }
    return values;
}

Variation variation_of(const std::string& text) {
    const std::size_t equals = text.find('=');
    Variation variation{text.substr(0, equals), {}};
    if (equals != std::string::npos)
        variation.values = split_values(std::string_view(text).substr(equals + 1));
    if (variation.key.empty() || variation.values.empty() ||
        std::ranges::find(variation.values, std::string()) != variation.values.end()) {
        throw InputError(
            fmt::format("--vary {}: expected KEY=VALUE,VALUE,..., such as "
                        "materials.wall.reflectance=0.3,0.5,0.7.",
                        text));
    }
    return variation;
}

/// The values of all keys in each variant: side by side, or all combinations, of which the last key changes
/// first.
std::vector<std::vector<std::string>> variants_of(const std::vector<Variation>& variations, bool zips) {
    std::vector<std::vector<std::string>> variants;
    if (zips) {
        const std::size_t count = variations.front().values.size();
        for (const Variation& variation : variations) {
            if (variation.values.size() == count) continue;
            throw InputError(fmt::format("--zip: {} has {} values, and {} has {}: give each key as many.",
                                         variations.front().key, count, variation.key,
                                         variation.values.size()));
        }
        for (std::size_t i = 0; i < count; ++i) {
            std::vector<std::string>& own = variants.emplace_back();
            for (const Variation& variation : variations) own.push_back(variation.values[i]);
        }
        return variants;
    }
    variants = {{}};
    for (const Variation& variation : variations) {
        std::vector<std::vector<std::string>> longer;
        for (const std::vector<std::string>& variant : variants) {
            for (const std::string& value : variation.values) {
                longer.push_back(variant);
                longer.back().push_back(value);
            }
        }
        variants = std::move(longer);
    }
    return variants;
}

struct SameShape {
    bool operator()(const Mesh& a, const Mesh& b) const {
        return a.vertices == b.vertices && a.triangles == b.triangles && a.normals == b.normals &&
               a.corner_normals == b.corner_normals;
    }
    bool operator()(const Rectangle& a, const Rectangle& b) const {
        return a.corner == b.corner && a.edge_u == b.edge_u && a.edge_v == b.edge_v;
    }
    bool operator()(const Box& a, const Box& b) const { return a.min == b.min && a.max == b.max; }
    bool operator()(const Sphere& a, const Sphere& b) const {
        return a.center == b.center && a.radius == b.radius;
    }
    bool operator()(const Disk& a, const Disk& b) const {
        return a.center == b.center && a.normal == b.normal && a.radius == b.radius;
    }
    /// Others are not compared.
    template <typename A, typename B>
    bool operator()(const A&, const B&) const {
        return false;
    }
};

/// Whether rays meet the same surfaces, with materials of the same numbers, in both.
bool have_same_objects(const Scene& a, const Scene& b) {
    return std::ranges::equal(a.objects, b.objects, [](const Object& x, const Object& y) {
        return x.materials == y.materials && std::visit(SameShape(), x.shape, y.shape);
    });
}

/// The table: a row for each statistic of each sensor in each variant.
class SweepTable {
  public:
    explicit SweepTable(const std::vector<Variation>& variations) : keys_(variations.size()) {
        for (const Variation& variation : variations) names_.push_back(variation.key);
    }

    void add(const std::vector<std::string>& variant, const RunResult& result, const RunResult& first) {
        for (const SensorResult& sensor : result.sensors) {
            const bool is_one = sensor.readings.size() == 1;
            for (std::size_t i = 0; i < kStatisticNames.size(); ++i) {
                const auto statistic = static_cast<Statistic>(i);
                if (is_one && statistic != Statistic::mean) continue;
                if (is_ratio(statistic) && !sensor.sensor.has_ratios()) continue;
                add_row(variant, result, sensor, is_one ? "value" : std::string(name_of(statistic)),
                        sensor.summary[statistic], difference(sensor, statistic, result, first));
            }
        }
    }

    std::vector<io::Column> columns() const {
        std::vector<io::Column> all;
        for (std::size_t k = 0; k < keys_.size(); ++k) all.push_back({names_[k], keys_[k]});
        const std::vector<io::Column> rest{{"sensor", sensors_},
                                           {"statistic", statistics_},
                                           {"unit", units_},
                                           {"value", numbers_[0]},
                                           {"standard_error", numbers_[1]},
                                           {"interval_low", numbers_[2]},
                                           {"interval_high", numbers_[3]},
                                           {"difference", numbers_[4]},
                                           {"difference_standard_error", numbers_[5]},
                                           {"difference_low", numbers_[6]},
                                           {"difference_high", numbers_[7]},
                                           {"converged", converged_},
                                           {"warnings", warnings_}};
        all.insert(all.end(), rest.begin(), rest.end());
        return all;
    }

    /// A line for each row: values of the keys, sensor, statistic, value and difference.
    const std::string& text() const { return text_; }

  private:
    /// Unknown where the first variant has no such readings, or a run was interrupted.
    static statistics::Estimate difference(const SensorResult& sensor, Statistic statistic,
                                           const RunResult& result, const RunResult& first) {
        const auto before = std::ranges::find_if(
            first.sensors, [&](const SensorResult& own) { return own.sensor.name == sensor.sensor.name; });
        if (before == first.sensors.end()) return statistics::kUndefinedEstimate;
        return paired_difference(sensor, *before, statistic, std::max(result.confidence, first.confidence))
            .value_or(statistics::kUndefinedEstimate);
    }
    void add_row(const std::vector<std::string>& variant, const RunResult& result, const SensorResult& sensor,
                 const std::string& statistic, const statistics::Estimate& value,
                 const statistics::Estimate& difference) {
        for (std::size_t k = 0; k < keys_.size(); ++k) keys_[k].push_back(variant[k]);
        sensors_.push_back(sensor.sensor.name);
        statistics_.push_back(statistic);
        units_.emplace_back(is_ratio_name(statistic) ? "" : sensor.sensor.quantity().unit);
        const std::array<double, 8> numbers{value.value,      value.standard_error, value.lower,
                                            value.upper,      difference.value,     difference.standard_error,
                                            difference.lower, difference.upper};
        for (std::size_t i = 0; i < numbers.size(); ++i) numbers_[i].push_back(numbers[i]);
        converged_.emplace_back(result.converged ? "true" : "false");
        warnings_.push_back(fmt::format("{}", fmt::join(texts_of(result.warnings), " ")));
        text_ +=
            fmt::format("{:<24} {:12} {:11} {:>22}   {:>22}\n", fmt::format("{}", fmt::join(variant, "  ")),
                        sensor.sensor.name, statistic, io::with_error(value), io::with_error(difference));
    }
    static bool is_ratio_name(std::string_view name) {
        return name == name_of(Statistic::uniformity) || name == name_of(Statistic::diversity);
    }

    std::vector<std::string> names_;
    std::vector<std::vector<std::string>> keys_;
    std::vector<std::string> sensors_, statistics_, units_, converged_, warnings_;
    std::array<std::vector<double>, 8> numbers_;
    std::string text_;
};

/// `path`, where the method is to be chosen: its samples in two variants differ by little but the
/// reflectances, while light paths end elsewhere where surfaces reflect less.
RunOptions for_pairs(RunOptions options) {
    if (options.method == "auto") options.method = "path";
    return options;
}

/// As many samples of the same technique as the first variant had, so that their replicates belong together.
RunOptions as_in(const RunResult& first, RunOptions options) {
    options.method = first.technique;
    options.error.reset();
    options.time_s.reset();
    options.paths = first.samples;
    return options;
}

RunResult measured(const Measurement& measurement, const RunOptions& options, const run::PreparedScene& scene,
                   ProgressSink* progress) {
    RunResult result = run::measure(scene, measurement.sensors, options, progress, &watch_for_interrupt());
    put_first(measurement.file.warnings, result);
    return result;
}

/// The variant that others are compared with.
struct FirstVariant {
    FirstVariant(Measurement own, ProgressSink* progress)
        : measurement(std::move(own)),
          scene(measurement.file.scene),
          result(measured(measurement, for_pairs(measurement.options), scene, progress)) {}

    const Measurement measurement;
    const run::PreparedScene scene;
    const RunResult result;
};

RunResult measured_like(const FirstVariant& first, const Measurement& measurement, ProgressSink* progress) {
    const Scene& scene = measurement.file.scene;
    const RunOptions options = as_in(first.result, measurement.options);
    if (have_same_objects(scene, first.measurement.file.scene))
        return measured(measurement, options, {scene, first.scene}, progress);
    return measured(measurement, options, scene, progress);
}

}  // namespace

void SweepFlags::add_to(Command& command) {
    command
        .add(
            "--vary", vary,
            "Measure a variant of the scene for each of these values of a key (may be repeated: all "
            "combinations): one table, with the differences from the first variant, paired sample by sample. "
            "Method auto then is path, by which pairs are closest")
        .value_name("KEY=A,B,...")
        .repeatable();
    command.add("--zip", zips,
                "With several --vary: take their first values together, then their second ones ...");
}

int run_sweep(const SweepFlags& flags, const std::string& csv, bool quiet,
              const std::function<Measurement(const std::vector<std::string>& overrides)>& prepare) {
    std::vector<Variation> variations;
    for (const std::string& text : flags.vary) variations.push_back(variation_of(text));
    const std::vector<std::vector<std::string>> variants = variants_of(variations, flags.zips);
    if (!csv.empty()) io::require_writable(csv);
    SweepTable table(variations);
    std::optional<FirstVariant> first;
    bool has_all_converged = true;
    for (const std::vector<std::string>& variant : variants) {
        std::vector<std::string> overrides;
        for (std::size_t k = 0; k < variant.size(); ++k)
            overrides.push_back(fmt::format("{}={}", variations[k].key, variant[k]));
        Measurement measurement = prepare(overrides);
        if (measurement.options.by != "none")
            throw InputError(
                "--vary has one table of all light: take --by with one variant at a time, or "
                "stilb.sweep(..., by=...) in Python.");
        TerminalProgress progress;
        ProgressSink* const shown = quiet ? nullptr : &progress;
        const bool is_first = !first;
        if (is_first) first.emplace(std::move(measurement), shown);
        const RunResult result = is_first ? first->result : measured_like(*first, measurement, shown);
        has_all_converged = has_all_converged && result.converged;
        table.add(variant, result, first->result);
        if (result.stop_reason == StopReason::interrupted) break;
    }
    Outputs outputs;
    if (!csv.empty()) outputs.write([&] { io::write_csv(table.columns(), csv); });
    std::vector<std::string> keys;
    for (const Variation& variation : variations) keys.push_back(variation.key);
    fmt::print("{:<24} {:12} {:11} {:>22}   {:>22}\n{}", fmt::format("{}", fmt::join(keys, "  ")), "sensor",
               "statistic", "value", "difference", table.text());
    return outputs.conclude(has_all_converged ? kExitDone : kExitStoppedEarly);
}

}  // namespace stilb::cli
