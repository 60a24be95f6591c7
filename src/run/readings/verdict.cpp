#include <algorithm>

#include "run/readings/sensor_estimates.h"
#include "run/result.h"

namespace stilb::run {
namespace {

Verdict verdict_on(const Requirement& requirement, const statistics::Estimate& estimate) {
    const double limit = requirement.limit;
    const bool is_at_least = requirement.criterion->limit == sensors::Limit::at_least;
    if (is_at_least ? estimate.lower >= limit : estimate.upper <= limit) return Verdict::pass;
    if (is_at_least ? estimate.upper < limit : estimate.lower > limit) return Verdict::fail;
    return Verdict::undecided;
}

/// A value that passes does so for certain if it also passes with what it leaves out.
Verdict verdict_on(const Requirement& requirement, const SensorEstimates& estimates) {
    const Statistic statistic = requirement.criterion->statistic;
    const Verdict verdict = verdict_on(requirement, estimates.summary[statistic]);
    if (verdict != Verdict::pass || !estimates.complete) return verdict;
    const Verdict in_all = verdict_on(requirement, (*estimates.complete)[statistic]);
    return in_all == Verdict::fail ? Verdict::unsure : in_all;
}

}  // namespace

std::string_view name_of(Verdict verdict) {
    switch (verdict) {
        case Verdict::pass:
            return "pass";
        case Verdict::fail:
            return "fail";
        case Verdict::undecided:
            return "not sure yet";
        case Verdict::unsure:
            break;
    }
    return "not sure";
}

std::string_view text_of(GlareStanding standing) {
    switch (standing) {
        case GlareStanding::counted:
            break;
        case GlareStanding::large:
            return "more than 0.1 sr: the rating is not valid";
        case GlareStanding::small:
            return "less than 0.0003 sr";
        case GlareStanding::outside:
            return "outside of the field of view";
        case GlareStanding::point:
            return "no luminous area";
        case GlareStanding::dim:
            return "below the threshold";
    }
    return "";
}

std::vector<RatedRequirement> rate(std::span<const Requirement> requirements,
                                   const SensorEstimates& estimates) {
    std::vector<RatedRequirement> rated;
    for (const Requirement& requirement : requirements)
        rated.push_back({requirement, verdict_on(requirement, estimates)});
    return rated;
}

std::optional<Verdict> verdict_of(const RunResult& result) {
    std::optional<Verdict> all;
    for (const SensorResult& sensor : result.sensors) {
        for (const RatedRequirement& rated : sensor.requirements) {
            if (rated.verdict == Verdict::fail) return Verdict::fail;
            const bool is_met_so_far = !all || *all == Verdict::pass;
            if (is_met_so_far || rated.is_undecided()) all = rated.verdict;
        }
    }
    return all;
}

}  // namespace stilb::run
