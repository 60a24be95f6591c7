#include "cli/commands.h"

#include <CLI/CLI.hpp>

namespace stilb::cli {

void set_examples(CLI::App& command, const std::string& examples) {
    command.formatter_fn([examples](const CLI::App* app, std::string name, CLI::AppFormatMode mode) {
        return "Examples:\n" + examples + "\n" + CLI::Formatter().make_help(app, std::move(name), mode);
    });
}

}  // namespace stilb::cli
