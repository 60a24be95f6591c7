// A TOML file as a tree of plain values with their line numbers. The only interface to the TOML parser.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/field.h"
#include "base/rgb.h"
#include "base/vec.h"

namespace stilb::io {

struct TomlMember;
struct TomlValue;

using TomlArray = std::vector<TomlValue>;
/// In the order of the file.
using TomlMembers = std::vector<TomlMember>;
/// Dates and times, which no key accepts.
struct TomlDate {};
/// The vertices and the triangles of a mesh that was built in code: as arrays of arrays they would take
/// twenty times the memory.
using TomlVertices = std::shared_ptr<const std::vector<Vec3>>;
using TomlTriangles = std::shared_ptr<const std::vector<std::array<std::uint32_t, 3>>>;

struct TomlValue {
    std::variant<TomlDate, bool, std::int64_t, double, std::string, TomlArray, TomlMembers, TomlVertices,
                 TomlTriangles>
        content;
    std::size_t line = 0;
};

struct TomlMember {
    std::string key;
    std::size_t line = 0;  ///< of the key
    TomlValue value;
};

/// The top table of a TOML 1.0 text. Throws InputError for invalid TOML; `name` is used in messages.
TomlValue parse_toml(std::string_view text, const std::string& name);

// Typed access to a TOML document. Missing, unknown, mistyped or out-of-range values throw an
// InputError with the position, the value found and the allowed values.

/// Metres; the limit keeps squares and products of lengths far from overflow.
inline constexpr Range kCoordinate{-1e9, 1e9, "a number from -1e9 to 1e9"};
inline constexpr Range kRadius{1e-9, 1e9, "a length above 0 (from 1e-9 to 1e9 m)"};
/// Flux, intensity and luminance; and factors on them, of which 0 is a lamp that is off.
inline constexpr Range kLightQuantity{1e-15, 1e15, "a number above 0 (from 1e-15 to 1e15)"};
inline constexpr Range kDimming{0, 1e15, "a number from 0 to 1e15"};

class TomlTable;

/// A value and its full name, such as objects.room.translate.
class TomlItem {
  public:
    /// The value and the file's name must outlive the item.
    TomlItem(const TomlValue& value, std::string path, const std::string& file)
        : value_(&value), path_(std::move(path)), file_(&file) {}

    double number(const Range& range) const;
    /// A whole number; 1e6 is accepted for 1000000.
    std::int64_t integer(std::int64_t min, std::int64_t max) const;
    const std::string& text() const;
    /// true or false.
    bool boolean() const;
    /// [r, g, b], or one number for a grey triple.
    Rgb rgb(const Range& range) const;
    /// [x, y, z].
    Vec3 vector() const;
    /// [x, y, z], not zero, as a unit vector.
    Vec3 direction() const { return made_unit(vector()); }
    /// The value's direction as a unit vector; fails where it is zero.
    Vec3 made_unit(const Vec3& v) const;
    /// Array of any length.
    std::vector<TomlItem> elements() const;
    std::vector<double> numbers(std::size_t count, const Range& range) const;
    TomlTable table() const;
    /// The vertices or triangles of a mesh that was built in code; null for other values.
    const std::vector<Vec3>* vertices() const { return list<TomlVertices>(); }
    const std::vector<std::array<std::uint32_t, 3>>* triangles() const { return list<TomlTriangles>(); }

    bool is_text() const { return std::holds_alternative<std::string>(value_->content); }
    bool is_array() const { return std::holds_alternative<TomlArray>(value_->content); }
    bool is_table() const { return std::holds_alternative<TomlMembers>(value_->content); }

    /// Index of the text among the names. `what` is the kind of name for the message; names in `later` are
    /// reported as not supported yet.
    std::size_t index_in(std::span<const std::string_view> names, std::string_view what,
                         std::span<const std::string_view> later = {}) const;
    /// An existing regular file, its path relative to `directory`.
    std::filesystem::path existing_file(const std::filesystem::path& directory) const;

    [[noreturn]] void fail(std::string_view message) const;
    /// "file:line: path", the beginning of a warning.
    std::string where() const;

  private:
    [[noreturn]] void fail_type(std::string_view needed) const;
    const TomlArray& array_of(std::size_t count, std::string_view needed) const;
    TomlItem element(const TomlArray& array, std::size_t index) const;
    template <typename List>
    typename List::element_type* list() const {
        const List* const content = std::get_if<List>(&value_->content);
        return content ? content->get() : nullptr;
    }

    const TomlValue* value_;
    std::string path_;
    const std::string* file_;
};

class TomlTable {
  public:
    /// The members and the file's name must outlive the table. `line` is where the table begins.
    TomlTable(const TomlMembers& members, std::string path, const std::string& file, std::size_t line)
        : members_(&members), path_(std::move(path)), file_(&file), line_(line) {}

    const TomlMembers& members() const { return *members_; }
    /// A table in the same place of the file with these members, which it keeps. It must outlive its items.
    TomlTable with(TomlMembers members) const;

    /// Throws for any other key. `kind` is the owner of these keys, as in `for type "phong"`; may be empty.
    void expect_keys(const std::vector<std::string_view>& keys, std::string_view kind = "");

    struct NamedItem;
    /// In the order of the file.
    std::vector<NamedItem> items() const;
    bool has(std::string_view key) const { return find(key).has_value(); }
    std::optional<TomlItem> find(std::string_view key) const;
    TomlItem at(std::string_view key) const;
    /// The text under the key; empty where there is none.
    std::string_view text_of(std::string_view key) const;
    /// The name given by the key; `later` as in TomlItem::index_in().
    std::string_view choose(std::string_view key, std::span<const std::string_view> names,
                            std::span<const std::string_view> later = {}) const;
    /// The one of the keys that is present; throws where several or none are.
    NamedItem one_of(const std::vector<std::string_view>& keys) const;
    /// Throws where both keys are present.
    void expect_not_both(std::string_view first, std::string_view second) const;

    [[noreturn]] void fail(std::string_view message) const;
    std::string where() const;

  private:
    TomlItem item(const TomlMember& member) const;

    const TomlMembers* members_;
    std::shared_ptr<const TomlMembers> kept_;  ///< the same, where they are not those of the file
    std::string path_;
    const std::string* file_;
    std::size_t line_;
    std::string kind_;  ///< for messages
};

struct TomlTable::NamedItem {
    std::string key;
    TomlItem item;
};

}  // namespace stilb::io
