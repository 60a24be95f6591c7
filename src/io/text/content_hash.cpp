#include "io/text/content_hash.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "io/scene/toml.h"
#include "io/text/text.h"

namespace stilb::io {
namespace {

constexpr std::array<std::string_view, 3> kLightSections{"materials", "objects", "lights"};

std::uint64_t hash_of_files(std::span<const std::filesystem::path> files, std::uint64_t hash) {
    for (const std::filesystem::path& file : files) hash = hash_of(read_whole_file(file), hash);
    return hash;
}

std::string digits(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

/// Appends the value in one way of writing, whatever that of the file: 1 and 1.0 are the same.
struct CanonicalText {
    std::string& text;

    void operator()(TomlDate) const { text += "date"; }
    void operator()(bool truth) const { text += truth ? "true" : "false"; }
    void operator()(std::int64_t integer) const { (*this)(static_cast<double>(integer)); }
    void operator()(double number) const { text += fmt::format("{}", number); }
    /// With its length: no text looks like two.
    void operator()(const std::string& words) const { text += fmt::format("{}:{}", words.size(), words); }
    void operator()(const TomlArray& array) const {
        text += '[';
        for (const TomlValue& value : array) {
            std::visit(*this, value.content);
            text += ',';
        }
        text += ']';
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

std::string light_hash(std::span<const std::filesystem::path> sources) {
    const std::filesystem::path& scene = sources.front();
    TomlValue document = parse_toml(read_whole_file(scene), scene.string());
    auto& sections = std::get<TomlMembers>(document.content);
    std::erase_if(sections, [](const TomlMember& section) {
        return std::ranges::find(kLightSections, section.key) == kLightSections.end();
    });
    std::ranges::sort(sections, {}, &TomlMember::key);
    std::string text;
    CanonicalText{text}(sections);
    return digits(hash_of_files(sources.subspan(1), hash_of(text)));
}

}  // namespace stilb::io
