// One table for several lights or sensors: `positions = [[x, y, z], ...]` or `array = { origin, step_u,
// step_v, count }` in place of one position.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "io/scene/sections.h"

namespace stilb::io {

/// The positions under "positions" (or another list of triples) or "array", those of an array with u fastest.
std::vector<Vec3> read_several_positions(const TomlTable::NamedItem& item);

/// A table, or one of several copies of it.
struct RepeatedTable {
    std::string name;
    TomlTable table;
    std::string copy_of;  ///< the table's name in the file; empty where it is no copy
};

/// The tables; those with "positions" or "array" once for each position, which is then under the key that
/// `place` gives for the table (or nothing, where it cannot be repeated). Copies are named NAME_1, NAME_2 and
/// so on. Throws where a name occurs twice.
std::vector<RepeatedTable> repeated_tables(const std::vector<NamedTable>& tables,
                                           const std::function<std::string_view(const TomlTable&)>& place);

}  // namespace stilb::io
