// stilb verify: compares every method with exact solutions.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "cli/command_line.h"
#include "cli/progress.h"
#include "cli/run_flags.h"
#include "estimators/estimator_list.h"
#include "io/results/results_text.h"
#include "run/options.h"
#include "stilb/error.h"
#include "verification/cie171.h"
#include "verification/verification.h"

namespace stilb::cli {
namespace {

struct VerifyRequest {
    std::vector<std::string> cases, methods;
    RunOptions options;
    bool all = false, json = false, cie171 = false;
};

constexpr const char* kTableHeader =
    "case                variant                            method          exact   measured  unit      ± %"
    "      z   time s\n";

/// A row with the reading farthest from its exact value, and the widest interval of all.
std::string row(const verification::Verification& v) {
    const verification::CheckedReading& worst = v.worst();
    return fmt::format("{:19} {:34} {:12} {:8.5g} {:10.5g}  {:5} {:7.2g} {:6.2f} {:8.2f}\n", v.name,
                       v.variant, v.method, worst.exact.value, worst.measured.value, v.unit,
                       100 * v.widest_interval(), worst.z, v.elapsed_s);
}

std::string reading_rows(const verification::Verification& v) {
    std::string text;
    for (const verification::CheckedReading& reading : v.readings) {
        text += fmt::format("    {:63} {:8.5g} {:10.5g}  {:5} {:7.2g} {:6.2f}\n",
                            io::location_text(location_of(reading.exact.measurand)), reading.exact.value,
                            reading.measured.value, v.unit, 100 * relative_half_width(reading.measured),
                            reading.z);
    }
    return text;
}

std::array<double, 3> components_of(const Vec3& v) { return {v.x, v.y, v.z}; }

/// Adds both values of a reading.
void add_values(const verification::CheckedReading& reading, nlohmann::ordered_json& json) {
    const statistics::Estimate& measured = reading.measured;
    json["exact"] = reading.exact.value;
    json["tolerance"] = reading.exact.tolerance;
    json["value"] = measured.value;
    json["standard_error"] = measured.standard_error;
    json["interval"] = {measured.lower, measured.upper};
    json["z"] = reading.z;
}

nlohmann::ordered_json to_json(const verification::Verification& v) {
    nlohmann::ordered_json readings = nlohmann::ordered_json::array();
    for (const verification::CheckedReading& reading : v.readings) {
        const Location location = location_of(reading.exact.measurand);
        nlohmann::ordered_json json{{"position", components_of(location.position)}};
        for (const Location::Direction& direction : location.directions)
            json[std::string(direction.name)] = components_of(direction.value);
        add_values(reading, json);
        readings.push_back(std::move(json));
    }
    return {{"case", v.name},
            {"variant", v.variant},
            {"method", v.method},
            {"time_s", v.elapsed_s},
            {"unit", v.unit},
            {"worst_z", v.worst().z},
            {"readings", std::move(readings)}};
}

void require_known(const std::vector<std::string>& names,
                   const std::vector<verification::VerificationCase>& cases) {
    std::vector<std::string_view> known;
    for (const verification::VerificationCase& c : cases) {
        if (known.empty() || known.back() != c.name) known.push_back(c.name);
    }
    for (const std::string& name : names) {
        if (std::find(known.begin(), known.end(), name) != known.end()) continue;
        throw InputError(fmt::format("--case \"{}\": there is no such case.{} Cases: {}.", name,
                                     did_you_mean(name, known), fmt::join(known, ", ")));
    }
}

/// The cases of these names (all, if empty) to which one of the methods applies.
std::vector<verification::VerificationCase> chosen_cases(
    const std::vector<std::string>& names, const std::vector<estimators::EstimatorEntry>& methods) {
    std::vector<verification::VerificationCase> cases = verification::verification_cases();
    require_known(names, cases);
    std::erase_if(cases, [&](const verification::VerificationCase& c) {
        const bool is_named = names.empty() || std::find(names.begin(), names.end(), c.name) != names.end();
        return !is_named ||
               std::none_of(methods.begin(), methods.end(),
                            [&](const estimators::EstimatorEntry& method) { return c.is_for(method); });
    });
    if (cases.empty()) {
        throw InputError(
            "--method: no chosen case applies to the chosen methods: local is checked on illuminances, "
            "double-local on luminances");
    }
    return cases;
}

std::vector<estimators::EstimatorEntry> chosen_methods(const std::vector<std::string>& names) {
    if (names.empty()) return estimators::unbiased_estimators();
    std::vector<estimators::EstimatorEntry> methods;
    for (const std::string& name : names) methods.push_back(estimators::find_estimator(name));
    return methods;
}

/// Contradictions and missed targets among the results; empty where there are none.
std::string complaints(const std::vector<verification::Verification>& results, double error) {
    std::string text;
    for (const verification::Verification& v : results) {
        const std::string named = fmt::format("{}, {}, {}", v.name, v.variant, v.method);
        if (v.contradicts()) text += fmt::format("CONTRADICTION: {}: z = {:.2f}\n", named, v.worst().z);
        if (!(v.widest_interval() <= error)) {
            text += fmt::format("NOT REACHED: {}: the widest interval is ± {:.2g} %\n", named,
                                100 * v.widest_interval());
        }
    }
    return text;
}

std::string notes(const std::vector<verification::VerificationCase>& cases) {
    std::string text;
    std::string_view last_name;
    for (const verification::VerificationCase& c : cases) {
        if (c.name != last_name && !c.note.empty()) text += fmt::format("{}: {}\n", c.name, c.note);
        last_name = c.name;
    }
    return text;
}

std::string closing_words(const std::vector<verification::Verification>& results,
                          const std::vector<verification::VerificationCase>& cases, double error) {
    std::size_t readings = 0;
    for (const verification::Verification& v : results) readings += v.readings.size();
    const std::string wrong = complaints(results, error);
    return fmt::format(
        "\nEach row shows its reading with the largest |z| and its widest 95 % interval. {} readings; if "
        "all\n"
        "methods are right, the chance that any of them has |z| > {:g} is {:.2g} %.\n{}\n{}",
        readings, verification::kContradictionZ, 100 * verification::false_alarm_chance(readings),
        notes(cases),
        wrong.empty()
            ? fmt::format("All readings agree with the exact values, within ± {:g} %.\n", 100 * error)
            : wrong);
}

/// Verifies all cases, and prints each row as soon as it is complete.
std::vector<verification::Verification> verify_all(const VerifyRequest& request,
                                                   const std::vector<verification::VerificationCase>& cases,
                                                   const std::vector<estimators::EstimatorEntry>& methods,
                                                   RunOptions options) {
    const std::atomic<bool>& interrupt = watch_for_interrupt();
    std::vector<verification::Verification> results;
    if (!request.json) fmt::print("{}", kTableHeader);
    for (const verification::VerificationCase& c : cases) {
        for (const estimators::EstimatorEntry& method : methods) {
            if (interrupt || !c.is_for(method)) continue;
            options.method = method.name;
            {
                TerminalProgress progress;
                results.push_back(verify(c, options, &progress, &interrupt));
            }
            if (request.json) continue;
            fmt::print("{}{}", row(results.back()), request.all ? reading_rows(results.back()) : "");
            std::fflush(stdout);
        }
    }
    return results;
}

// The test cases of CIE 171

constexpr const char* kCie171Header =
    "case                                 point              reference      value  unit           interval"
    "          z\n";

std::string cie171_row(const verification::Cie171Case& c, const std::string& point,
                       const verification::CheckedReading& reading) {
    const statistics::Estimate& measured = reading.measured;
    return fmt::format("{:4} {:31} {:16} {:11.3f} {:10.3f}  {:4} {:10.3f} to {:8.3f} {:6.2f}\n", c.number,
                       c.variant, point, reading.exact.value, measured.value, c.unit, measured.lower,
                       measured.upper, reading.z);
}

nlohmann::ordered_json cie171_json(const verification::Cie171Case& c, const std::string& method,
                                   const std::string& point, const verification::CheckedReading& reading) {
    nlohmann::ordered_json json{
        {"case", c.number}, {"variant", c.variant}, {"method", method}, {"point", point}, {"unit", c.unit}};
    add_values(reading, json);
    return json;
}

int run_cie171(const VerifyRequest& request, RunOptions options) {
    if (!request.cases.empty()) throw InputError("--case and --cie171: give one of them");
    if (request.methods.size() > 1) throw InputError("--cie171: give one --method at most");
    if (!request.methods.empty()) options.method = estimators::find_estimator(request.methods[0]).name;
    const std::atomic<bool>& interrupt = watch_for_interrupt();
    nlohmann::ordered_json all = nlohmann::ordered_json::array();
    std::size_t outside = 0, rows = 0;
    if (!request.json) fmt::print("{}", kCie171Header);
    for (const verification::Cie171Case& c : verification::cie171_cases()) {
        if (interrupt) break;
        std::vector<verification::CheckedReading> readings;
        {
            TerminalProgress progress;
            readings = verify(c, options, &progress, &interrupt);
        }
        for (std::size_t i = 0; i < readings.size(); ++i) {
            outside += readings[i].contradicts();
            if (request.json) {
                all.push_back(cie171_json(c, options.method, c.rows[i].point, readings[i]));
            } else {
                fmt::print("{}", cie171_row(c, c.rows[i].point, readings[i]));
            }
        }
        rows += readings.size();
        std::fflush(stdout);
    }
    if (request.json) {
        fmt::print("{}\n", all.dump(2));
    } else {
        fmt::print(
            "\nMethod {}, 95 % intervals. {} of {} values are outside: more than {:g} standard errors from "
            "the reference.\n",
            options.method, outside, rows, verification::kContradictionZ);
    }
    return outside == 0 ? kExitDone : kExitCheckFailed;
}

int run_verify(const VerifyRequest& request) {
    const RunOptions& options = request.options;
    if (request.cie171) return run_cie171(request, options);
    const std::vector<estimators::EstimatorEntry> methods = chosen_methods(request.methods);
    const std::vector<verification::VerificationCase> cases = chosen_cases(request.cases, methods);
    const std::vector<verification::Verification> results = verify_all(request, cases, methods, options);
    if (request.json) {
        nlohmann::ordered_json all = nlohmann::ordered_json::array();
        for (const verification::Verification& v : results) all.push_back(to_json(v));
        fmt::print("{}\n", all.dump(2));
    } else {
        fmt::print("{}", closing_words(results, cases, *options.error));
    }
    return complaints(results, *options.error).empty() ? kExitDone : kExitCheckFailed;
}

}  // namespace

void add_verify(CommandLine& line) {
    Command command = line.add_command("verify", "Compare every method with exact solutions");
    command.set_examples(
        "  stilb verify\n"
        "  stilb verify --error 0.2%\n"
        "  stilb verify --cie171\n"
        "  stilb verify --case \"photometric sphere\" --method auto --all\n");
    auto request = std::make_shared<VerifyRequest>();
    command.add("--case", request->cases, "Check only this exact solution (may be repeated)")
        .value_name("NAME")
        .repeatable();
    command.add("--method", request->methods, "Check only this method (may be repeated)")
        .value_name("NAME")
        .repeatable();
    request->options.error = 0.01;
    add_option(command, request->options, "error")
        .description(
            "Largest half-width of the 95 % interval of a reading, as a share of its value (default: 1%)");
    add_option(command, request->options, "time")
        .description("Time limit for each case and method, in seconds");
    add_option(command, request->options, "seed");
    add_option(command, request->options, "threads");
    command.add("--cie171", request->cie171,
                "The test cases of CIE 171 instead, by one method (default: auto)");
    command.add("--all", request->all, "Show all readings, not only the worst of each row");
    command.add("--json", request->json, "One JSON document on stdout instead of the table");
    command.run([request] { return run_verify(*request); });
}

}  // namespace stilb::cli
