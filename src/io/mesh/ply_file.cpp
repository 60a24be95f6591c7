// Stanford PLY, text and binary. [Turk 1994, The PLY polygon file format]

#include "io/mesh/ply_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <span>

#include "io/mesh/mesh_file.h"
#include "io/text/text.h"
#include "stilb/error.h"

namespace stilb::io {

namespace {

using namespace std::string_view_literals;

struct ScalarName {
    std::string_view name;
    PlyScalar scalar;
};
constexpr std::array<ScalarName, 16> kScalars{{{"char", PlyScalar::int8},
                                               {"int8", PlyScalar::int8},
                                               {"uchar", PlyScalar::uint8},
                                               {"uint8", PlyScalar::uint8},
                                               {"short", PlyScalar::int16},
                                               {"int16", PlyScalar::int16},
                                               {"ushort", PlyScalar::uint16},
                                               {"uint16", PlyScalar::uint16},
                                               {"int", PlyScalar::int32},
                                               {"int32", PlyScalar::int32},
                                               {"uint", PlyScalar::uint32},
                                               {"uint32", PlyScalar::uint32},
                                               {"float", PlyScalar::float32},
                                               {"float32", PlyScalar::float32},
                                               {"double", PlyScalar::float64},
                                               {"float64", PlyScalar::float64}}};
constexpr std::array kFormats{"ascii"sv, "binary_little_endian"sv, "binary_big_endian"sv};  // as in PlyFormat
constexpr std::array kStatements{"format"sv,  "element"sv,  "property"sv,
                                 "comment"sv, "obj_info"sv, "end_header"sv};

class HeaderReader {
  public:
    HeaderReader(UnreadBytes content, const std::string& name) : lines_(content), name_(name) {}

    PlyHeader read() && {
        if (!lines_.next() || lines_.line() != "ply")
            fail("this is not a PLY file: the first line must be ply");
        while (lines_.next()) {
            rest_ = lines_.line();
            const std::string_view word = next_word(rest_);
            if (word == "end_header") return finish();
            obey(word);
        }
        fail("the header has no end: a line end_header must close it");
    }

  private:
    [[noreturn]] void fail(const std::string& message) const {
        throw InputError(message, {name_, std::max<std::size_t>(lines_.number(), 1)});
    }

    void obey(std::string_view word) {
        if (word == "format") return read_format();
        if (word == "element") return read_element();
        if (word == "property") return read_property();
        if (word == "comment" || word == "obj_info" || word.empty()) return;
        const std::string meant = did_you_mean(word, kStatements);
        const std::string found = fmt::format(
            "the header says {}; allowed are format, element, property, comment, obj_info and end_header.",
            in_quotes(word));
        if (!meant.empty()) fail(found + meant);
        // A comment, or a statement of another program: what follows fits the header or not.
        header_.remarks.push_back(fmt::format("line {}: {} The line is left out.", lines_.number(), found));
    }

    void read_format() {
        const std::string_view format = next_word(rest_), version = next_word(rest_);
        const auto found = std::find(kFormats.begin(), kFormats.end(), format);
        if (found == kFormats.end()) {
            fail(fmt::format(
                "the format is {}; it must be ascii, binary_little_endian or binary_big_endian.{}",
                in_quotes(format), did_you_mean(format, kFormats)));
        }
        if (version != "1.0")
            fail(fmt::format("the format's version is {}; it must be 1.0", in_quotes(version)));
        header_.format = static_cast<PlyFormat>(found - kFormats.begin());
        has_format_ = true;
    }

    void read_element() {
        const std::string_view name = next_word(rest_), count = next_word(rest_);
        const auto value = parse_integer(count);
        if (!value || *value < 0) {
            fail(fmt::format(
                "the element {} has the count {}; it must be a whole number, 0 or more: element NAME COUNT",
                in_quotes(name), in_quotes(count)));
        }
        const auto has_name = [&](const PlyElement& element) { return element.name == name; };
        if (std::any_of(header_.elements.begin(), header_.elements.end(), has_name))
            fail(fmt::format("the element {} is declared twice; once is right", in_quotes(name)));
        header_.elements.push_back(
            {std::string(name), static_cast<std::uint64_t>(*value), {}, lines_.number()});
    }

