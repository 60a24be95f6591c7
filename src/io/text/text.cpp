
#include "io/text/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iostream>
#include <iterator>
#include <limits>

#include "io/scene/overrides.h"
#include "io/scene/toml.h"
#include "io/text/file_kind.h"
#include "io/text/utf8.h"
#include "stilb/error.h"

namespace stilb::io {

namespace {

template <class Number>
std::optional<Number> parse_all(std::string_view text) {
    // from_chars takes no plus sign; "+-1" must not become -1 by its removal.
    if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
}

}  // namespace

std::string extension_of(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    for (char& c : extension) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return extension;
}

namespace {

/// All of standard input. It is kept, because files are read more than once: for their kinds, their contents
/// and their hashes.
const std::string& standard_input() {
    static const std::string content(std::istreambuf_iterator<char>(std::cin), {});
    return content;
}

}  // namespace

std::string read_beginning(const std::filesystem::path& path, std::size_t most) {
    if (path == "-") return standard_input().substr(0, most);
    InputFile file(path);
    std::string content(std::min<std::uintmax_t>(file.size(), most), '\0');
    file.read(content.data(), content.size());
    return content;
}

std::string read_whole_file(const std::filesystem::path& path) {
    return read_beginning(path, std::numeric_limits<std::size_t>::max());
}

std::string in_quotes(std::string_view text) {
    constexpr std::size_t kLongest = 40;
    std::string result = "\"";
    for (const char c : text.substr(0, kLongest)) {
        if (c >= ' ' && c <= '~') {
            result += c;
        } else {
            result += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
        }
    }
    return result + (text.size() > kLongest ? "...\"" : "\"");
}

std::optional<double> parse_number(std::string_view text) {
    const auto value = parse_all<double>(text);
    return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<long long> parse_integer(std::string_view text) { return parse_all<long long>(text); }

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view kBlanks = " \t\v\f";
    const std::size_t first = text.find_first_not_of(kBlanks);
    if (first == text.npos) return {};
    return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::string_view next_word(std::string_view& text) {
    const auto is_blank = [](char c) { return c == ' ' || c == '\t'; };
    const auto begin = std::find_if_not(text.begin(), text.end(), is_blank);
    const auto end = std::find_if(begin, text.end(), is_blank);
    text.remove_prefix(static_cast<std::size_t>(end - text.begin()));
    return {begin, end};
}

namespace {
constexpr std::string_view kBase64Digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
}  // namespace

std::string base64(std::string_view bytes) {
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::string_view three = bytes.substr(i, 3);
        std::uint32_t bits = 0;
        for (std::size_t j = 0; j < 3; ++j)
            bits = bits << 8 | (j < three.size() ? static_cast<unsigned char>(three[j]) : 0u);
        for (std::size_t j = 0; j < 4; ++j)
            text += j <= three.size() ? kBase64Digits[bits >> (18 - 6 * j) & 63] : '=';
    }
    return text;
}

std::optional<std::string> from_base64(std::string_view text) {
    while (text.ends_with('=')) text.remove_suffix(1);
    std::string bytes;
    std::uint32_t bits = 0;
    std::size_t count = 0;
    for (const char c : text) {
        const std::size_t digit = kBase64Digits.find(c);
        if (digit == kBase64Digits.npos) return std::nullopt;
        bits = bits << 6 | static_cast<std::uint32_t>(digit);
        if (++count % 4 != 1) bytes += static_cast<char>(bits >> (6 - 2 * ((count - 1) % 4)) & 255);
    }
    return bytes;
}

KeyWords words_of_key(std::string key) {
    constexpr std::array<std::array<std::string_view, 2>, 6> kUnits{
        {{"_cd_m2", "cd/m2"}, {"_m2", "m2"}, {"_lm", "lm"}, {"_cd", "cd"}, {"_lx", "lx"}, {"_w", "W"}}};
    KeyWords result{std::move(key), {}};
    for (const auto& [ending, unit] : kUnits) {
        if (!result.unit.empty() || !result.words.ends_with(ending)) continue;
        result.words.resize(result.words.size() - ending.size());
        result.unit = unit;
    }
    std::ranges::replace(result.words, '_', ' ');
    return result;
}

bool TextLines::next() {
    std::size_t end = rest_.in_memory().find('\n');
    for (std::size_t searched = rest_.in_memory().size(); end == std::string_view::npos && rest_.extend();
         searched = rest_.in_memory().size())
        end = rest_.in_memory().find('\n', searched);
    const std::string_view bytes = rest_.in_memory();
    if (bytes.empty()) return false;
    end = std::min(end, bytes.size());
    line_ = bytes.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, bytes.size()));
    if (line_.ends_with('\r')) line_.remove_suffix(1);
    ++number_;
    return true;
}

