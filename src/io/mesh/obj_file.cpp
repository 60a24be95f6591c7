// Wavefront OBJ: polygons with the names of their materials and groups. [Wavefront, Advanced Visualizer,
// appendix B1]
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>

#include "io/mesh/mesh_file.h"
#include "io/text/text.h"
#include "stilb/error.h"

namespace stilb::io {
namespace {

using namespace std::string_view_literals;

/// Statements that change nothing about surfaces of polygons.
constexpr std::array kIgnored{
    "vt"sv,   "vn"sv,    "vp"sv,       "s"sv,        "mtllib"sv, "l"sv,      "p"sv,          "mg"sv,
    "lod"sv,  "bevel"sv, "c_interp"sv, "d_interp"sv, "usemap"sv, "maplib"sv, "shadow_obj"sv, "trace_obj"sv,
    "deg"sv,  "bmat"sv,  "step"sv,     "cstype"sv,   "ctech"sv,  "stech"sv,  "curv"sv,       "curv2"sv,
    "parm"sv, "trim"sv,  "hole"sv,     "scrv"sv,     "sp"sv,     "end"sv,    "con"sv};
/// Statements that bring surfaces which this reader cannot make: without them the scene would be another.
constexpr std::array kSurfaces{"surf"sv, "fo"sv,  "bzp"sv,  "bsp"sv, "cdc"sv,
                               "cdp"sv,  "res"sv, "call"sv, "csh"sv};

bool contains(std::span<const std::string_view> names, std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

class ObjReader {
  public:
    ObjReader(std::string_view content, const std::string& name) : lines_(content), name_(name) {}

    MeshFile read() && {
        while (next_statement()) {
            std::string_view arguments = statement_;
            const std::string_view word = next_word(arguments);
            if (!word.empty() && word[0] != '#') obey(word, arguments);
        }
        return std::move(builder_).finish(name_, "an OBJ file needs faces, such as: f 1 2 3");
    }

  private:
    [[noreturn]] void fail(const std::string& message) const { throw InputError(message, {name_, line_}); }

    /// The next line, with those that a backslash at its end joins to it. A comment is never joined: a path
    /// in it may well end in a backslash.
    bool next_statement() {
        if (!lines_.next()) return false;
        statement_ = lines_.line();
        line_ = lines_.number();
        if (!statement_.ends_with('\\') || trimmed(statement_).starts_with('#')) return true;
        joined_.clear();
        for (std::string_view part = statement_;; part = lines_.line()) {
            const bool goes_on = part.ends_with('\\');
            joined_ += part.substr(0, part.size() - (goes_on ? 1 : 0));
            joined_ += ' ';
            if (!goes_on) break;
            if (!lines_.next()) fail("the file ends after a backslash, which says that the line goes on");
        }
        statement_ = joined_;
        return true;
    }

    void obey(std::string_view word, std::string_view arguments) {
        if (word == "v") return read_vertex(arguments);
        if (word == "f") return read_face(arguments);
        if (word == "usemtl") return builder_.use_material(trimmed(arguments));
        if (word == "g" || word == "o") return builder_.use_group(trimmed(arguments));
        if (contains(kIgnored, word)) return;
        if (contains(kSurfaces, word)) {
            fail(fmt::format(
                "the statement {} is not read, and its surface would be missing; export polygons (f) instead",
                in_quotes(word)));
        }
        fail(fmt::format(
            "{} is no OBJ statement (is this a text file in the OBJ format?); allowed are v, f, g, o, usemtl "
            "and others that are ignored",
            in_quotes(word)));
    }

    void read_vertex(std::string_view arguments) {
        std::array<double, 3> position{};
        for (std::size_t i = 0; i < 3; ++i) {
            const std::string_view word = next_word(arguments);
            if (word.empty() || word[0] == '#')
                fail(fmt::format("the vertex has {} coordinates; it needs three: v x y z", i));
            const auto value = parse_number(word);
            if (!value || !is_coordinate(*value))
                fail(fmt::format("the vertex's {} is {}; it must be a finite number, at most 1e30 in size",
                                 "xyz"[i], in_quotes(word)));
            position[i] = *value;
        }
        builder_.add_vertex({position[0], position[1], position[2]});
    }

    void read_face(std::string_view arguments) {
        corners_.clear();
        for (std::string_view word = next_word(arguments); !word.empty() && word[0] != '#';
             word = next_word(arguments))
            corners_.push_back(corner(word));
        if (corners_.size() < 3)
            fail(fmt::format("the face has {} corners; it needs three or more: f 1 2 3", corners_.size()));
        builder_.add_polygon(corners_);
    }

    /// The vertex that a word of a face names: v, v/vt, v//vn or v/vt/vn.
    std::uint32_t corner(std::string_view word) const {
        const std::string_view vertex = word.substr(0, word.find('/'));
        const std::string_view others = word.substr(vertex.size());
        const auto index = parse_integer(vertex);
        if (!index || std::count(others.begin(), others.end(), '/') > 2 ||
            others.find_first_not_of("/-0123456789") != others.npos) {
            fail(fmt::format(
                "the face's corner is {}; it must be a vertex number, alone or as v/vt, v//vn or v/vt/vn",
                in_quotes(word)));
        }
        const auto count = static_cast<long long>(builder_.vertex_count());
        if (*index == 0 || *index > count || *index < -count) {
            fail(fmt::format(
                "the face's corner {} names vertex {}, but {} vertices stand before it; they count from 1, "
                "or backwards from -1",
                in_quotes(word), *index, count));
        }
        return static_cast<std::uint32_t>(*index > 0 ? *index - 1 : count + *index);
    }

    TextLines lines_;
    const std::string& name_;
    std::string_view statement_;
    std::size_t line_ = 0;  // where the statement begins
    std::string joined_;
    std::vector<std::uint32_t> corners_;
    MeshBuilder builder_;
};

/// Throws where a byte is of no text: binary files, and text of two bytes a character.
void check_text(std::string_view content, const std::string& name) {
    const auto is_wrong = [](char c) {
        return static_cast<unsigned char>(c) < ' ' && (c < '\t' || c > '\r');
    };
    const auto wrong = std::find_if(content.begin(), content.end(), is_wrong);
    if (wrong == content.end()) return;
    const auto line = static_cast<std::size_t>(std::count(content.begin(), wrong, '\n')) + 1;
    throw InputError(
        fmt::format(
            "byte 0x{:02x} is not text, so this is no OBJ file; it must be plain text (ASCII or UTF-8)",
            static_cast<unsigned char>(*wrong)),
        {name, line});
}

}  // namespace

MeshFile read_obj(std::string_view content, const std::string& name) {
    if (content.starts_with("\xef\xbb\xbf")) content.remove_prefix(3);  // UTF-8's byte order mark
    check_text(content, name);
    return ObjReader(content, name).read();
}

std::string to_obj(const Mesh& mesh) {
    std::string text;
    for (const Vec3& v : mesh.vertices) text += fmt::format("v {:.7g} {:.7g} {:.7g}\n", v.x, v.y, v.z);
    for (const auto& [a, b, c] : mesh.triangles) text += fmt::format("f {} {} {}\n", a + 1, b + 1, c + 1);
    return text;
}

}  // namespace stilb::io