    void read_property() {
        if (header_.elements.empty())
            fail("a property stands before any element; an element line must come first");
        const std::string_view first = next_word(rest_);
        PlyProperty property{};
        if (first == "list") {
            property.count_type = scalar(next_word(rest_));
            if (*property.count_type >= PlyScalar::float32)
                fail(
                    "a list's count is of a floating-point type; it must be of a whole-number type, such as "
                    "uchar");
        }
        property.type = scalar(property.is_list() ? next_word(rest_) : first);
        property.name = next_word(rest_);
        if (property.name.empty())
            fail(
                "the property has no name; the form is: property TYPE NAME, or property list COUNTTYPE TYPE "
                "NAME");
        std::vector<PlyProperty>& properties = header_.elements.back().properties;
        const auto has_name = [&](const PlyProperty& other) { return other.name == property.name; };
        if (std::any_of(properties.begin(), properties.end(), has_name))
            fail(fmt::format("the property {} is declared twice; once is right", in_quotes(property.name)));
        properties.push_back(std::move(property));
    }

    PlyScalar scalar(std::string_view name) const {
        std::array<std::string_view, kScalars.size()> names;
        std::transform(kScalars.begin(), kScalars.end(), names.begin(),
                       [](const ScalarName& s) { return s.name; });
        const auto found = std::find(names.begin(), names.end(), name);
        if (found == names.end()) {
            fail(
                fmt::format("the property's type is {}; allowed are char, uchar, short, ushort, int, uint, "
                            "float, double, "
                            "and int8 to float64.{}",
                            in_quotes(name), did_you_mean(name, names)));
        }
        return kScalars[static_cast<std::size_t>(found - names.begin())].scalar;
    }

    PlyHeader finish() {
        if (!has_format_) fail("the header has no format line; it needs one, such as: format ascii 1.0");
        header_.body = lines_.rest();
        header_.body_line = lines_.number() + 1;
        return std::move(header_);
    }

    TextLines lines_;
    const std::string& name_;
    std::string_view rest_;  // of the current line
    bool has_format_ = false;
    PlyHeader header_;
};

}  // namespace

std::size_t size_of(PlyScalar scalar) {
    constexpr std::array<std::size_t, 8> kSizes{1, 1, 2, 2, 4, 4, 4, 8};
    return kSizes[static_cast<std::size_t>(scalar)];
}

PlyHeader read_ply_header(UnreadBytes content, const std::string& name) {
    return HeaderReader(content, name).read();
}

namespace {

/// The position of the reader, for messages.
struct PlyLocation {
    const std::string& file;
    const PlyElement* element = nullptr;
    std::uint64_t row = 0;
    std::size_t line = 0;  ///< 0 in binary files

    [[noreturn]] void fail(const std::string& message) const {
        throw InputError(
            fmt::format("element {}, row {} of {}: {}", element->name, row + 1, element->count, message),
            {file, line});
    }
};

/// Whether a value can be a count or an index: PLY's integer types have no larger range.
bool is_index(double value) {
    return value >= 0 && value <= std::numeric_limits<std::uint32_t>::max() && value == std::floor(value);
}

/// Values as text: each row of an element has a line of its own.
class TextBody {
  public:
    TextBody(const PlyHeader& header, PlyLocation& location)
        : lines_(header.body, header.body_line), location_(location) {}

    const UnreadBytes& rest() const { return lines_.rest(); }
    /// The fewest bytes of a value in a row: a digit and a blank or line end.
    static std::size_t least_size(const PlyProperty&) { return 2; }

