#include "files/content_hash.h"

#include <fmt/format.h>

#include <cstdint>

#include "files/text.h"

namespace stilb {

std::string content_hash(std::span<const std::filesystem::path> files) {
    std::uint64_t hash = 0xcbf29ce484222325;
    for (const std::filesystem::path& file : files) {
        for (const char c : read_whole_file(file)) {
            hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
        }
    }
    return fmt::format("{:016x}", hash);
}

}  // namespace stilb