namespace {

std::string listed(std::span<const std::string_view> names) {
    constexpr std::size_t most = 30;
    std::string result;
    for (const std::string_view name : names.first(std::min(names.size(), most))) {
        if (!result.empty()) result += ", ";
        result += name.empty() ? "\"\"" : name;
    }
    if (names.size() > most) result += fmt::format(" and {} more", names.size() - most);
    return result;
}

}  // namespace

std::string suggestion(std::string_view found, std::span<const std::string_view> allowed) {
    if (allowed.empty()) return " No name is allowed here.";
    return fmt::format("{} Allowed: {}.", did_you_mean(found, allowed), listed(allowed));
}

namespace {

constexpr std::array<std::string_view, 3> kLightSections{"materials", "objects", "lights"};

std::uint64_t hash_of_files(std::span<const std::filesystem::path> files, std::uint64_t hash) {
    for (const std::filesystem::path& path : files) {
        if (path == "-") {
            hash = hash_of(standard_input(), hash);
            continue;
        }
        FilePieces file(path);
        while (file.left() > 0) hash = hash_of(file.extended({}), hash);
    }
    return hash;
}

std::string digits(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

/// Appends the value in a canonical form, independent of its form in the file: 1 and 1.0 are the same.
struct CanonicalText {
    std::string& text;

    void operator()(TomlDate) const { text += "date"; }
    void operator()(bool truth) const { text += truth ? "true" : "false"; }
    void operator()(std::int64_t integer) const { (*this)(static_cast<double>(integer)); }
    void operator()(double number) const { text += fmt::format("{}", number); }
    /// Appends the text with its length, so that two texts never read as one.
    void operator()(const std::string& words) const { text += fmt::format("{}:{}", words.size(), words); }
    void operator()(const TomlArray& array) const {
        text += '[';
        for (const TomlValue& value : array) {
            std::visit(*this, value.content);
            text += ',';
        }
        text += ']';
    }
    void operator()(const TomlVertices& vertices) const {
        for (const Vec3& v : *vertices) text += fmt::format("[{},{},{}]", v.x, v.y, v.z);
    }
    void operator()(const TomlTriangles& triangles) const {
        for (const auto& [a, b, c] : *triangles) text += fmt::format("[{},{},{}]", a, b, c);
    }
    void operator()(const TomlMembers& members) const {
        text += '{';
        for (const TomlMember& member : members) {
            (*this)(member.key);
            text += '=';
            std::visit(*this, member.value.content);
            text += ',';
        }
        text += '}';
    }
};

}  // namespace

std::uint64_t hash_of(std::string_view bytes, std::uint64_t hash) {
    for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
    return hash;
}

std::string content_hash(std::span<const std::filesystem::path> files) {
    return digits(hash_of_files(files, kEmptyHash));
}

namespace {

/// Of a scene that is no TOML file: everything in its files, and the overrides of what they say.
std::string foreign_light_hash(std::span<const std::filesystem::path> sources,
                               std::span<const std::string> overrides) {
    std::uint64_t hash = kEmptyHash;
    for (const std::string& text : overrides) {
        if (text.starts_with("import.") || text.starts_with("run.maintenance"))
            hash = hash_of(text + "\n", hash);
    }
    return digits(hash_of_files(sources, hash));
}

}  // namespace

std::string light_hash(std::span<const std::filesystem::path> sources,
                       std::span<const std::string> overrides) {
    const std::filesystem::path& scene = sources.front();
    if (!may_be_scene_file(kind_of_file(scene))) return foreign_light_hash(sources, overrides);
    TomlValue document = parse_toml(read_text_file(scene), scene.string());
    auto& sections = std::get<TomlMembers>(document.content);
    override_values(sections, overrides);
    std::erase_if(sections, [](const TomlMember& section) {
        return std::ranges::find(kLightSections, section.key) == kLightSections.end();
    });
    std::ranges::sort(sections, {}, &TomlMember::key);
    std::string text;
    CanonicalText{text}(sections);
    return digits(hash_of_files(sources.subspan(1), hash_of(text)));
}

}  // namespace stilb::io
