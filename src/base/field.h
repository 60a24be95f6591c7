// The parameters of materials and sensors. Each type lists its own once; the scene reader,
// validate(), `info` and the tables of the documents use that list.
//
//     struct Mirror {
//         Rgb reflectance;
//         static constexpr std::string_view kType = "mirror";
//         static constexpr auto fields() {
//             return std::tuple{Field{"reflectance", &Mirror::reflectance, kReflectance, "share of light
//             ..."}};
//         }
//     };
//
// A type whose parameters can contradict each other has a member contradiction(), which returns the message,
// or nothing.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>

#include "base/rgb.h"
#include "stilb/range.h"

namespace stilb {

/// The range that messages state for a parameter that is true or false.
inline constexpr Range kTruth{0, 1, "true or false"};
inline constexpr Range kAngle{-1e6, 1e6, "an angle from -1e6 to 1e6 degrees"};

/// Whether a key may be missing: the member then keeps its initial value.
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

/// The message for a number outside of the range.
std::string refusal(double value, const Range& range);

/// Throw an InputError that begins with `path`, the full name of the parameter, where the value is outside of
/// the range (or NaN); for colours and arrays it names the component, unless a colour is grey.
void expect_inside(double value, const Range& range, const std::string& path);
void expect_inside(const Rgb& value, const Range& range, const std::string& path);
void expect_inside(std::span<const double> values, const Range& range, const std::string& path);
inline void expect_inside(bool, const Range&, const std::string&) {}

/// Throws an InputError: "path: message".
[[noreturn]] void fail_at(std::string_view path, std::string_view message);

/// The contradiction between parameters that are each inside of their range.
template <typename T>
std::optional<std::string> contradiction_in(const T& parameters) {
    if constexpr (requires { parameters.contradiction(); }) {
        return parameters.contradiction();
    } else {
        return std::nullopt;
    }
}

/// Throws an InputError in the wording of the scene reader where a parameter is out of its range, or several
/// contradict each other. `path`: full name of the owner of the parameters, such as materials.wall.
template <typename T>
void validate_fields(const T& parameters, std::string_view path) {
    for_each_field<T>([&](const auto& field) {
        expect_inside(parameters.*field.member, field.range, std::string(path).append(".").append(field.key));
    });
    if (const auto message = contradiction_in(parameters)) fail_at(path, *message);
}

}  // namespace stilb
