// Text files in UTF-8, and bytes of other encodings in them.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace stilb::io {

/// The text behind the byte-order mark that some editors write in front of it; all of it where there is none.
std::string_view without_byte_order_mark(std::string_view text);

/// The same. Throws InputError where the content is UTF-16.
std::string_view text_of(std::string_view content, const std::string& name);

/// The text of a file, without a byte-order mark. Throws as read_whole_file() and text_of() do.
std::string read_text_file(const std::filesystem::path& path);

/// The bytes as UTF-8: invalid ones are read as Latin-1, control characters become blanks.
std::string as_utf8(std::string_view bytes);
/// The same without blanks at either end.
std::string printable(std::string_view bytes);

}  // namespace stilb::io
