#include "run/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace stilb::run {
namespace {

/// Replicates of large grids alone, and the least number of readings of such a grid.
constexpr std::size_t kFewReplicates = 8, kLargeGrid = 64;
/// Replicates times strands of a plan, and each of them: more are damaged bytes.
constexpr std::uint64_t kMostUnits = std::uint64_t{1} << 20;

}  // namespace

RunPlan RunPlan::of(std::span<const Sensor> sensors, const RunOptions& options, bool lights_patches) {
    const bool are_large_grids = !lights_patches && std::ranges::all_of(sensors, [](const Sensor& sensor) {
        return sensor.size() == 0 || (sensor.count() && sensor.size() >= kLargeGrid);
    });
    RunPlan plan;
    plan.seed = options.seed;
    if (are_large_grids) {
        plan.replicates = kFewReplicates;
        plan.pools_errors = true;
        plan.has_paces = !is_error_of_means(options);
    }
    if (options.replicates) plan.replicates = static_cast<std::size_t>(*options.replicates);
    return plan;
}

void RunPlan::write(ByteWriter& bytes) const {
    bytes.add_list(technique);
    for (const std::uint64_t number :
         {seed, std::uint64_t{replicates}, std::uint64_t{pools_errors}, std::uint64_t{has_paces},
          std::uint64_t{strands}, unit, first_check, most_at_once, std::uint64_t{paces.size()}})
        bytes.add(number);
    for (const std::vector<estimators::Pace>& of_replicate : paces) bytes.add_list(of_replicate);
}

RunPlan RunPlan::read(ByteReader& bytes) {
    RunPlan plan;
    plan.technique = bytes.take_list<std::string>("the technique");
    const auto number = [&] { return bytes.take<std::uint64_t>("the plan"); };
    plan.seed = number();
    plan.replicates = number();
    plan.pools_errors = number() != 0;
    plan.has_paces = number() != 0;
    plan.strands = number();
    plan.unit = number();
    plan.first_check = number();
    plan.most_at_once = number();
    const auto is_possible = [](std::uint64_t count) { return count >= 1 && count <= kMostUnits; };
    if (!is_possible(plan.replicates) || !is_possible(plan.strands) || !is_possible(plan.units()))
        bytes.fail(fmt::format("there are from 1 to {} parts of a run", kMostUnits));
    if (plan.unit == 0 || plan.first_check == 0 || plan.most_at_once == 0)
        bytes.fail("a number of samples is 0");
    const std::uint64_t paces = number();
    if (paces != 0 && paces != plan.replicates) bytes.fail("the paces are not those of all replicates");
    for (std::uint64_t r = 0; r < paces; ++r) {
        plan.paces.push_back(bytes.take_list<std::vector<estimators::Pace>>("the paces"));
        if (std::ranges::count(plan.paces.back(), std::uint64_t{0}, &estimators::Pace::every) > 0)
            bytes.fail("a pace takes no samples");
    }
    return plan;
}

void RunState::merge(RunState part) {
    if (part.plan != plan) throw std::invalid_argument("the parts are of runs of different plans");
    if (tallies.empty())
        tallies = std::move(part.tallies);
    else if (!part.tallies.empty()) {
        for (std::size_t i = 0; i < tallies.size(); ++i) {
            if (part.tallies[i].samples == 0) continue;
            if (tallies[i].samples > 0) throw std::invalid_argument("the parts have made the same samples");
            tallies[i] = std::move(part.tallies[i]);
        }
    }
}

void RunState::write(ByteWriter& bytes) const {
    plan.write(bytes);
    bytes.add(std::uint64_t{tallies.size()});
    for (const estimators::Tally& tally : tallies) tally.write(bytes);
}

RunState RunState::read(ByteReader& bytes) {
    RunState state{RunPlan::read(bytes), {}};
    const auto count = bytes.take<std::uint64_t>("the number of sums");
    if (count != 0 && count != state.plan.units()) bytes.fail("the sums are not those of the plan");
    for (std::uint64_t i = 0; i < count; ++i) state.tallies.push_back(estimators::Tally::read(bytes));
    return state;
}

}  // namespace stilb::run
