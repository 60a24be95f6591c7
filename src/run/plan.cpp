#include "run/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

#include "stilb/error.h"

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

void require_part(const RunOptions& options, const RunPart& part) {
    if (!options.paths)
        throw InputError("a part of a run needs a number of paths: it cannot tell the error of the whole");
    if (part.number >= part.of)
        throw InputError(fmt::format("part {} of {} does not exist: the first one is 0, the last one {}",
                                     part.number, part.of, std::max<std::size_t>(part.of, 1) - 1));
}

void RunState::merge(RunState other) {
    if (other.plan.seed == plan.seed && other.more_seeds.empty() && more_seeds.empty())
        merge_part(std::move(other));
    else
        merge_seeds(std::move(other));
}

void RunState::merge_part(RunState part) {
    if (part.plan != plan) throw std::invalid_argument("the parts are of runs of different plans");
    if (tallies.empty())
        tallies = std::move(part.tallies);
    else if (!part.tallies.empty()) {
        for (std::size_t i = 0; i < tallies.size(); ++i) {
            if (part.tallies[i].samples == 0) continue;
            if (tallies[i].samples > 0) throw std::invalid_argument("both have made the same samples");
            tallies[i] = std::move(part.tallies[i]);
        }
    }
}

void RunState::merge_seeds(RunState other) {
    RunPlan same = other.plan;
    same.seed = plan.seed;
    same.paces = plan.paces;
    if (same != plan) throw std::invalid_argument("the runs have different plans");
    const std::vector<std::uint64_t> own = seeds();
    const std::vector<std::uint64_t> others = other.seeds();
    for (const std::uint64_t seed : others) {
        if (std::ranges::find(own, seed) != own.end())
            throw std::invalid_argument(fmt::format("both have samples of seed {}", seed));
    }
    if (tallies.empty() || tallies.size() != other.tallies.size() ||
        tallies.front().sum.size() != other.tallies.front().sum.size())
        throw std::invalid_argument("the sums are those of other readings");
    more_seeds.insert(more_seeds.end(), others.begin(), others.end());
    for (std::size_t i = 0; i < tallies.size(); ++i) tallies[i] += other.tallies[i];
}

std::vector<std::uint64_t> RunState::seeds() const {
    std::vector<std::uint64_t> all{plan.seed};
    all.insert(all.end(), more_seeds.begin(), more_seeds.end());
    return all;
}

std::uint64_t RunState::samples() const {
    std::uint64_t all = 0;
    for (const estimators::Tally& tally : tallies) all += tally.samples;
    return all;
}

std::size_t RunState::begun() const {
    return static_cast<std::size_t>(
        std::ranges::count_if(tallies, [](const estimators::Tally& tally) { return tally.samples > 0; }));
}

void RunState::write(ByteWriter& bytes) const {
    plan.write(bytes);
    bytes.add_list(more_seeds);
    bytes.add(std::uint64_t{tallies.size()});
    for (const estimators::Tally& tally : tallies) {
        // A part has most of its strands empty.
        bytes.add(std::uint64_t{tally.samples > 0});
        if (tally.samples > 0) tally.write(bytes);
    }
}

RunState RunState::read(ByteReader& bytes) {
    RunState state{RunPlan::read(bytes), {}};
    state.more_seeds = bytes.take_list<std::vector<std::uint64_t>>("other seeds");
    const auto count = bytes.take<std::uint64_t>("the number of sums");
    if (count != 0 && count != state.plan.units()) bytes.fail("the sums are not those of the plan");
    std::vector<std::optional<estimators::Tally>> tallies(count);
    const estimators::Tally* some = nullptr;
    for (std::optional<estimators::Tally>& tally : tallies) {
        if (bytes.take<std::uint64_t>("whether there are sums") == 0) continue;
        tally = estimators::Tally::read(bytes);
        some = &*tally;
    }
    if (!some) return state;
    const estimators::Tally empty(some->sum.size(), some->taken.size(), some->channels());
    for (std::optional<estimators::Tally>& tally : tallies) {
        if (tally && !tally->is_of_same_readings(empty))
            bytes.fail("the sums have different numbers of readings");
        state.tallies.push_back(tally ? *std::move(tally) : empty);
    }
    return state;
}

}  // namespace stilb::run
