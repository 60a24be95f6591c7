#include "io/scene/overrides.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "io/text/text.h"
#include "stilb/error.h"

namespace stilb::io {
namespace {

/// A document with the one key.
TomlValue parse_override(const std::string& text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos)
        throw InputError("a key and a value are needed, such as materials.wall.reflectance=0.4.", {text});
    try {
        return parse_toml(text, text);
    } catch (const InputError&) {
        // Perhaps a text without quotes.
        std::string value = text.substr(equals + 1);
        value.erase(0, value.find_first_not_of(' '));
        if (value.find_first_of("'\n\"[]{}") != std::string::npos) throw;
        return parse_toml(text.substr(0, equals) + "='" + value + "'", text);
    }
}

/// Sets all lines to 0: messages must not name a line of the scene file for a value that is not in it.
void forget_lines(TomlValue& value) {
    value.line = 0;
    if (auto* members = std::get_if<TomlMembers>(&value.content)) {
        for (TomlMember& member : *members) {
            member.line = 0;
            forget_lines(member.value);
        }
    } else if (auto* array = std::get_if<TomlArray>(&value.content)) {
        for (TomlValue& element : *array) forget_lines(element);
    }
}

/// How many names the key of an override has: 3 of sensors.desk.normal.
std::size_t names_in_key(std::string_view text) {
    std::size_t names = 1;
    char quote = 0;
    for (const char c : text) {
        if (quote != 0) {
            if (c == quote) quote = 0;
        } else if (c == '\'' || c == '"') {
            quote = c;
        } else if (c == '=') {
            break;
        } else if (c == '.') {
            ++names;
        }
    }
    return names;
}

/// Puts overrides into a document, one after the other.
class Overriding {
  public:
    explicit Overriding(TomlMembers& document) : document_(document) {}

    void put(TomlMembers&& given, const std::string& text) {
        text_ = text;
        for (const TomlMember& section : given) {
            if (std::ranges::find(document_, section.key, &TomlMember::key) == document_.end())
                new_sections_.push_back(section.key);
        }
        merge(document_, std::move(given), "", names_in_key(text));
    }

  private:
    /// `path`: the names of the tables around both, joined by dots; empty for the document itself. `names`:
    /// how many of the key are left.
    void merge(TomlMembers& members, TomlMembers&& others, const std::string& path, std::size_t names) {
        for (TomlMember& other : others) {
            const std::string own_path = path.empty() ? other.key : path + "." + other.key;
            const auto found = std::ranges::find(members, other.key, &TomlMember::key);
            auto* const inner = std::get_if<TomlMembers>(&other.value.content);
            if (found == members.end()) {
                if (inner && !path.empty() && names > 1 && !is_of_new_section(path))
                    fail_missing(members, own_path, other.key);
                members.push_back(std::move(other));
                continue;
            }
            auto* const tables = std::get_if<TomlMembers>(&found->value.content);
            if (inner && tables)
                merge(*tables, std::move(*inner), own_path, names > 1 ? names - 1 : 1);
            else
                found->value = std::move(other.value);
        }
    }

    /// Sections that the document lacks are those of the overrides, which may go on with them.
    bool is_of_new_section(std::string_view path) const {
        return std::ranges::find(new_sections_, path.substr(0, path.find('.'))) != new_sections_.end();
    }

    [[noreturn]] void fail_missing(const TomlMembers& members, const std::string& path,
                                   const std::string& key) const {
        std::vector<std::string_view> known;
        for (const TomlMember& member : members) known.push_back(member.key);
        throw InputError(fmt::format("the scene has no {}.{}", path, did_you_mean(key, known)), {text_});
    }

    TomlMembers& document_;
    std::vector<std::string> new_sections_;
    std::string text_;  ///< the override, for messages
};

Rgb factor_of(const TomlValue& value, const std::string& text) {
    const auto number = [&](const TomlValue& given) {
        const auto* real = std::get_if<double>(&given.content);
        const auto* whole = std::get_if<std::int64_t>(&given.content);
        const double factor = real ? *real : whole ? static_cast<double>(*whole) : -1;
        if (factor >= 0 && std::isfinite(factor)) return factor;
        throw InputError(
            "a factor for light is a number of 0 or more, or three of them: lamp=0.4, "
            "lamp=[1, 0.8, 0.5].",
            {text});
    };
    const auto* bands = std::get_if<TomlArray>(&value.content);
    if (!bands || bands->size() != kBands) return Rgb::grey(number(value));
    return {{number((*bands)[0]), number((*bands)[1]), number((*bands)[2])}};
}

}  // namespace

void override_values(TomlMembers& document, std::span<const std::string> overrides) {
    Overriding overriding(document);
    for (const std::string& text : overrides) {
        TomlValue given = parse_override(text);
        forget_lines(given);
        overriding.put(std::move(std::get<TomlMembers>(given.content)), text);
    }
}

std::vector<LightFactor> take_light_factors(std::vector<std::string>& overrides) {
    std::vector<LightFactor> factors;
    std::erase_if(overrides, [&](const std::string& text) {
        const TomlValue given = parse_override(text);
        const TomlMember& member = std::get<TomlMembers>(given.content).front();
        if (std::holds_alternative<TomlMembers>(member.value.content)) return false;
        factors.push_back({member.key, factor_of(member.value, text)});
        return true;
    });
    return factors;
}

}  // namespace stilb::io