    void begin_row() {
        do {
            if (!lines_.next())
                location_.fail("the file ends too early: it is cut off, or the count is wrong");
            row_ = lines_.line();
            location_.line = lines_.number();
        } while (row_.find_first_not_of(" \t") == row_.npos);
    }
    void end_row() {
        const std::string_view word = next_word(row_);
        if (word.empty()) return;
        location_.fail(
            fmt::format("{} follows the last value; each row needs a line of its own", in_quotes(word)));
    }

    /// Words such as nan and inf are no number.
    double read(PlyScalar) {
        const std::string_view word = next_value();
        const auto value = parse_number(word);
        if (!value && word.find_first_of("nN") != word.npos) return std::numeric_limits<double>::quiet_NaN();
        if (!value) location_.fail(fmt::format("{} stands where a finite number must be", in_quotes(word)));
        return *value;
    }
    void skip(PlyScalar, std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) next_value();
    }

  private:
    std::string_view next_value() {
        const std::string_view word = next_word(row_);
        if (word.empty())
            location_.fail("the line ends too early; it needs all values that the header declares");
        return word;
    }

    TextLines lines_;
    PlyLocation& location_;
    std::string_view row_;  // the unread rest of the row
};

template <std::endian order>
class BinaryBody {
  public:
    BinaryBody(const PlyHeader& header, const PlyLocation& location)
        : rest_(header.body), location_(location) {}

    const UnreadBytes& rest() const { return rest_; }
    static std::size_t least_size(const PlyProperty& property) {
        return size_of(property.count_type.value_or(property.type));
    }

    void begin_row() {}
    void end_row() {}

    double read(PlyScalar scalar) {
        switch (scalar) {
            case PlyScalar::int8:
                return take<std::int8_t>();
            case PlyScalar::uint8:
                return take<std::uint8_t>();
            case PlyScalar::int16:
                return take<std::int16_t>();
            case PlyScalar::uint16:
                return take<std::uint16_t>();
            case PlyScalar::int32:
                return take<std::int32_t>();
            case PlyScalar::uint32:
                return take<std::uint32_t>();
            case PlyScalar::float32:
                return take<float>();
            case PlyScalar::float64:
                return take<double>();
        }
        return std::numeric_limits<double>::quiet_NaN();  // not reached: all scalars are above
    }
    void skip(PlyScalar scalar, std::size_t count) {
        if (count > rest_.size() / size_of(scalar)) fail_short();
        for (std::size_t bytes = count * size_of(scalar); bytes > 0;) {
            if (rest_.in_memory().empty()) rest_.extend();
            const std::size_t some = std::min(bytes, rest_.in_memory().size());
            rest_.remove_prefix(some);
            bytes -= some;
        }
    }

  private:
    [[noreturn]] void fail_short() const {
        location_.fail("the file ends too early: it is cut off, or the count is wrong");
    }

    template <class Number>
    Number take() {
        while (rest_.in_memory().size() < sizeof(Number)) {
            if (!rest_.extend()) fail_short();
        }
        std::array<char, sizeof(Number)> bytes;
        std::copy_n(rest_.in_memory().begin(), bytes.size(), bytes.begin());
        if constexpr (order != std::endian::native) std::reverse(bytes.begin(), bytes.end());
        rest_.remove_prefix(bytes.size());
        return std::bit_cast<Number>(bytes);
    }

    UnreadBytes rest_;
    const PlyLocation& location_;
};

template <class Body>
class PlyReader {
  public:
    PlyReader(const PlyHeader& header, const std::string& name)
        : header_(header), location_{name}, body_(header, location_) {}

    MeshFile read() && {
        for (const std::string& remark : header_.remarks) builder_.add_remark(remark);
        for (const PlyElement& element : header_.elements) {
            location_.element = &element;
            check_count(element);
            if (element.name == "vertex") {
                read_vertices(element);
            } else if (element.name == "face") {
                builder_.reserve_triangles(element.count);  // most files have no other polygons
                read_lists(element, [this] { add_face(); });
            } else if (element.name == "tristrips") {
                read_lists(element, [this] { add_strips(); });
            } else {
                read_rows(
                    element, [&](std::size_t i) { skip(element.properties[i]); }, [] {});
            }
        }
        check_end();
        return std::move(builder_).finish(
            location_.file, "a PLY file needs an element vertex and an element face (or tristrips)");
    }

