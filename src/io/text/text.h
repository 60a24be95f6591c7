// Common parts of the readers of text formats.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "io/text/unread_bytes.h"

namespace stilb::io {

/// The file, byte for byte; the path "-" is standard input. Throws InputError where it cannot be read.
std::string read_whole_file(const std::filesystem::path& path);
/// The first bytes of the file, `most` or as many as there are. Throws as above.
std::string read_beginning(const std::filesystem::path& path, std::size_t most);

/// The extension with its dot, in lower case.
std::string extension_of(const std::filesystem::path& path);

/// `text` in quotes for a message: shortened, with bytes other than printable ASCII as \\xNN.
std::string in_quotes(std::string_view text);

/// The finite number that all of `text` represents ("+1", "1e-3"); none for any other text.
std::optional<double> parse_number(std::string_view text);
/// The same for a whole number.
std::optional<long long> parse_integer(std::string_view text);

/// The text without blanks at either end.
std::string_view trimmed(std::string_view text);

/// Takes the next word off the front of `text`: words are separated by blanks and tabs. Empty at the end.
std::string_view next_word(std::string_view& text);

/// Bytes as text, as data URIs have them [RFC 4648, section 4].
std::string base64(std::string_view bytes);

/// The inverse; nothing for any other text.
std::optional<std::string> from_base64(std::string_view text);

/// Reads a text line by line; lines end with LF or CR LF.
class TextLines {
  public:
    /// `first_line` is the number of the text's first line in its file.
    explicit TextLines(UnreadBytes text, std::size_t first_line = 1) : rest_(text), number_(first_line - 1) {}

    /// Moves to the next line; false at the end. Of a file, the view of the line before becomes invalid.
    bool next();
    /// The line without its end.
    std::string_view line() const { return line_; }
    std::size_t number() const { return number_; }
    /// The text after the line.
    const UnreadBytes& rest() const { return rest_; }

  private:
    UnreadBytes rest_;
    std::string_view line_;
    std::size_t number_;
};

/// The words and the unit of a key of results: "peak_intensity_cd" is "peak intensity" in "cd".
struct KeyWords {
    std::string words;
    std::string_view unit;  ///< may be empty
};
KeyWords words_of_key(std::string key);

// Common wording of error messages.

/// ` Did you mean "wall"? Allowed: wall, floor.` (the question only where a name is near), to follow a
/// sentence.
std::string suggestion(std::string_view found, std::span<const std::string_view> allowed);

// Fingerprints of scenes: 64 bits, FNV-1a. They detect changes by mistake, not forgery.

inline constexpr std::uint64_t kEmptyHash = 0xcbf29ce484222325;

/// The hash of a text with the hash `before`, followed by these bytes.
std::uint64_t hash_of(std::string_view bytes, std::uint64_t before = kEmptyHash);

/// The hash of the files' contents, one after another, as 16 hexadecimal digits. Throws InputError where one
/// cannot be read.
std::string content_hash(std::span<const std::filesystem::path> files);

/// The hash of everything that a scene's light depends on: the materials, objects and lights of the scene
/// file, by their keys and values, and the contents of the files that it refers to. Sensors, [run], the
/// title, comments and layout do not count; of a scene of another format, everything does. `sources`: the
/// scene file and the others (SceneFile), `overrides` those of the scene file. Throws InputError where one
/// cannot be read.
std::string light_hash(std::span<const std::filesystem::path> sources,
                       std::span<const std::string> overrides = {});

}  // namespace stilb::io
