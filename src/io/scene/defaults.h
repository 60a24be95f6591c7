// The section [defaults]: values for the keys that the tables of other sections leave out.
#pragma once

#include <string_view>
#include <vector>

#include "io/scene/toml.h"

namespace stilb::io {

/// The keys of one type of material, light or sensor.
struct TypeKeys {
    std::string_view type;
    std::vector<std::string_view> keys;
};

/// Defaults for the tables of one section.
class Defaults {
  public:
    /// `table`: such as defaults.lights; `types`: those that take defaults. Throws where no type has the key.
    Defaults(TomlTable table, std::vector<TypeKeys> types);

    /// The table with the defaults for keys of its type that it does not give, neither themselves nor an
    /// alternative of them: a light with `color` takes no `cct`.
    TomlTable complete(const TomlTable& table) const;

  private:
    TomlTable table_;
    std::vector<TypeKeys> types_;
};

}  // namespace stilb::io
