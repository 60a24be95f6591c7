#include "io/mesh/ply_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>

#include "base/error.h"
#include "io/text/text.h"

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

/// "; did you mean NAME?", where one is near.
std::string suggestion(std::string_view found, std::span<const std::string_view> allowed) {
    const std::string nearest = nearest_name(found, allowed);
    return nearest.empty() ? "" : fmt::format("; did you mean {}?", nearest);
}

class HeaderReader {
  public:
    HeaderReader(std::string_view content, const std::string& name) : lines_(content), name_(name) {}

    PlyHeader read() && {
        if (!lines_.next() || lines_.line() != "ply") fail("this is no PLY file: the first line must be ply");
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
        fail(fmt::format(
            "the header says {}; allowed are format, element, property, comment, obj_info and end_header{}",
            in_quotes(word), suggestion(word, kStatements)));
    }

    void read_format() {
        const std::string_view format = next_word(rest_), version = next_word(rest_);
        const auto found = std::find(kFormats.begin(), kFormats.end(), format);
        if (found == kFormats.end()) {
            fail(
                fmt::format("the format is {}; it must be ascii, binary_little_endian or binary_big_endian{}",
                            in_quotes(format), suggestion(format, kFormats)));
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
                            "and int8 to float64{}",
                            in_quotes(name), suggestion(name, names)));
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

PlyHeader read_ply_header(std::string_view content, const std::string& name) {
    return HeaderReader(content, name).read();
}

}  // namespace stilb::io
