#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "random/thresholds.h"

namespace stilb::random {
namespace {

/// Folders of the sources that decide on light and on what is said of it.
constexpr std::array<std::string_view, 14> kFolders{
    "base", "math",    "statistics", "geometry",  "materials", "lights",     "scene",
    "rays", "sensors", "patches",    "transport", "checks",    "estimators", "run"};

std::string text_of(const std::filesystem::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// The named numbers of a source file; of several in one declaration all.
std::vector<std::string> constants_of(const std::string& text) {
    static const std::regex first(
        R"(\bconstexpr (?:auto|(?:std::)?(?:size_t|u?int\d+_t)|int|unsigned|float|double|long long|Number))"
        R"( (\w+) = )");
    static const std::regex more(R"(, (\w+) = )");
    std::vector<std::string> names;
    for (std::sregex_iterator found(text.begin(), text.end(), first), end; found != end; ++found) {
        names.push_back((*found)[1]);
        const auto value = (*found)[0].second, last = std::find(value, text.end(), ';');
        for (std::sregex_iterator next(value, last, more); next != end; ++next) names.push_back((*next)[1]);
    }
    return names;
}

bool has_word(std::string_view words, std::string_view word) {
    return (' ' + std::string(words) + ' ').find(' ' + std::string(word) + ' ') != std::string::npos;
}

/// Whether a line of the file gives the constant this value.
bool is_in_its_file(const Threshold& threshold, const std::filesystem::path& sources) {
    std::ifstream file(sources / threshold.file);
    const std::string start = std::string(threshold.constant) + " = " + std::string(threshold.value);
    for (std::string line; std::getline(file, line);) {
        const std::size_t found = line.find(start);
        if (found == std::string::npos) continue;
        const std::size_t next = found + start.size();
        if (next == line.size() || line[next] == ';' || line[next] == ',') return true;
    }
    return false;
}

/// Prints the rows of the table in docs/verification.md.
int print_thresholds(const std::filesystem::path& sources) {
    int errors = 0;
    const std::string page = text_of(sources / "docs/verification.md");
    for (const Threshold& threshold : thresholds()) {
        const std::string row =
            fmt::format("| `{}` | {} | {} | {} | {} |", threshold.constant, threshold.file, threshold.value,
                        threshold.what, threshold.crossed);
        const bool is_true = is_in_its_file(threshold, sources);
        const bool is_told = page.find('\n' + row + '\n') != std::string::npos;
        fmt::print("{}{}{}\n", row, is_true ? "" : " NOT THERE WITH THIS VALUE",
                   is_told ? "" : " NOT IN docs/verification.md");
        errors += !is_true + !is_told;
        static const std::regex test(R"(tests/\w+/\w+\.cpp)");
        const std::string crossed(threshold.crossed);
        for (std::sregex_iterator found(crossed.begin(), crossed.end(), test), end; found != end; ++found) {
            if (std::filesystem::exists(sources / found->str())) continue;
            fmt::print("{}: there is no {}\n", threshold.constant, found->str());
            ++errors;
        }
    }
    return errors;
}

/// Numbers of the sources that stand in neither list.
int print_unlisted(const std::filesystem::path& sources) {
    int errors = 0;
    for (const std::string_view folder : kFolders) {
        for (const auto& entry : std::filesystem::recursive_directory_iterator(sources / "src" / folder)) {
            if (!entry.is_regular_file()) continue;
            const std::string file = std::filesystem::relative(entry.path(), sources).generic_string();
            for (const std::string& name : constants_of(text_of(entry.path()))) {
                const bool is_threshold = std::ranges::any_of(thresholds(), [&](const Threshold& threshold) {
                    return threshold.file == file && threshold.constant == name;
                });
                const bool is_other = std::ranges::any_of(other_constants(), [&](const OtherConstants& own) {
                    return own.file == file && has_word(own.names, name);
                });
                if (is_threshold || is_other) continue;
                fmt::print(
                    "{}: {} is in no list: does the program take another way there? Then "
                    "tests/random/thresholds.cpp lists it with what crosses it; otherwise "
                    "tests/random/other_constants.cpp does.\n",
                    file, name);
                ++errors;
            }
        }
    }
    return errors;
}

/// Names of the other list that the sources do not have any more.
int print_stale(const std::filesystem::path& sources) {
    int errors = 0;
    for (const OtherConstants& own : other_constants()) {
        const std::vector<std::string> there = constants_of(text_of(sources / own.file));
        std::istringstream names{std::string(own.names)};
        for (std::string name; names >> name;) {
            if (std::ranges::find(there, name) != there.end()) continue;
            fmt::print("{}: {} of tests/random/other_constants.cpp is not there\n", own.file, name);
            ++errors;
        }
    }
    return errors;
}

}  // namespace

int check_thresholds(const std::filesystem::path& sources) {
    return print_thresholds(sources) + print_unlisted(sources) + print_stale(sources);
}

}  // namespace stilb::random
