#include "io/scene/defaults.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace stilb::io {
namespace {

/// Keys of which a table gives one at most.
constexpr std::array<std::array<std::string_view, 6>, 5> kAlternatives{
    {{"flux", "intensity", "luminance"},
     {"cct", "color"},
     {"position", "center", "corner", "points", "positions", "array"},
     {"direction", "target", "directions", "targets"},
     {"material", "mesh_group"}}};

/// Whether the table gives the key or an alternative.
bool decides(const TomlTable& table, std::string_view key) {
    if (table.has(key)) return true;
    return std::ranges::any_of(kAlternatives, [&](const auto& keys) {
        return std::ranges::find(keys, key) != keys.end() &&
               std::ranges::any_of(keys, [&](std::string_view other) { return table.has(other); });
    });
}

/// The keys of all types, each once.
std::vector<std::string_view> all_keys(const std::vector<TypeKeys>& types) {
    std::vector<std::string_view> all;
    for (const TypeKeys& type : types) {
        for (const std::string_view key : type.keys) {
            if (std::ranges::find(all, key) == all.end()) all.push_back(key);
        }
    }
    return all;
}

}  // namespace

Defaults::Defaults(TomlTable table, std::vector<TypeKeys> types)
    : table_(std::move(table)), types_(std::move(types)) {
    table_.expect_keys(all_keys(types_));
}

TomlTable Defaults::complete(const TomlTable& table) const {
    if (table_.members().empty()) return table;
    const std::string_view type = (table.has("type") ? table : table_).text_of("type");
    const auto found = std::ranges::find(types_, type, &TypeKeys::type);
    const auto is_taken = [&](std::string_view key) {
        // A table of an unknown type takes none but this; its reader says what is wrong.
        if (key == "type") return true;
        return found != types_.end() && std::ranges::find(found->keys, key) != found->keys.end();
    };
    TomlMembers members = table.members();
    for (const TomlMember& member : table_.members()) {
        if (is_taken(member.key) && !decides(table, member.key)) members.push_back(member);
    }
    return table.with(std::move(members));
}

}  // namespace stilb::io
