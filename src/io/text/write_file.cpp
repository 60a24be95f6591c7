#include "io/text/write_file.h"

#include <fmt/format.h>

#include <fstream>
#include <random>
#include <system_error>

#include "base/error.h"

namespace stilb::io {
namespace {

InputError cannot_write(const std::filesystem::path& path) {
    return InputError(
        fmt::format("cannot write '{}'. Does its folder exist, and may you write there?", path.string()));
}

}  // namespace

void require_folder_of(const std::filesystem::path& path) {
    const std::filesystem::path folder = path.parent_path();
    if (!folder.empty() && !std::filesystem::is_directory(folder)) {
        throw InputError(
            fmt::format("it cannot be written: there is no folder '{}'. Make it first.", folder.string()),
            {path.string()});
    }
}

void write_file(const std::filesystem::path& path, std::string_view content) {
    std::ofstream file(path, std::ios::binary);
    file.write(content.data(), static_cast<std::streamsize>(content.size()));
    file.close();
    if (!file) throw cannot_write(path);
}

void replace_file(const std::filesystem::path& path, std::string_view content) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::symlink_status(path, error);
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
        return write_file(path, content);
    // In the same folder, since a file cannot be renamed into another file system.
    std::filesystem::path temporary = path;
    temporary += fmt::format(".{:08x}", std::random_device()());
    try {
        write_file(temporary, content);
    } catch (const InputError&) {
        std::filesystem::remove(temporary, error);
        throw cannot_write(path);
    }
    std::filesystem::rename(temporary, path, error);
    if (error) {
        std::filesystem::remove(temporary, error);
        throw cannot_write(path);
    }
}

}  // namespace stilb::io
