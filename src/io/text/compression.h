// Bytes in the format of gzip.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace stilb::io {

enum class Compression { fast, small };

/// The same bytes for the same input. Throws std::runtime_error where zlib fails.
std::string gzip(std::string_view bytes, Compression compression = Compression::small);

/// The bytes that gzip() had; nothing where `compressed` is damaged or holds another number of bytes. Takes
/// no more memory than `size`, whatever the input.
std::optional<std::string> gunzip(std::string_view compressed, std::size_t size);

}  // namespace stilb::io
