#include "io/import/obj/mtl_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "io/text/text.h"
#include "io/text/utf8.h"

namespace stilb::io {
namespace {

using namespace std::string_view_literals;

constexpr double kLargestValue = 1e15;
/// Statements without an influence on the light that a surface reflects.
constexpr std::array kWithoutInfluence{"Ka"sv, "map_Ka"sv, "sharpness"sv, "map_aat"sv};

class MtlReader {
  public:
    explicit MtlReader(std::string_view content) : lines_(content) {}

    MtlLibrary read() && {
        while (lines_.next()) {
            std::string_view arguments = lines_.line();
            const std::string_view word = next_word(arguments);
            if (word.empty() || word[0] == '#') continue;
            if (word == "newmtl") {
                materials_.emplace_back();
                material().name = as_utf8(trimmed(arguments));
            } else if (!materials_.empty()) {
                obey(word, arguments);
            } else {
                library_remarks_.push_back(
                    fmt::format("line {}: {} stands before the first newmtl; it is left out.",
                                lines_.number(), in_quotes(word)));
            }
        }
        MtlLibrary library{{}, std::move(library_remarks_)};
        const bool is_opacity = std::ranges::any_of(materials_, &Stated::has_opacity_in_tr);
        for (Stated& stated : materials_) {
            set_opacity(stated, is_opacity);
            let_picture_count(stated.material);
            library.materials.push_back(std::move(stated.material));
        }
        return library;
    }

  private:
    /// A material with its statements about opacity, which programs use differently.
    struct Stated {
        MtlMaterial material;
        std::optional<double> d, tr;

        /// Tr 1 alone would make it invisible: then Tr is what d is, as MeshLab writes it.
        bool has_opacity_in_tr() const { return tr && *tr >= 1 && !d; }
    };

    MtlMaterial& material() { return materials_.back().material; }

    void remark(std::string sentence) { material().remarks.push_back(std::move(sentence)); }

    void obey(std::string_view word, std::string_view arguments) {
        if (word == "Kd")
            read_colour(word, arguments, material().diffuse);
        else if (word == "Ks")
            read_colour(word, arguments, material().specular);
        else if (word == "Ke")
            read_colour(word, arguments, material().emission_cd_m2);
        else if (word == "Tf")
            read_colour(word, arguments, material().filter);
        else if (word == "Ns")
            material().exponent = number(word, arguments, kLargestValue).value_or(material().exponent);
        else if (word == "Ni")
            material().ior = number(word, arguments, kLargestValue);
        else if (word == "Pr")
            material().roughness = number(word, arguments, 1);
        else if (word == "Pm")
            material().metallic = number(word, arguments, 1);
        else if (word == "d")
            materials_.back().d = opacity(word, arguments);
        else if (word == "Tr")
            materials_.back().tr = number(word, arguments, 1);
        else if (word == "illum")
            read_illum(word, arguments);
        else if (word == "map_Kd")
            material().diffuse_map = picture(arguments);
        else if (word == "map_Ks")
            material().specular_map = picture(arguments);
        else if (word == "map_Ke")
            material().emission_map = picture(arguments);
        else if (word == "map_d")
            material().opacity_map = picture(arguments);
        else if (std::ranges::find(kWithoutInfluence, word) == kWithoutInfluence.end())
            remark(fmt::format("its statement {} is left out.", in_quotes(word)));
    }

    void read_illum(std::string_view word, std::string_view arguments) {
        constexpr double kMostModels = 10;
        const auto model = number(word, arguments, kMostModels);
        if (model) material().illum = static_cast<int>(*model);
    }

    /// Of numbers beyond the range its end; nothing where there is no number.
    std::optional<double> number(std::string_view word, std::string_view& arguments, double most) {
        const std::string_view found = next_word(arguments);
        const auto value = parse_number(found);
        if (value && *value >= 0 && *value <= most) return value;
        const std::string allowed =
            fmt::format("{} is {}. Allowed: a number from 0 to {}", word, in_quotes(found), most);
        if (!value) {
            remark(allowed + "; the statement is left out.");
            return std::nullopt;
        }
        const double used = std::clamp(*value, 0.0, most);
        remark(fmt::format("{}; {} is used.", allowed, used));
        return used;
    }

