// Parameters of materials, objects, lights and sensors: keys and values as in scene files
// (docs/scene-format.md).
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace stilb::api {

/// A place [m], a direction or a linear Rec. 709 colour.
using Triple = std::array<double, 3>;

/// What stands behind a key: true or false, a number, a text, or a list of values such as {0, 0, 1}.
class Value {
  public:
    using List = std::vector<Value>;
    using Content = std::variant<bool, std::int64_t, double, std::string, List>;

    Value(bool value) : content_(value) {}
    Value(int value) : content_(std::int64_t{value}) {}
    Value(std::int64_t value) : content_(value) {}
    Value(double value) : content_(value) {}
    Value(const char* text) : content_(std::string(text)) {}
    Value(std::string text) : content_(std::move(text)) {}
    Value(const Triple& triple) : content_(List(triple.begin(), triple.end())) {}
    Value(List list) : content_(std::move(list)) {}
    Value(std::initializer_list<Value> list) : content_(List(list)) {}

    const Content& content() const { return content_; }

  private:
    Content content_;
};

using Parameters = std::map<std::string, Value>;

}  // namespace stilb::api
