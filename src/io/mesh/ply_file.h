// The header of a PLY file and its body's format.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/text/unread_bytes.h"

namespace stilb::io {

enum class PlyScalar { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// Bytes in the binary formats.
std::size_t size_of(PlyScalar scalar);

struct PlyProperty {
    std::string name;
    PlyScalar type;
    std::optional<PlyScalar> count_type;  ///< of a list

    bool is_list() const { return count_type.has_value(); }
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;
    std::size_t line = 0;  ///< of its declaration
};

enum class PlyFormat { ascii, binary_little_endian, binary_big_endian };

struct PlyHeader {
    PlyFormat format = PlyFormat::ascii;
    std::vector<PlyElement> elements;
    UnreadBytes body{std::string_view()};  ///< everything after the header
    std::size_t body_line = 0;
    std::vector<std::string> remarks;  ///< sentences about lines that are left out
};

/// Throws InputError; `name` is the file's name for messages.
PlyHeader read_ply_header(UnreadBytes content, const std::string& name);

}  // namespace stilb::io
