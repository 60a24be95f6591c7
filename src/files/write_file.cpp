#include "files/write_file.h"

#include <fmt/format.h>

#include <fstream>

#include "base/error.h"

namespace stilb {

void write_file(const std::filesystem::path& path, std::string_view content) {
    std::ofstream file(path, std::ios::binary);
    file.write(content.data(), static_cast<std::streamsize>(content.size()));
    file.close();
    if (!file) {
        throw InputError(
            fmt::format("cannot write '{}'. Does its folder exist, and may you write there?", path.string()));
    }
}

}  // namespace stilb