  private:
    [[noreturn]] void fail_declaration(const PlyElement& element, const std::string& message) const {
        throw InputError(fmt::format("the element {} {}", element.name, message),
                         {location_.file, element.line});
    }

    /// Refuses counts that exceed the file's size, before any allocation or loop.
    void check_count(const PlyElement& element) const {
        if (element.count == 0) return;
        if (element.properties.empty()) fail_declaration(element, "has rows but no property; it needs one");
        std::size_t row_size = 0;
        for (const PlyProperty& property : element.properties) row_size += Body::least_size(property);
        const std::uintmax_t bytes_left =
            body_.rest().size() + 1;  // the last line of a text may do without its end
        if (element.count > bytes_left / row_size) {
            fail_declaration(element,
                             fmt::format("needs {} rows of at least {} bytes, but {} bytes are left; "
                                         "the count is wrong or the file is cut off",
                                         element.count, row_size, body_.rest().size()));
        }
    }

    void check_end() const {
        UnreadBytes rest = body_.rest();
        const std::uintmax_t size = rest.size();
        const std::string_view blanks("\r\n\t \0", 5);
        do {
            if (rest.in_memory().find_first_not_of(blanks) == std::string_view::npos) {
                rest.remove_prefix(rest.in_memory().size());
                continue;
            }
            throw InputError(
                fmt::format("{} bytes follow the last row that the header declares; its counts are wrong "
                            "or the file is damaged",
                            size),
                {location_.file});
        } while (rest.extend());
    }

    /// `read_property(i)` takes a row's values of property i off the body; `use_row()` is called at the row's
    /// end.
    template <class ReadProperty, class UseRow>
    void read_rows(const PlyElement& element, ReadProperty read_property, UseRow use_row) {
        for (location_.row = 0; location_.row < element.count; ++location_.row) {
            body_.begin_row();
            for (std::size_t i = 0; i < element.properties.size(); ++i) read_property(i);
            body_.end_row();
            use_row();
        }
    }

    void skip(const PlyProperty& property) {
        body_.skip(property.type, property.is_list() ? read_length(property) : 1);
    }

    std::size_t read_length(const PlyProperty& list) {
        const double length = body_.read(*list.count_type);
        if (!is_index(length)) {
            location_.fail(fmt::format("the list {} has the length {}; it must be a whole number, 0 or more",
                                       list.name, length));
        }
        return static_cast<std::size_t>(length);
    }

    /// The index of the scalar property of this name.
    static std::optional<std::size_t> scalar_named(const PlyElement& element, std::string_view name) {
        const auto has_name = [&](const PlyProperty& p) { return p.name == name && !p.is_list(); };
        const auto found = std::find_if(element.properties.begin(), element.properties.end(), has_name);
        if (found == element.properties.end()) return std::nullopt;
        return static_cast<std::size_t>(found - element.properties.begin());
    }

