#include "io/import/obj/mtl_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/text/text.h"
#include "stilb/error.h"

namespace stilb::io {
namespace {

using namespace std::string_view_literals;

constexpr double kLargestValue = 1e15;
/// Statements without an influence on the light that a surface reflects.
constexpr std::array kWithoutInfluence{"Ka"sv, "map_Ka"sv, "sharpness"sv, "map_aat"sv};

class MtlReader {
  public:
    MtlReader(std::string_view content, const std::string& name) : lines_(content), name_(name) {}

    std::vector<MtlMaterial> read() && {
        while (lines_.next()) {
            std::string_view arguments = lines_.line();
            const std::string_view word = next_word(arguments);
            if (word.empty() || word[0] == '#') continue;
            if (word == "newmtl") {
                materials_.emplace_back();
                materials_.back().name = trimmed(arguments);
                materials_.back().line = lines_.number();
                continue;
            }
            if (materials_.empty()) fail(fmt::format("{} stands before the first newmtl.", in_quotes(word)));
            obey(word, arguments, materials_.back());
        }
        return std::move(materials_);
    }

  private:
    [[noreturn]] void fail(const std::string& message) const {
        throw InputError(message, {name_, lines_.number()});
    }

    void obey(std::string_view word, std::string_view arguments, MtlMaterial& material) {
        if (word == "Kd")
            material.diffuse = colour(word, arguments);
        else if (word == "Ks")
            material.specular = colour(word, arguments);
        else if (word == "Ke")
            material.emission_cd_m2 = colour(word, arguments);
        else if (word == "Tf")
            material.filter = colour(word, arguments);
        else if (word == "Ns")
            material.exponent = number(word, arguments, kLargestValue);
        else if (word == "Ni")
            material.ior = number(word, arguments, kLargestValue);
        else if (word == "Pr")
            material.roughness = number(word, arguments, 1);
        else if (word == "Pm")
            material.metallic = number(word, arguments, 1);
        else if (word == "d")
            material.opacity = opacity(word, arguments);
        else if (word == "Tr")
            material.opacity = 1 - number(word, arguments, 1);
        else if (word == "illum")
            material.illum = static_cast<int>(number(word, arguments, 10));
        else if (word == "map_Kd")
            material.diffuse_map = picture(arguments);
        else if (word == "map_Ks")
            material.specular_map = picture(arguments);
        else if (word == "map_Ke")
            material.emission_map = picture(arguments);
        else if (word == "map_d")
            material.opacity_map = picture(arguments);
        else if (std::ranges::find(kWithoutInfluence, word) == kWithoutInfluence.end())
            material.ignored.emplace_back(word);
    }

    double number(std::string_view word, std::string_view& arguments, double most) const {
        const std::string_view found = next_word(arguments);
        const auto value = parse_number(found);
        if (!value || !(*value >= 0 && *value <= most))
            fail(fmt::format("{} is {}. Allowed: a number from 0 to {}.", word, in_quotes(found), most));
        return *value;
    }

    /// "d 0.5", or "d -halo 0.5".
    double opacity(std::string_view word, std::string_view arguments) const {
        std::string_view rest = arguments;
        if (next_word(rest) == "-halo") arguments = rest;
        return number(word, arguments, 1);
    }

    /// Three numbers, or one for all of them.
    Rgb colour(std::string_view word, std::string_view arguments) const {
        std::string_view rest = arguments;
        const std::string_view first = next_word(rest);
        if (first == "spectral" || first == "xyz")
            fail(fmt::format("{} {} is not supported. Allowed: {} r g b.", word, first, word));
        const double red = number(word, arguments, kLargestValue);
        if (trimmed(arguments).empty() || trimmed(arguments).starts_with('#')) return Rgb::grey(red);
        const double green = number(word, arguments, kLargestValue);
        return {{red, green, number(word, arguments, kLargestValue)}};
    }

    /// Options such as "-s 1 1 1", and the name that follows them and their values.
    static MtlPicture picture(std::string_view arguments) {
        MtlPicture picture;
        std::string_view rest = trimmed(arguments);
        while (rest.starts_with('-')) {
            const std::string_view option = next_word(rest);
            std::vector<std::string_view> values;
            rest = trimmed(rest);
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

    static void obey_option(std::string_view option, const std::vector<std::string_view>& values,
                            MtlPicture& picture) {
        if (option == "-clamp") picture.is_clamped = !values.empty() && values[0] == "on";
        if (option != "-s" && option != "-o") return;
        auto& numbers = option == "-s" ? picture.scale : picture.offset;
        for (std::size_t i = 0; i < std::min(values.size(), numbers.size()); ++i)
            numbers[i] = parse_number(values[i]).value_or(numbers[i]);
    }

    TextLines lines_;
    const std::string& name_;
    std::vector<MtlMaterial> materials_;
};

}  // namespace

std::vector<MtlMaterial> read_mtl(std::string_view content, const std::string& name) {
    if (content.starts_with("\xef\xbb\xbf")) content.remove_prefix(3);  // UTF-8's byte order mark
    return MtlReader(content, name).read();
}

}  // namespace stilb::io
