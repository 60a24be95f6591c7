#include <algorithm>

#include "run/result.h"
#include "run/sensor_estimates.h"

namespace stilb::run {
namespace {

Verdict verdict_on(const Requirement& requirement, const statistics::Estimate& estimate) {
    const double limit = requirement.limit;
    const bool is_at_least = requirement.criterion->limit == sensors::Limit::at_least;
    if (is_at_least ? estimate.lower >= limit : estimate.upper <= limit) return Verdict::pass;
    if (is_at_least ? estimate.upper < limit : estimate.lower > limit) return Verdict::fail;
    return Verdict::undecided;
}

}  // namespace

std::string_view name_of(Verdict verdict) {
    switch (verdict) {
        case Verdict::pass:
            return "pass";
        case Verdict::fail:
            return "fail";
        case Verdict::undecided:
            break;
    }
    return "not sure yet";
}

std::vector<RatedRequirement> rate(std::span<const Requirement> requirements,
                                   const statistics::GridSummary& summary) {
    std::vector<RatedRequirement> rated;
    for (const Requirement& requirement : requirements)
        rated.push_back({requirement, verdict_on(requirement, summary[requirement.criterion->statistic])});
    return rated;
}

std::optional<Verdict> verdict_of(const RunResult& result) {
    std::optional<Verdict> all;
    for (const SensorResult& sensor : result.sensors) {
        for (const RatedRequirement& rated : sensor.requirements) {
            if (rated.verdict == Verdict::fail) return Verdict::fail;
            if (!all || rated.is_undecided()) all = rated.verdict;
        }
    }
    return all;
}

}  // namespace stilb::run
