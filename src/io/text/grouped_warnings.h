// Warnings about many things of one kind, in one sentence.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace stilb::io {

class GroupedWarnings {
  public:
    /// Things of one kind ("material", "light") with the same message share one warning.
    void add(std::string_view kind, std::string_view name, std::string_view message);
    /// "materials wall, floor: message" for each, in the order of their first things; long lists are cut off.
    std::vector<std::string> list() const;

  private:
    struct Warning {
        std::string kind, message;
        std::vector<std::string> names;
    };
    std::vector<Warning> warnings_;
    std::unordered_map<std::string, std::size_t> index_;  ///< by kind and message
};

}  // namespace stilb::io