    /// "d 0.5", or "d -halo 0.5".
    std::optional<double> opacity(std::string_view word, std::string_view arguments) {
        std::string_view rest = arguments;
        if (next_word(rest) == "-halo") arguments = rest;
        return number(word, arguments, 1);
    }

    /// Three numbers, or one for all of them.
    void read_colour(std::string_view word, std::string_view arguments, Rgb& colour) {
        std::string_view rest = arguments;
        const std::string_view first = next_word(rest);
        if (first == "spectral" || first == "xyz") {
            remark(fmt::format("{} {} is not read. Allowed: {} r g b.", word, first, word));
            return;
        }
        std::array<double, 3> bands{};
        for (std::size_t b = 0; b < bands.size(); ++b) {
            if (b == 1 && (trimmed(arguments).empty() || trimmed(arguments).starts_with('#'))) {
                colour = Rgb::grey(bands[0]);
                return;
            }
            const auto value = number(word, arguments, kLargestValue);
            if (!value) return;
            bands[b] = *value;
        }
        colour = {{bands[0], bands[1], bands[2]}};
    }

    /// d counts before Tr, and Tr as 1 - d; but not where a material would become invisible by it, or by only
    /// one of the two.
    void set_opacity(Stated& stated, bool tr_is_opacity) {
        const auto& [d, tr] = std::pair(stated.d, stated.tr);
        MtlMaterial& material = stated.material;
        if (d && tr && std::abs(*d - (1 - *tr)) > kRounding) {
            material.opacity = *d > 0 ? *d : 1;
            material.remarks.push_back(fmt::format("d {} and Tr {} contradict each other; d {} is used.", *d,
                                                   *tr, material.opacity));
        } else if (d) {
            material.opacity = *d;
        } else if (tr && tr_is_opacity) {
            material.opacity = *tr;
            material.remarks.push_back(fmt::format(
                "Tr {} is taken as d {}, as some programs mean it: otherwise materials of the file with Tr 1 "
                "would be invisible.",
                *tr, *tr));
        } else if (tr) {
            material.opacity = 1 - *tr;
        }
    }

    /// Some exporters write Kd 0 beside a picture, which it would make black.
    static void let_picture_count(MtlMaterial& material) {
        if (material.diffuse_map.file.empty() || material.diffuse.max() > 0) return;
        material.diffuse = Rgb::grey(1);
        material.remarks.push_back("Kd 0 would make its map_Kd black; the picture alone counts.");
    }

    static constexpr double kRounding = 1e-3;

    /// Options such as "-s 1 1 1", and the name that follows them and their values.
    static MtlPicture picture(std::string_view arguments) {
        MtlPicture picture;
        std::string_view rest = trimmed(arguments);
        while (rest.starts_with('-')) {
            const std::string_view option = next_word(rest);
            std::vector<std::string_view> values;
            rest = trimmed(rest);
            if (takes_word(option)) {
                next_word(rest);
                rest = trimmed(rest);
            }
            while (true) {
                std::string_view after = rest;
                const std::string_view value = next_word(after);
                const bool is_value = parse_number(value) || value == "on" || value == "off";
                if (!is_value || trimmed(after).empty()) break;
                values.push_back(value);
                rest = trimmed(after);
            }
            obey_option(option, values, picture);
        }
        picture.file = rest;
        return picture;
    }

    /// Options whose value is a word that is no number.
    static bool takes_word(std::string_view option) {
        return option == "-imfchan" || option == "-type" || option == "-colorspace";
    }

    static void obey_option(std::string_view option, const std::vector<std::string_view>& values,
                            MtlPicture& picture) {
        if (option == "-clamp") picture.is_clamped = !values.empty() && values[0] == "on";
        if (option != "-s" && option != "-o") return;
        auto& numbers = option == "-s" ? picture.scale : picture.offset;
        for (std::size_t i = 0; i < std::min(values.size(), numbers.size()); ++i)
            numbers[i] = parse_number(values[i]).value_or(numbers[i]);
    }

    TextLines lines_;
    std::vector<Stated> materials_;
    std::vector<std::string> library_remarks_;
};

}  // namespace

MtlLibrary read_mtl(std::string_view content) {
    if (content.starts_with("\xef\xbb\xbf")) content.remove_prefix(3);  // UTF-8's byte order mark
    return MtlReader(content).read();
}

}  // namespace stilb::io
