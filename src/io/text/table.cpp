
#include "io/text/table.h"

#include <fmt/format.h>

#include <atomic>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <random>
#include <stdexcept>
#include <system_error>

#include "stilb/error.h"

namespace stilb::io {

namespace {

using Parts = std::span<const std::string_view>;

InputError cannot_write(const std::filesystem::path& path) {
    return InputError(
        fmt::format("cannot write '{}'. Check that its folder exists and is writable, and that its disk has "
                    "space left.",
                    path.string()));
}

/// Whether the path is a device, say, which must not be replaced by a plain file.
bool must_stay(const std::filesystem::path& path) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::symlink_status(path, error);
    return std::filesystem::exists(status) && !std::filesystem::is_regular_file(status);
}

/// The path without links at its end; as it is where it leads to no file.
std::filesystem::path without_links(const std::filesystem::path& path) {
    std::error_code error;
    std::filesystem::path target = std::filesystem::canonical(path, error);
    return error ? path : target;
}

void write_parts(const std::filesystem::path& path, Parts parts) {
    std::ofstream file(path, std::ios::binary);
    for (const std::string_view part : parts)
        file.write(part.data(), static_cast<std::streamsize>(part.size()));
    file.close();
    if (!file) throw cannot_write(path);
}

std::atomic<const char*> unfinished = nullptr;
static_assert(std::atomic<const char*>::is_always_lock_free, "a signal handler reads it");

/// As long as a file system's names may be, even where the other name is.
std::filesystem::path temporary_name(const std::filesystem::path& beside) {
    constexpr std::size_t most_bytes = 255;
    const std::string ending = fmt::format(".{:08x}", std::random_device()());
    return beside.parent_path() / (beside.filename().string().substr(0, most_bytes - ending.size()) + ending);
}

/// A new file beside another one, in the same folder, since a file cannot be renamed into another file
/// system. It is the unfinished one, and is removed at the end unless it has taken the other one's name.
class TemporaryFile {
  public:
    TemporaryFile(const std::filesystem::path& beside, Parts parts)
        : beside_(beside), path_(temporary_name(beside)) {
        const char* none = nullptr;
        is_announced_ = unfinished.compare_exchange_strong(none, path_.c_str());
        try {
            write_parts(path_, parts);
        } catch (const InputError&) {
            remove();
            throw cannot_write(beside);
        }
    }
    ~TemporaryFile() { remove(); }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;

    void take_name() {
        std::error_code error;
        std::filesystem::rename(path_, beside_, error);
        if (error) throw cannot_write(beside_);
    }

  private:
    void remove() {
        std::error_code error;
        std::filesystem::remove(path_, error);
        if (is_announced_) unfinished = nullptr;
    }

    std::filesystem::path beside_, path_;
    bool is_announced_ = false;
};

void replace_file_by(const std::filesystem::path& path, Parts parts) {
    if (is_standard_output(path)) {
        // Errors are not handled here: main() checks at the end whether standard output was written.
        for (const std::string_view part : parts) std::fwrite(part.data(), 1, part.size(), stdout);
        return;
    }
    const std::filesystem::path target = without_links(path);
    if (must_stay(target)) return write_parts(path, parts);
    TemporaryFile(target, parts).take_name();
}

}  // namespace

bool is_standard_output(const std::filesystem::path& path) { return path == "-"; }

void require_writable(const std::filesystem::path& path) {
    if (is_standard_output(path)) return;
    std::error_code error;
    const std::filesystem::path folder = path.parent_path();
    if (!folder.empty() && !std::filesystem::is_directory(folder, error)) {
        throw InputError(fmt::format("the file cannot be written: there is no folder '{}'. Create it first.",
                                     folder.string()),
                         {path.string()});
    }
    const std::filesystem::path target = without_links(path);
    if (std::filesystem::is_directory(target, error)) {
        throw InputError("the file cannot be written: this is a folder. Name a file in it.", {path.string()});
    }
    if (!must_stay(target)) const TemporaryFile attempt(target, {});
}

void write_file(const std::filesystem::path& path, std::string_view content) {
    write_parts(path, {&content, 1});
}

const char* unfinished_file() { return unfinished; }

void replace_file(const std::filesystem::path& path, std::string_view content) {
    replace_file_by(path, {&content, 1});
}

void replace_file(const std::filesystem::path& path, std::span<const std::string> parts) {
    replace_file_by(path, std::vector<std::string_view>(parts.begin(), parts.end()));
}

namespace {

std::string quoted_where_needed(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + '"';
}

std::string csv_cell(const std::string& text) { return quoted_where_needed(text); }
std::string csv_cell(double number) { return std::isnan(number) ? std::string() : fmt::format("{}", number); }

std::size_t length_of(const Column& column) {
    return std::visit([](const auto& cells) { return cells.size(); }, column.cells);
}

std::string line_of(std::span<const Column> columns, const auto& cell_of) {
    std::string line;
    for (const Column& column : columns) {
        if (&column != columns.data()) line += ',';
        line += cell_of(column);
    }
    return line + "\r\n";
}

}  // namespace

std::string to_csv(std::span<const Column> columns) {
    const std::size_t rows = columns.empty() ? 0 : length_of(columns.front());
    for (const Column& column : columns) {
        if (length_of(column) != rows) {
            throw std::invalid_argument("column '" + column.name + "' differs in length from the first");
        }
    }
    std::string csv = line_of(columns, [](const Column& column) { return csv_cell(column.name); });
    for (std::size_t row = 0; row < rows; ++row) {
        csv += line_of(columns, [row](const Column& column) {
            return std::visit([row](const auto& cells) { return csv_cell(cells[row]); }, column.cells);
        });
    }
    return csv;
}

void write_csv(std::span<const Column> columns, const std::filesystem::path& path) {
    replace_file(path, to_csv(columns));
}

}  // namespace stilb::io
