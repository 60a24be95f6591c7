// The types of primitives, and their collection into a description.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "io/import/radiance/description.h"
#include "io/import/radiance/xform.h"

namespace stilb::io::radiance {

/// A primitive as it stands in a file.
struct Primitive {
    std::string modifier, type, name;
    std::vector<std::string> texts;
    std::vector<double> numbers;
    Place place;
};

enum class Role { surface, instance, modifier, alias, unknown };
/// The role of a type; `unknown` for words that are no type of Radiance.
Role role_of(std::string_view type);
/// The names of all types, for messages.
std::vector<std::string_view> type_names();
/// Whether the type is a material: the modifier that decides how a surface reflects or emits light.
bool is_material(std::string_view type);

/// Puts primitives into a description, with the names and the coordinates of the xforms around them.
class Collector {
  public:
    Collector(Description& description, const Limits& limits) : description_(description), limits_(limits) {}

    /// Throws InputError where the primitive is wrong.
    void add(Primitive primitive);
    /// A surface that a program made, checked as one of a file.
    void add_surface(SurfaceKind kind, const std::string& name, const std::string& modifier,
                     std::vector<double> numbers, const Place& place);
    /// The same with a modifier that is known by its index.
    void add_surface(SurfaceKind kind, const std::string& name, std::optional<std::size_t> modifier,
                     std::vector<double> numbers, const Place& place);
    /// The latest modifier of this name; none for "void". Throws InputError where there is none.
    std::optional<std::size_t> find(const std::string& name, const Place& place) const;

    /// The xforms around what is read.
    const Xform& xform() const { return xform_; }
    void set_xform(const Xform& xform) { xform_ = xform; }
    std::size_t size() const { return description_.modifiers.size() + description_.surfaces.size(); }

  private:
    void add_alias(const Primitive& primitive);
    void add_modifier(Modifier modifier);
    void count(const Place& place) const;

    Description& description_;
    Limits limits_;
    Xform xform_;
    std::unordered_map<std::string, std::size_t> latest_;
};

}  // namespace stilb::io::radiance
