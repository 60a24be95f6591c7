#include "api/run_state.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "api/scene_data.h"
#include "statistics/interval.h"
#include "stilb/error.h"

namespace stilb::api {
namespace {

/// Of the state, in messages.
const std::string kName = "state of a run";
/// As the command line names them (docs/runs.md).
constexpr std::string_view kSums = "readings";

}  // namespace

void RunState::Data::require(const Scene& scene, std::span<const Sensor> sensors, const RunOptions& options) {
    io::RunTraits own = io::traits_of(scene.data().file, sensors, options);
    if (traits.empty()) traits = own;
    io::RunOrigin origin;
    origin.traits = traits;
    io::require_same_run(origin, own, kName);
}

RunState::RunState() : data_(std::make_shared<Data>()) {}

RunState::RunState(std::string_view bytes) : RunState() {
    const io::StoredRun stored = io::read_run(bytes, kName);
    data_->traits = stored.origin.traits;
    data_->sums = io::read_sums<run::RunState>(stored, kSums, kName);
}

std::string RunState::bytes() const {
    io::StoredRun stored;
    stored.origin.command = "measure";
    stored.origin.traits = data_->traits;
    stored.sums.push_back({std::string(kSums), io::sums_of(data_->sums)});
    return to_bytes(stored);
}

bool RunState::has_begun() const { return !data_->sums.tallies.empty(); }
std::uint64_t RunState::samples() const { return data_->sums.samples(); }
std::vector<std::uint64_t> RunState::seeds() const { return data_->sums.seeds(); }

std::uint64_t RunState::samples_at_next_check() const {
    if (!has_begun()) throw InputError("the run has not begun");
    const run::RunPlan& plan = data_->sums.plan;
    const std::uint64_t of_replicate = samples() / plan.replicates;
    return plan.replicates * plan.in_units(statistics::next_check(of_replicate, plan.first_check));
}

void RunState::merge(const RunState& other) {
    if (!other.has_begun()) return;
    if (!has_begun()) {
        *data_ = other.data();
        return;
    }
    const auto without_seed = [](io::RunTraits traits) {
        std::erase_if(traits, [](const io::RunTrait& trait) { return trait.name == "seed"; });
        return traits;
    };
    io::RunOrigin own;
    own.traits = without_seed(data_->traits);
    io::require_same_run(own, without_seed(other.data().traits), kName);
    try {
        data_->sums.merge(other.data().sums);
    } catch (const std::invalid_argument& error) {
        throw InputError(error.what(), {kName});
    }
}

}  // namespace stilb::api
