// Warnings with one sentence for many things.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace stilb::io {

/// Things of one kind ("material", "light") with the same message share one warning: "materials a, b: ...".
class GroupedWarnings {
  public:
    void add(std::string_view kind, std::string_view name, std::string_view message);
    /// In the order of the first thing of each.
    std::vector<std::string> texts() const;

  private:
    struct Warning {
        std::string kind, message;
        std::vector<std::string> names;
    };
    std::vector<Warning> warnings_;
};

}  // namespace stilb::io
