#include "api/run_state.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "api/scene_data.h"
#include "base/version.h"
#include "statistics/interval.h"
#include "stilb/error.h"

namespace stilb::api {
namespace {

/// Of the state, in messages.
const std::string kName = "state of a run";
/// As the command line names it (docs/runs.md).
constexpr std::string_view kCommand = "measure";

}  // namespace

void RunState::Data::require(const Scene& scene, std::span<const Sensor> sensors, const RunOptions& options) {
    const io::RunTraits own = io::traits_of(scene.data().file, sensors, options);
    if (origin.traits.empty()) origin.traits = own;
    io::require_same_run(origin, own, kName);
}

void RunState::Data::adopt(const Scene& scene, std::span<const Sensor> sensors, const RunOptions& options) {
    origin.traits = io::traits_of(scene.data().file, sensors, options);
}

void RunState::Data::end(RunSummary& call) {
    origin.elapsed_s += call.elapsed_s;
    origin.ending = run::name_of(call.stop_reason);
    call.elapsed_s = origin.elapsed_s;
}

RunState::RunState() : data_(std::make_shared<Data>()) {}
RunState::RunState(const RunState& other) : data_(std::make_shared<Data>(other.data())) {}
RunState& RunState::operator=(const RunState& other) {
    data_ = std::make_shared<Data>(other.data());
    return *this;
}

RunState::RunState(std::string_view bytes, const std::string& name) : RunState() {
    io::StoredRun stored = io::read_run(bytes, name);
    if (stored.origin.command != kCommand)
        throw InputError(fmt::format("this is the state of `stilb {}`, not of `stilb {}`.",
                                     stored.origin.command, kCommand),
                         {name});
    data_->sums = io::read_sums<run::RunState>(stored, io::kReadingSums, name);
    data_->origin = std::move(stored.origin);
}

namespace {

io::StoredRun stored_run(const RunState::Data& data) {
    io::StoredRun stored{data.origin, {{std::string(io::kReadingSums), io::sums_of(data.sums)}}};
    stored.origin.version = program_version();
    stored.origin.command = kCommand;
    return stored;
}

}  // namespace

std::string RunState::bytes() const { return to_bytes(stored_run(*data_)); }
void RunState::save(const std::filesystem::path& path) const { write_run_file(stored_run(*data_), path); }

const std::vector<std::string>& RunState::arguments() const { return data_->origin.arguments; }
const std::string& RunState::folder() const { return data_->origin.folder; }
void RunState::set_command(std::vector<std::string> arguments, std::string folder) {
    data_->origin.arguments = std::move(arguments);
    data_->origin.folder = std::move(folder);
}

bool RunState::has_begun() const { return !data_->sums.plan.technique.empty(); }
std::uint64_t RunState::samples() const { return data_->sums.samples(); }
std::vector<std::uint64_t> RunState::seeds() const { return data_->sums.seeds(); }
double RunState::elapsed_s() const { return data_->origin.elapsed_s; }

std::uint64_t RunState::samples_at_next_check(std::uint64_t after) const {
    if (!has_begun()) throw InputError("the run has not begun");
    const run::RunPlan& plan = data_->sums.plan;
    const std::uint64_t of_replicate = after / plan.replicates;
    return plan.replicates * plan.in_units(statistics::next_check(of_replicate, plan.first_check));
}

void RunState::merge(const RunState& other) {
    if (!other.has_begun()) return;
    if (!has_begun()) {
        *data_ = other.data();
        return;
    }
    io::require_mergeable(data_->origin, other.data().origin.traits, kName);
    try {
        data_->sums.merge(other.data().sums);
        data_->origin.elapsed_s += other.data().origin.elapsed_s;
        data_->origin.ending = run::name_of(StopReason::paths_done);
    } catch (const std::invalid_argument& error) {
        throw InputError(error.what(), {kName});
    }
}

}  // namespace stilb::api
