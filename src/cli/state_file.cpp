#include "cli/state_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "base/version.h"
#include "cli/progress.h"
#include "io/text/file_kind.h"
#include "io/text/table.h"
#include "io/text/text.h"
#include "run/pictures/picture_sums.h"
#include "stilb/error.h"

namespace stilb::cli {
namespace {

/// Writing takes no more than about this share of the time, however large the sums are.
constexpr double kShareOfTime = 0.05;

std::optional<std::filesystem::file_time_type> stamp_of(const std::string& path) {
    std::error_code error;
    const auto stamp = std::filesystem::last_write_time(path, error);
    return error ? std::nullopt : std::optional(stamp);
}

}  // namespace

void StateFlags::add_to(Command& command) {
    command
        .add("--state", path,
             "Keep the state of the run in this file; the same command again, or stilb resume FILE, goes on "
             "from it")
        .value_name("FILE");
    command
        .add("--state-every", every_s, "Write the state every so many seconds (default: 30), and at the end")
        .within({0.1, 1e9, "a time from 0.1 to 1e9 s"})
        .value_name("S");
}

StateFile::StateFile(const StateFlags& flags, std::string_view command, const CommandLine& line,
                     std::span<const std::filesystem::path> sources,
                     const std::function<io::RunTraits()>& traits)
    : path_(flags.path), every_s_(flags.every_s) {
    if (path_.empty()) return;
    if (sources.empty() || io::is_standard_output(path_)) {
        throw InputError(
            "--state needs a scene and a state in files, not standard input and output: who goes on reads "
            "them again.");
    }
    io::require_output(path_, io::FileKind::run, sources);
    constexpr std::array<std::string_view, 2> own{"--state", "--state-every"};
    stored_.origin = {program_version(),
                      std::string(command),
                      without_flags(line.arguments(), own),
                      io::relative_folder(std::filesystem::current_path(), path_),
                      traits(),
                      0,
                      ""};
    stamp_ = stamp_of(path_);
    if (!stamp_ || io::kind_of_content_of(path_) == io::FileKind::empty) return;
    io::StoredRun found = io::read_run_file(path_);
    if (found.origin.command != command) {
        throw InputError(
            fmt::format("this is the state of `stilb {}`. Name another file.", found.origin.command),
            {path_});
    }
    require_same_run(found.origin, stored_.origin.traits, path_);
    stored_.sums = std::move(found.sums);
    stored_.origin.elapsed_s = found.origin.elapsed_s;
    stored_.origin.ending = found.origin.ending;
}

bool StateFile::has_begun(const run::PictureSums& sums) { return !sums.plan().technique.empty(); }

double StateFile::elapsed_s() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun_).count();
}

void StateFile::require_own_file() const {
    if (stamp_of(path_) == stamp_) return;
    throw InputError(
        "another run has written this file meanwhile; the state of this one was not written. Give each run a "
        "file of its own.",
        {path_});
}

void StateFile::write(std::optional<StopReason> ending) {
    if (path_.empty()) return;
    require_own_file();
    io::StoredRun now{stored_.origin, stored_.sums};
    now.origin.elapsed_s += elapsed_s();
    now.origin.ending = ending ? run::name_of(*ending) : "";
    for (const Kept& kept : kept_) {
        std::string bytes = kept.bytes();
        if (!bytes.empty()) now.sums.push_back({kept.name, std::move(bytes)});
    }
    if (now.sums.empty()) return;  // there are no samples yet
    write_run_file(now, path_);
    stamp_ = stamp_of(path_);
}

void StateFile::write_or_warn() {
    try {
        write({});
    } catch (const InputError& error) {
        if (!std::exchange(has_failed_, true)) print_warning(error.what());
    }
}

void StateFile::write_if_due() {
    if (path_.empty()) return;
    const auto since_s = [](auto begin) {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    };
    if (since_s(written_) < std::max(every_s_, writing_s_ / kShareOfTime)) return;
    const auto begin = std::chrono::steady_clock::now();
    write_or_warn();
    writing_s_ = since_s(begin);
    written_ = std::chrono::steady_clock::now();
}

void add_part(Command& command, std::optional<std::string>& part) {
    command
        .add("--part", part,
             "Make only part K of N of the samples of --paths, for several machines: --part 3/16. Needs "
             "--state; stilb merge puts the parts together")
        .value_name("K/N");
}

run::RunPart part_of(const std::string& text, const StateFlags& state) {
    if (state.path.empty())
        throw InputError("--part needs --state FILE: the samples of the part go there, for stilb merge.");
    const std::size_t slash = std::min(text.find('/'), text.size());
    const std::int64_t number = io::parse_integer(text.substr(0, slash)).value_or(0);
    const std::int64_t parts = io::parse_integer(text.substr(std::min(slash + 1, text.size()))).value_or(0);
    if (number < 1 || parts < number)
        throw InputError(fmt::format("--part {}: expected K/N with K from 1 to N, such as 3/16.", text));
    return {static_cast<std::size_t>(number - 1), static_cast<std::size_t>(parts)};
}

void read_arguments(const io::RunOrigin& origin, CommandLine& line) {
    std::vector<const char*> arguments{"stilb", origin.command.c_str()};
    for (const std::string& argument : origin.arguments) arguments.push_back(argument.c_str());
    line.run(static_cast<int>(arguments.size()), arguments.data());
}

std::string path_from(const std::string& path, const io::RunOrigin& origin, const std::string& name) {
    if (path.empty()) return path;
    return (folder_of(origin, name) / path).lexically_normal().string();
}

std::vector<std::string> without_flags(std::vector<std::string> arguments,
                                       std::span<const std::string_view> flags) {
    for (auto at = arguments.begin(); at != arguments.end();) {
        const bool is_one = std::ranges::find(flags, std::string_view(*at)) != flags.end();
        // "--state=FILE" and "-oFILE"
        const bool has_value = std::ranges::any_of(flags, [&](std::string_view flag) {
            const bool is_short = !flag.starts_with("--");
            return at->size() > flag.size() && at->starts_with(flag) &&
                   (is_short || (*at)[flag.size()] == '=');
        });
        if (is_one)
            at = arguments.erase(at, std::min(at + 2, arguments.end()));
        else if (has_value)
            at = arguments.erase(at);
        else
            ++at;
    }
    return arguments;
}

}  // namespace stilb::cli
