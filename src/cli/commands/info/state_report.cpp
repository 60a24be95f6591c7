#include "cli/commands/info/state_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/version.h"
#include "cli/commands/measure.h"
#include "io/results/run_file.h"
#include "run/pictures/picture_sums.h"

namespace stilb::cli {
namespace {

using Json = InfoReport;

Json plan_json(const run::RunPlan& plan) {
    return {{"technique", plan.technique}, {"replicates", plan.replicates}};
}

Json sums_json(const io::StoredRun& stored, const io::StoredSums& sums, const std::string& file) {
    Json json{{"name", sums.name}, {"bytes", sums.bytes.size()}};
    if (sums.name == io::kReadingSums) {
        const auto state = io::read_sums<run::RunState>(stored, sums.name, file);
        json.update(plan_json(state.plan));
        json["seeds"] = state.seeds();
        json["samples"] = state.samples();
        json["strands"] = state.plan.units();
        json["begun_strands"] = state.begun();
    } else if (stored.origin.command != "solve") {
        const auto picture = io::read_sums<run::PictureSums>(stored, sums.name, file);
        json.update(plan_json(picture.plan()));
        json["seeds"] = picture.seeds();
        json["samples"] = picture.passes();
        json["strands"] = picture.plan().replicates;
        json["begun_strands"] = picture.replicates();
    }
    return json;
}

std::string sums_text(const Json& sums) {
    std::string text = fmt::format("  {}", sums["name"].get<std::string>());
    if (sums.contains("samples")) {
        const auto seeds = sums["seeds"].get<std::vector<std::uint64_t>>();
        text += fmt::format(": {}, {} samples, {} {}", sums["technique"].get<std::string>(),
                            sums["samples"].get<std::uint64_t>(), seeds.size() == 1 ? "seed" : "seeds",
                            fmt::join(seeds, ", "));
    }
    if (sums.contains("strands") && sums["begun_strands"] < sums["strands"]) {
        text += fmt::format(", {} of {} strands", sums["begun_strands"].get<std::size_t>(),
                            sums["strands"].get<std::size_t>());
    }
    return text + fmt::format(", {:.3g} MB\n", 1e-6 * sums["bytes"].get<double>());
}

}  // namespace

InfoReport report_state(const std::filesystem::path& path) {
    const io::StoredRun stored = io::read_run_file(path);
    Json traits = Json::object(), sums = Json::array();
    for (const io::RunTrait& trait : stored.origin.traits) traits[trait.name] = trait.value;
    for (const io::StoredSums& own : stored.sums) sums.push_back(sums_json(stored, own, path.string()));
    return {{"stilb", program_version()},
            {"file", path.string()},
            {"state",
             {{"command", stored.origin.command},
              {"arguments", stored.origin.arguments},
              {"folder", stored.origin.folder},
              {"elapsed_s", stored.origin.elapsed_s},
              {"ending", stored.origin.ending},
              {"depends_on", traits},
              {"sums", sums}}},
            {"warnings", Json::array()}};
}

std::string state_text(const InfoReport& state) {
    const auto ending = state["ending"].get<std::string>();
    const auto arguments = state["arguments"].get<std::vector<std::string>>();
    std::string text = fmt::format("The state of a run of stilb {} {}, in the folder {}\n",
                                   state["command"].get<std::string>(), fmt::join(arguments, " "),
                                   state["folder"].get<std::string>());
    for (const Json& sums : state["sums"]) text += sums_text(sums);
    return text + fmt::format("{:.1f} s so far; {}\n", state["elapsed_s"].get<double>(),
                              ending.empty() ? "the run goes on, or was killed" : "it ended: " + ending);
}

}  // namespace stilb::cli
