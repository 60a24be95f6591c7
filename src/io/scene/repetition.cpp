#include "io/scene/repetition.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

#include "io/scene/fields.h"
#include "io/text/text.h"

namespace stilb::io {
namespace {

constexpr sensors::CountLimit kArrayLimit{"[nu, nv]", 100'000, 100'000, "positions", "in an array"};

/// The step may be missing where there is only one position along it.
Vec3 read_step(const TomlTable& array, std::string_view key, int count) {
    if (count == 1 && !array.has(key)) return {};
    const TomlItem item = array.at(key);
    item.direction();  // fails where it is zero
    return item.vector();
}

std::vector<Vec3> read_array(const TomlItem& item) {
    TomlTable array = item.table();
    array.expect_keys({"origin", "step_u", "step_v", "count"}, "an array");
    const Vec3 origin = array.at("origin").vector();
    const auto [nu, nv] = read_counts(array.at("count"), kArrayLimit);
    const Vec3 step_u = read_step(array, "step_u", nu), step_v = read_step(array, "step_v", nv);
    std::vector<Vec3> positions;
    for (int v = 0; v < nv; ++v) {
        for (int u = 0; u < nu; ++u) {
            positions.push_back(origin + u * step_u + v * step_v);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                if (!kCoordinate.contains(positions.back()[axis]))
                    item.fail(fmt::format("reaches the coordinate {:g}. Allowed: {}.", positions.back()[axis],
                                          kCoordinate.allowed));
            }
        }
    }
    return positions;
}

TomlValue toml_of(const Vec3& v, std::size_t line) {
    return {TomlArray{{v.x, line}, {v.y, line}, {v.z, line}}, line};
}

/// The table once for each of its positions, which are then under `key`.
std::vector<RepeatedTable> copies_of(const NamedTable& named, std::string_view key) {
    const auto& [name, table] = named;
    const TomlTable::NamedItem source = table.one_of({key, "positions", "array"});
    TomlMembers common = table.members();
    const auto replaced = std::ranges::find(common, source.key, &TomlMember::key);
    const std::size_t line = replaced->line;
    common.erase(replaced);
    std::vector<RepeatedTable> copies;
    for (const Vec3& position : read_several_positions(source)) {
        TomlMembers members = common;
        members.push_back({std::string(key), line, toml_of(position, line)});
        copies.push_back(
            {fmt::format("{}_{}", name, copies.size() + 1), table.with(std::move(members)), name});
    }
    return copies;
}

}  // namespace

std::vector<Vec3> read_several_positions(const TomlTable::NamedItem& named) {
    const auto& [key, item] = named;
    if (key == "array") return read_array(item);
    std::vector<Vec3> positions;
    for (const TomlItem& position : read_list(item, key == "points" ? "point" : "position"))
        positions.push_back(position.vector());
    return positions;
}

std::vector<RepeatedTable> repeated_tables(const std::vector<NamedTable>& tables,
                                           const std::function<std::string_view(const TomlTable&)>& place) {
    std::vector<RepeatedTable> all;
    for (const NamedTable& named : tables) {
        const std::string_view key = place(named.table);
        if (!key.empty() && (named.table.has("positions") || named.table.has("array"))) {
            std::ranges::move(copies_of(named, key), std::back_inserter(all));
        } else {
            all.push_back({named.name, named.table, ""});
        }
    }
    std::set<std::string_view> names;
    for (const RepeatedTable& table : all) {
        if (names.insert(table.name).second) continue;
        table.table.fail(fmt::format(
            "the name {} occurs twice, as the copies of a table are named after it, with _1, _2 and so on. "
            "Allowed: another name for one of the two tables.",
            in_quotes(table.name)));
    }
    return all;
}

}  // namespace stilb::io
