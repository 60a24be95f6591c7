// Wavefront OBJ: polygons with the names of their materials and groups. [Wavefront, Advanced Visualizer,
// appendix B1]
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <span>

#include "io/mesh/mesh_file.h"
#include "io/text/text.h"
#include "stilb/error.h"

namespace stilb::io {
namespace {

using namespace std::string_view_literals;

/// Statements that do not affect polygonal surfaces.
constexpr std::array kIgnored{
    "vp"sv,       "s"sv,        "l"sv,      "p"sv,      "mg"sv,         "lod"sv,       "bevel"sv,
    "c_interp"sv, "d_interp"sv, "usemap"sv, "maplib"sv, "shadow_obj"sv, "trace_obj"sv, "deg"sv,
    "bmat"sv,     "step"sv,     "cstype"sv, "ctech"sv,  "stech"sv,      "curv"sv,      "curv2"sv,
    "parm"sv,     "trim"sv,     "hole"sv,   "scrv"sv,   "sp"sv,         "end"sv,       "con"sv};
/// Statements with surfaces that this reader does not support: ignoring them would change the scene.
constexpr std::array kSurfaces{"surf"sv, "fo"sv,  "bzp"sv,  "bsp"sv, "cdc"sv,
                               "cdp"sv,  "res"sv, "call"sv, "csh"sv};

constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";  // of UTF-8

bool contains(std::span<const std::string_view> names, std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

class ObjReader {
  public:
    ObjReader(UnreadBytes content, const std::string& name, TextureCoordinates coordinates)
        : lines_(content), name_(name), keeps_coordinates_(coordinates == TextureCoordinates::kept) {}

    MeshFile read() && {
        while (next_statement()) {
            std::string_view arguments = statement_;
            const std::string_view word = next_word(arguments);
            if (!word.empty() && word[0] != '#') obey(word, arguments);
        }
        if (builder_.triangle_count() == 0 && !unknown_.empty()) fail_unknown();
        add_remarks();
        MeshFile file = std::move(builder_).finish(name_, "an OBJ file needs faces, such as: f 1 2 3");
        if (file.mesh.corner_normals.empty()) file.mesh.normals.clear();  // no face names them
        return file;
    }

  private:
    [[noreturn]] void fail(const std::string& message) const { throw InputError(message, {name_, line_}); }

    /// The next line, joined with its continuation lines (a backslash at the end). A comment is never
    /// continued, because a path in it may well end in a backslash.
    bool next_statement() {
        if (!next_line()) return false;
        statement_ = lines_.line();
        line_ = lines_.number();
        if (line_ == 1 && statement_.starts_with(kByteOrderMark))
            statement_.remove_prefix(kByteOrderMark.size());
        if (!statement_.ends_with('\\') || trimmed(statement_).starts_with('#')) return true;
        joined_.clear();
        for (std::string_view part = statement_;; part = lines_.line()) {
            const bool goes_on = part.ends_with('\\');
            joined_ += part.substr(0, part.size() - (goes_on ? 1 : 0));
            joined_ += ' ';
            if (!goes_on) break;
            if (!next_line()) fail("the file ends after a backslash, which continues the line");
        }
        statement_ = joined_;
        return true;
    }

    /// Throws for bytes that are not text: binary files, and text with two bytes a character.
    bool next_line() {
        if (!lines_.next()) return false;
        const auto is_wrong = [](char c) {
            return static_cast<unsigned char>(c) < ' ' && (c < '\t' || c > '\r');
        };
        bool is_text = true;
        for (const char c : lines_.line())
            is_text &= !is_wrong(c);  // without an exit, so that it is vectorised
        if (is_text) return true;
        const auto wrong = std::ranges::find_if(lines_.line(), is_wrong);
        throw InputError(
            fmt::format(
                "byte 0x{:02x} is not text, so this is not an OBJ file; it must be plain text (ASCII or "
                "UTF-8)",
                static_cast<unsigned char>(*wrong)),
            {name_, lines_.number()});
    }

    void obey(std::string_view word, std::string_view arguments) {
        if (word == "v") return read_vertex(arguments);
        if (word == "vn") return read_normal(arguments);
        if (word == "vt") return read_texture_coordinates(arguments);
        if (word == "f") return read_face(arguments);
        if (word == "usemtl") return builder_.use_material(trimmed(arguments));
        if (word == "g" || word == "o") return builder_.use_group(trimmed(arguments));
        if (word == "mtllib") return builder_.add_material_library(trimmed(arguments));
        if (contains(kIgnored, word)) return;
        if (contains(kSurfaces, word)) {
            fail(
                fmt::format("the statement {} is not supported, and its surface would be missing; export "
                            "polygons (f) instead",
                            in_quotes(word)));
        }
        const bool is_new = std::ranges::find(unknown_, word, &Unknown::word) == unknown_.end();
        if (is_new && unknown_.size() < kMostUnknown) unknown_.push_back({std::string(word), line_});
    }

    [[noreturn]] void fail_unknown() {
        line_ = unknown_.front().line;
        fail(
            fmt::format("{} is not an OBJ statement (is this a text file in the OBJ format?); allowed are v, "
                        "f, g, o, usemtl "
                        "and others that are ignored",
                        in_quotes(unknown_.front().word)));
    }

    void add_remarks() {
        for (const auto& [word, line] : unknown_)
            builder_.add_remark(fmt::format("line {}: {} is not an OBJ statement; such lines are left out.",
                                            line, in_quotes(word)));
        if (missing_.corners > 0) {
            builder_.add_remark(
                fmt::format("line {}: the face's corner {} names a normal or a texture coordinate that does "
                            "not stand before it; {} such numbers are left out.",
                            missing_.line, in_quotes(missing_.word), missing_.corners));
        }
    }

    /// Reads three finite numbers, the coordinates of `what`.
    Vec3 read_triple(std::string_view arguments, std::string_view what, std::string_view form) const {
        std::array<double, 3> triple{};
        for (std::size_t i = 0; i < 3; ++i) {
            const std::string_view word = next_word(arguments);
            if (word.empty() || word[0] == '#')
                fail(fmt::format("the {} has {} coordinates; it needs three: {}", what, i, form));
            const auto value = parse_number(word);
            if (!value || !is_coordinate(*value))
                fail(fmt::format("the {}'s {} is {}; it must be a finite number, at most 1e30 in size", what,
                                 "xyz"[i], in_quotes(word)));
            triple[i] = *value;
        }
        return {triple[0], triple[1], triple[2]};
    }

    /// One that is no number counts as missing: the surface is there without it.
    void read_normal(std::string_view arguments) {
        std::array<double, 3> normal{};
        for (double& coordinate : normal)
            coordinate =
                parse_number(next_word(arguments)).value_or(std::numeric_limits<double>::quiet_NaN());
        builder_.add_normal({normal[0], normal[1], normal[2]});
    }

    void read_vertex(std::string_view arguments) {
        builder_.add_vertex(read_triple(arguments, "vertex", "v x y z"));
        const std::size_t count = builder_.vertex_count();
        if (count == 1) first_vertex_ = lines_.rest().size();
        if (count == kMany) builder_.reserve_vertices(expected_count(first_vertex_));
    }

    /// How many elements there are if the file goes on as it has begun with kMany of them, of which the first
    /// one stood before the last `first` bytes. Lists that grow by doubling would take twice the memory for a
    /// while; memory that is reserved in vain takes none.
    std::size_t expected_count(std::uintmax_t first) const {
        const auto left = static_cast<double>(lines_.rest().size());
        const double done = static_cast<double>(first) - left;
        return done > 0 ? kMany + static_cast<std::size_t>(kMany * left / done) : kMany;
    }

    /// One to three numbers, of which the third is not for pictures. Without a use they may be anything.
    void read_texture_coordinates(std::string_view arguments) {
        ++texture_coordinates_;
        if (!keeps_coordinates_) return;
        std::array<float, 2> uv{};
        for (float& coordinate : uv)
            coordinate = static_cast<float>(parse_number(next_word(arguments)).value_or(0));
        builder_.add_texture_coordinates(uv);
    }

    void read_face(std::string_view arguments) {
        corners_.clear();
        normals_.clear();
        coordinates_.clear();
        for (std::string_view word = next_word(arguments); !word.empty() && word[0] != '#';
             word = next_word(arguments))
            read_corner(word);
        if (corners_.empty()) fail("the face has no corners; it needs three or more: f 1 2 3");
        // Modellers leave such faces behind where corners were merged.
        if (corners_.size() < 3) return builder_.leave_out_face();
        // Most large files have neither, and lists without any would take as much memory as the triangles.
        if (builder_.normal_count() == 0) normals_.clear();
        if (texture_coordinates_ == 0) coordinates_.clear();
        builder_.add_polygon(corners_, normals_, coordinates_);
        const std::size_t count = builder_.triangle_count();
        if (first_face_ == 0) first_face_ = lines_.rest().size();
        if (count >= kMany && !is_reserved_) {
            is_reserved_ = true;
            builder_.reserve_triangles(expected_count(first_face_));
        }
    }

    /// The indices in a word of a face: v, v/vt, v//vn or v/vt/vn.
    void read_corner(std::string_view word) {
        std::array<std::string_view, 3> parts;
        std::string_view rest = word;
        std::size_t count = 0;
        for (bool goes_on = true; goes_on; ++count) {
            if (count == parts.size()) fail_corner(word);
            const std::size_t end = rest.find('/');
            goes_on = end != rest.npos;
            parts[count] = rest.substr(0, end);
            rest.remove_prefix(goes_on ? end + 1 : rest.size());
        }
        corners_.push_back(vertex_index(word, parts[0]));
        const std::uint32_t coordinates = optional_index(word, parts[1], texture_coordinates_);
        if (keeps_coordinates_) coordinates_.push_back(coordinates);
        normals_.push_back(optional_index(word, parts[2], builder_.normal_count()));
    }

    /// The index from 0 that a number has which counts from 1, or backwards from -1.
    static std::optional<std::uint32_t> index_in(long long number, std::size_t count) {
        const auto most = static_cast<long long>(count);
        if (number == 0 || number > most || number < -most) return std::nullopt;
        return static_cast<std::uint32_t>(number > 0 ? number - 1 : most + number);
    }

    std::uint32_t vertex_index(std::string_view word, std::string_view part) const {
        const auto number = parse_integer(part);
        if (!number) fail_corner(word);
        const auto index = index_in(*number, builder_.vertex_count());
        if (!index) {
            fail(
                fmt::format("the face's corner {} names vertex {}, but {} vertices stand before it; they "
                            "count from 1, or backwards from -1",
                            in_quotes(word), *number, builder_.vertex_count()));
        }
        return *index;
    }

    /// Of a texture coordinate or a normal: the surface is there without it, so that one that does not exist
    /// is left out.
    std::uint32_t optional_index(std::string_view word, std::string_view part, std::size_t count) {
        static_assert(kNoNormal == kNoCoordinates);
        if (part.empty()) return kNoNormal;
        const auto number = parse_integer(part);
        if (!number) fail_corner(word);
        if (const auto index = index_in(*number, count)) return *index;
        if (missing_.corners++ == 0) missing_ = {1, line_, std::string(word)};
        return kNoNormal;
    }

    [[noreturn]] void fail_corner(std::string_view word) const {
        fail(fmt::format(
            "the face's corner is {}; it must be a vertex number, alone or as v/vt, v//vn or v/vt/vn",
            in_quotes(word)));
    }

    static constexpr std::size_t kMany = 1 << 16;
    static constexpr std::size_t kMostUnknown = 8;

    struct Unknown {
        std::string word;
        std::size_t line = 0;  ///< of the first
    };
    /// Numbers of normals and texture coordinates that do not exist.
    struct Missing {
        std::size_t corners = 0;
        std::size_t line = 0;  ///< of the first
        std::string word;
    };

    TextLines lines_;
    const std::string& name_;
    std::uintmax_t first_vertex_ = 0, first_face_ = 0;  ///< bytes behind them
    bool is_reserved_ = false;                          ///< memory for the triangles
    std::string_view statement_;
    std::size_t line_ = 0;  // where the statement begins
    std::string joined_;
    bool keeps_coordinates_;
    std::vector<std::uint32_t> corners_, normals_, coordinates_;
    std::size_t texture_coordinates_ = 0;
    std::vector<Unknown> unknown_;
    Missing missing_;
    MeshBuilder builder_;
};

}  // namespace

MeshFile read_obj(UnreadBytes content, const std::string& name) {
    return read_obj(content, name, TextureCoordinates::ignored);
}

MeshFile read_obj(UnreadBytes content, const std::string& name, TextureCoordinates coordinates) {
    return ObjReader(content, name, coordinates).read();
}

}  // namespace stilb::io