    void read_vertices(const PlyElement& element) {
        constexpr std::array<std::string_view, 3> kAxes{"x", "y", "z"}, kNormals{"nx", "ny", "nz"};
        std::array<double, 3> position{};
        std::array<double, 3> normal{};  // one that is no number counts as missing
        std::vector<double*> targets(element.properties.size(), nullptr);  // null: skipped
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto property = scalar_named(element, kAxes[axis]);
            if (!property)
                fail_declaration(element,
                                 fmt::format("has no property {}; it needs x, y and z", kAxes[axis]));
            targets[*property] = &position[axis];
        }
        const bool has_normals = std::ranges::all_of(
            kNormals, [&](std::string_view name) { return scalar_named(element, name).has_value(); });
        for (std::size_t axis = 0; has_normals && axis < 3; ++axis)
            targets[*scalar_named(element, kNormals[axis])] = &normal[axis];
        const auto read_property = [&](std::size_t i) {
            const PlyProperty& property = element.properties[i];
            if (targets[i] == nullptr) return skip(property);
            const double value = body_.read(property.type);
            if (!is_coordinate(value) && !property.name.starts_with('n')) {
                location_.fail(fmt::format("{} is {}; it must be a finite number, at most 1e30 in size",
                                           property.name, value));
            }
            *targets[i] = value;
        };
        builder_.reserve_vertices(element.count);
        read_rows(element, read_property, [&] {
            builder_.add_vertex({position[0], position[1], position[2]});
            if (has_normals) builder_.add_normal({normal[0], normal[1], normal[2]});
        });
    }

    /// Reads rows with a list of vertex indices into list_, and calls `use_list()` for each.
    template <class UseList>
    void read_lists(const PlyElement& element, UseList use_list) {
        const auto is_vertex_list = [](const PlyProperty& p) {
            return p.is_list() && (p.name == "vertex_indices" || p.name == "vertex_index");
        };
        const auto found = std::find_if(element.properties.begin(), element.properties.end(), is_vertex_list);
        if (found == element.properties.end()) {
            fail_declaration(element,
                             "has no list of vertices; it needs: property list uchar int vertex_indices");
        }
        if (element.count > 0 && builder_.vertex_count() == 0)
            fail_declaration(element, "stands before any vertex; the element vertex must come first");
        const auto read_property = [&](std::size_t i) {
            const PlyProperty& property = element.properties[i];
            if (&property != &*found) return skip(property);
            list_.clear();
            for (std::size_t left = read_length(property); left > 0; --left)
                list_.push_back(body_.read(property.type));
        };
        read_rows(element, read_property, use_list);
    }

    void add_face() {
        if (list_.empty()) location_.fail("the face has no corners; it needs three or more");
        corners_.clear();
        for (const double number : list_) corners_.push_back(vertex_index(number));
        if (corners_.size() < 3) return builder_.leave_out_face();
        builder_.add_polygon(corners_);
    }

    /// Strips, one after the other with -1 between: each corner makes a triangle with the two before it, and
    /// every second triangle of a strip runs the other way round.
    void add_strips() {
        corners_.clear();
        for (const double number : list_) {
            if (number == -1) {
                corners_.clear();
                continue;
            }
            corners_.push_back(vertex_index(number));
            const std::size_t count = corners_.size();
            if (count < 3) continue;
            const bool is_turned = count % 2 == 0;
            builder_.add_triangle({corners_[count - (is_turned ? 2 : 3)],
                                   corners_[count - (is_turned ? 3 : 2)], corners_[count - 1]});
        }
    }

    std::uint32_t vertex_index(double number) const {
        const auto last = static_cast<double>(builder_.vertex_count() - 1);
        if (!is_index(number) || number > last)
            location_.fail(
                fmt::format("the vertex number is {}; it must be a whole number from 0 to {}", number, last));
        return static_cast<std::uint32_t>(number);
    }

    const PlyHeader& header_;
    PlyLocation location_;
    Body body_;
    MeshBuilder builder_;
    std::vector<double> list_;
    std::vector<std::uint32_t> corners_;
};

}  // namespace

MeshFile read_ply(UnreadBytes content, const std::string& name) {
    const PlyHeader header = read_ply_header(content, name);
    switch (header.format) {
        case PlyFormat::ascii:
            return PlyReader<TextBody>(header, name).read();
        case PlyFormat::binary_little_endian:
            return PlyReader<BinaryBody<std::endian::little>>(header, name).read();
        case PlyFormat::binary_big_endian:
            break;
    }
    return PlyReader<BinaryBody<std::endian::big>>(header, name).read();
}

}  // namespace stilb::io
