// Random scenes, each measured in many ways that must agree: docs/verification.md.
//
//     verify_random [SCENES] [--seed N] [--first K] [--forms N] [--work N] [--jobs N] [--long]
//     verify_random --scene K [--seed N] [--only WORDS] [--print]
//     verify_random --thresholds
//
// Prints a line for each disagreement, with the scene reduced to what it needs, and fails where there is one.
// A scene follows from the seed and its number alone. Each has a process of its own: one that crashes or does
// not end is a finding, too.
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string_view>
#include <thread>

#include "random/check.h"
#include "random/thresholds.h"
#include "support/source_directory.h"

namespace stilb::random {
namespace {

/// Processor time after which a scene counts as endless; one that waits for ever is stopped, too.
constexpr rlim_t kMostSeconds = 300;
constexpr unsigned kMostSecondsOfClock = 3600;
/// Larger scenes are not printed: `--scene K --print` does it.
constexpr std::size_t kMostPrinted = 80;

struct Request {
    Options options;
    std::uint64_t first = 0, scenes = 100;
    std::size_t jobs = std::max(1u, std::thread::hardware_concurrency());
    bool prints_scene = false, prints_thresholds = false;
};

/// What a process tells about its scene.
struct Counts {
    std::size_t comparisons = 0, findings = 0, explained = 0, refused = 0;
    double seconds = 0;
    char kind[80]{};
};

void print(const Finding& finding) {
    const Difference& d = finding.difference;
    fmt::print("scene {}{}: {}: {} {}: {}: {:.6g} +- {:.2g} for {:.6g} +- {:.2g} (z = {:.1f})\n",
               finding.scene, finding.is_explained ? " (warned)" : "", finding.kind, finding.setting.words(),
               finding.is_exact ? "against the exact value" : "against " + finding.reference, finding.reading,
               d.value, d.value_error, d.other, d.other_error, d.z);
    if (finding.draft.sensors.empty()) return;
    for (const std::string& warning : finding.warnings) fmt::print("    warning: {}\n", warning);
    if (finding.draft.objects.size() + finding.draft.lights.size() <= kMostPrinted)
        fmt::print("{}\n", finding.draft.text());
}

Counts check_scene(std::uint64_t scene, const Options& options) {
    const RandomScene random = generate(options.seed, scene);
    Counts counts;
    std::strncpy(counts.kind, random.kind.c_str(), sizeof counts.kind - 1);
    const Checked checked = check(random, scene, options);
    counts.comparisons = checked.comparisons;
    if (!checked.refusal.empty()) {
        counts.refused = 1;
        fmt::print("scene {}: {}: refused: {}\n", scene, random.kind, checked.refusal);
    }
    for (const Finding& finding : checked.findings) {
        print(finding);
        ++(finding.is_explained ? counts.explained : counts.findings);
    }
    counts.seconds = static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
    return counts;
}

/// A scene at work in a process, which writes its counts and then its report into a file.
struct Job {
    std::uint64_t scene = 0;
    std::FILE* counts = nullptr;
    std::FILE* report = nullptr;
};

pid_t start(Job& job, const Options& options) {
    job.counts = std::tmpfile();
    job.report = std::tmpfile();
    if (!job.counts || !job.report) throw std::runtime_error("cannot make a temporary file");
    std::fflush(stdout);
    const pid_t process = fork();
    if (process != 0) return process;
    const rlimit limit{kMostSeconds, kMostSeconds};
    setrlimit(RLIMIT_CPU, &limit);
    alarm(kMostSecondsOfClock);
    dup2(fileno(job.report), STDOUT_FILENO);
    const Counts counts = check_scene(job.scene, options);
    std::fflush(stdout);
    std::fwrite(&counts, sizeof counts, 1, job.counts);
    std::fflush(job.counts);
    _exit(0);
}

/// Copies the report to the output, and adds to the sums. Returns the processor time of the scene.
double finish(const Job& job, int status, Counts& sums) {
    std::rewind(job.report);
    char text[4096];
    for (std::size_t n; (n = std::fread(text, 1, sizeof text, job.report)) > 0;)
        std::fwrite(text, 1, n, stdout);
    Counts counts;
    std::rewind(job.counts);
    if (std::fread(&counts, sizeof counts, 1, job.counts) != 1) {
        counts.findings = 1;
        const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
        if (signal == SIGXCPU || signal == SIGKILL)
            fmt::print("scene {}: it does not end: stopped after {} s\n", job.scene, kMostSeconds);
        else if (signal == SIGALRM)
            fmt::print("scene {}: it waits: stopped after {} s by the clock\n", job.scene,
                       kMostSecondsOfClock);
        else
            fmt::print("scene {}: the process ended: {}\n", job.scene,
                       signal ? strsignal(signal) : "exception");
    }
    std::fflush(stdout);
    std::fclose(job.report);
    std::fclose(job.counts);
    sums.comparisons += counts.comparisons;
    sums.findings += counts.findings;
    sums.explained += counts.explained;
    sums.refused += counts.refused;
    sums.seconds += counts.seconds;
    return counts.seconds;
}

Counts check_all(const Request& request) {
    std::map<pid_t, Job> running;
    Counts sums;
    const auto wait_for_one = [&] {
        int status = 0;
        const auto found = running.find(wait(&status));
        if (found == running.end()) return;
        finish(found->second, status, sums);
        running.erase(found);
    };
    for (std::uint64_t scene = request.first; scene < request.first + request.scenes; ++scene) {
        while (running.size() >= request.jobs) wait_for_one();
        Job job{scene};
        const pid_t process = start(job, request.options);
        if (process < 0) throw std::runtime_error("cannot start a process");
        running.emplace(process, job);
    }
    while (!running.empty()) wait_for_one();
    return sums;
}

/// Throws std::invalid_argument where the text is no whole number: a misspelled option must not pass as a run
/// of no scene.
std::uint64_t number_in(std::string_view text) {
    std::uint64_t number = 0;
    const auto [end, error] = std::from_chars(text.begin(), text.end(), number);
    if (error != std::errc{} || end != text.end()) {
        throw std::invalid_argument(fmt::format(
            "'{}' is neither a number nor an option of verify_random: docs/verification.md lists them",
            text));
    }
    return number;
}

Request parse(int argc, char** argv) {
    Request request;
    for (int i = 1; i < argc; ++i) {
        const std::string_view argument = argv[i];
        const auto next = [&] { return number_in(++i < argc ? argv[i] : ""); };
        if (argument == "--seed") {
            request.options.seed = next();
        } else if (argument == "--scene") {
            request.first = next();
            request.scenes = 1;
        } else if (argument == "--first") {
            request.first = next();
        } else if (argument == "--forms") {
            request.options.forms = next();
        } else if (argument == "--work") {
            request.options.work = std::max<std::uint64_t>(1, next());
        } else if (argument == "--jobs") {
            request.jobs = std::max<std::size_t>(1, next());
        } else if (argument == "--long") {
            request.options.is_long = true;
        } else if (argument == "--only") {
            request.options.only = ++i < argc ? argv[i] : "";
        } else if (argument == "--thresholds") {
            request.prints_thresholds = true;
        } else if (argument == "--print") {
            request.prints_scene = true;
        } else {
            request.scenes = number_in(argument);
        }
    }
    request.options.folder =
        std::filesystem::temp_directory_path() / fmt::format("stilb-random-scenes-{}", getuid());
    return request;
}

int run(const Request& request) {
    if (request.prints_thresholds) return check_thresholds(source_directory()) > 0 ? 1 : 0;
    std::filesystem::create_directories(request.options.folder);
    write_files(request.options.folder);
    if (request.prints_scene) {
        const RandomScene random = generate(request.options.seed, request.first);
        fmt::print("# {}; its luminaires are in {}\n{}", random.kind, request.options.folder.string(),
                   random.draft.text());
        return 0;
    }
    const Counts sums = check_all(request);
    fmt::print(
        "{} scenes from {}, seed {}: {} comparisons, {} disagreements, {} with a warning that explains them, "
        "{} "
        "refused; {:.0f} s of processor time\n",
        request.scenes, request.first, request.options.seed, sums.comparisons, sums.findings, sums.explained,
        sums.refused, sums.seconds);
    return sums.findings > 0 ? 1 : 0;
}

}  // namespace
}  // namespace stilb::random

int main(int argc, char** argv) try {
    return stilb::random::run(stilb::random::parse(argc, argv));
} catch (const std::invalid_argument& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
}
