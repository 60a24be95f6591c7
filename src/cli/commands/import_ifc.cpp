#include "cli/commands/import_ifc.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <optional>
#include <system_error>
#include <vector>

#include "cli/command_line.h"
#include "stilb/error.h"

namespace stilb::cli {
namespace {

/// The exit code of a program; nothing where it does not start or is ended by a signal.
std::optional<int> run_program(std::vector<std::string> words) {
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    pid_t process = 0;
    if (posix_spawnp(&process, arguments[0], nullptr, nullptr, arguments.data(), environ) != 0)
        return std::nullopt;
    int status = 0;
    if (waitpid(process, &status, 0) != process || !WIFEXITED(status)) return std::nullopt;
    return WEXITSTATUS(status);
}

/// The interpreter of the environment that this program is installed in, else the usual one. A wheel has the
/// program in lib/python3.11/site-packages/stilb.scripts, and a script that starts it in bin.
std::string python() {
    std::error_code error;
    const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
    if (error) return "python3";
    const bool is_of_wheel = folder.filename() == "stilb.scripts";
    const auto interpreter = (is_of_wheel ? folder / "../../../../bin" : folder) / "python3";
    return std::filesystem::exists(interpreter) ? interpreter.string() : "python3";
}

}  // namespace

int import_ifc(const IfcRequest& request) {
    const std::string interpreter = python();
    const char* const probe =
        "import importlib.util, sys\n"
        "sys.exit(not all(map(importlib.util.find_spec, ('stilb', 'ifcopenshell'))))";
    if (run_program({interpreter, "-c", probe}) != kExitDone) {
        throw InputError(
            "IFC is read by the Python package, with its extra: pip install \"stilb[ifc]\" (from a "
            "clone: pip install \".[ifc]\").",
            {request.file});
    }
    std::vector<std::string> words{interpreter, "-m", "stilb.ifc", request.file, "-o", request.output};
    if (!request.reflectances.empty()) {
        words.emplace_back("--reflectances");
        words.push_back(request.reflectances);
    }
    return run_program(std::move(words)).value_or(kExitStoppedEarly);
}

}  // namespace stilb::cli
