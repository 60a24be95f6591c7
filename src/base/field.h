// The parameters of materials, lights and sensors. Each type lists its own once; the scene reader,
// validate(), `info` and the tables of the documents go by that list.
//
//     struct Mirror {
//         Rgb reflectance;
//         static constexpr std::string_view kType = "mirror";
//         static constexpr auto fields() {
//             return std::tuple{Field{"reflectance", &Mirror::reflectance, kReflectance, "share of light
//             ..."}};
//         }
//     };
#pragma once

#include <string_view>
#include <tuple>

namespace stilb {

/// The numbers that a parameter takes, and the words for them in messages: "2 is not {allowed}".
struct Range {
    double min = 0, max = 0;
    std::string_view allowed;

    constexpr bool contains(double value) const { return value >= min && value <= max; }
};

inline constexpr Range kAngle{-1e6, 1e6, "an angle from -1e6 to 1e6 degrees"};

/// Whether a key may be missing: then the member keeps the value that it is made with.
enum class Presence { required, optional };

/// One parameter of an Owner.
template <typename Owner, typename Value>
struct Field {
    std::string_view key;  ///< in scene files
    Value Owner::*member;
    Range range;               ///< of the number, or of each component
    std::string_view meaning;  ///< with its unit, for documents
    Presence presence = Presence::required;
};
template <typename Owner, typename Value>
Field(std::string_view, Value Owner::*, Range, std::string_view) -> Field<Owner, Value>;
template <typename Owner, typename Value>
Field(std::string_view, Value Owner::*, Range, std::string_view, Presence) -> Field<Owner, Value>;

/// Calls `visit(field)` for each parameter of T, in order.
template <typename T, typename Visit>
constexpr void for_each_field(const Visit& visit) {
    std::apply([&](const auto&... field) { (visit(field), ...); }, T::fields());
}

}  // namespace stilb
