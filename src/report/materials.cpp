#include "report/materials.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "geometry/shape.h"
#include "io/image/tone_curve.h"
#include "io/import/textures/textured_surfaces.h"
#include "materials/model_list.h"
#include "report/drawing.h"

namespace stilb::report {
namespace {

std::string number_text(double value) { return fmt::format("{:.3g}", value); }
std::string number_text(const Rgb& value) { return number_text(value.luminance()); }
std::string number_text(bool value) { return value ? "yes" : "no"; }
std::string number_text(const materials::SharesByAngle& value) {
    return number_text(value.rows[0].share) + (value.is_along_normal() ? "" : " by angle");
}
std::string number_text(const std::array<double, 2>& values) {
    return fmt::format("{} × {}", number_text(values[0]), number_text(values[1]));
}

/// "diffuse 0.45, exponent 40", but for the reflectance, which has a column of its own.
std::string parameters_text(const Material& material) {
    return materials::visit_model(
        []<typename Model>(const Model& model) {
            std::string text;
            for_each_field<materials::ParametersOf<Model>>([&](const auto& field) {
                const auto& value = materials::parameters_of(model).*field.member;
                if (field.key == "reflectance" || !materials::is_given(value)) return;
                text += fmt::format("{}{} {}", text.empty() ? "" : ", ", field.key, number_text(value));
            });
            return text;
        },
        material);
}

/// As sRGB encodes it [IEC 61966-2-1].
double encoded(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

/// The colour of the material in white light.
Html swatch(const Rgb& reflectance) {
    const io::Colour colour{encoded(reflectance[0]), encoded(reflectance[1]), encoded(reflectance[2])};
    return element("span", {{"class", "swatch"}, {"style", "background:" + hexadecimal(colour)}});
}

/// By material.
std::vector<double> areas_m2(const Scene& scene) {
    std::vector<double> areas(scene.materials.size());
    const auto add = [&](MaterialId material, double surface_m2) {
        areas[index_of(material)] += surface_m2;
        if (const auto& back = scene.materials[index_of(material)].back) areas[index_of(*back)] += surface_m2;
    };
    for (const Object& object : scene.objects) {
        if (object.materials.size() == 1) {
            add(object.materials.front(), area_m2(object.shape));
            continue;
        }
        for (std::size_t t = 0; t < object.materials.size(); ++t) {
            const auto [a, b, c] = geometry::corners_of(object.shape, t);
            add(object.materials[t], geometry::triangle_area_m2(a, b, c));
        }
    }
    return areas;
}

/// Materials in one line: one, or the colours of a texture.
struct Line {
    std::string name;
    Material material;  ///< the first
    std::size_t colours = 0;
    double area_m2 = 0;
    Rgb reflected_m2 = {};  ///< the mean reflectance times the area

    void add(const Material& added, double added_m2) {
        ++colours;
        area_m2 += added_m2;
        reflected_m2 += added_m2 * stated_reflectance(added);
    }
    Rgb reflectance() const {
        return colours == 1 || area_m2 <= 0 ? stated_reflectance(material) : reflected_m2 * (1 / area_m2);
    }
};

std::vector<Line> lines_of(const Scene& scene) {
    std::vector<Line> lines;
    std::map<std::string, std::size_t, std::less<>> textures;
    const std::vector<double> areas = areas_m2(scene);
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const std::string& name = scene.materials[i].name;
        const Material& material = scene.materials[i].material;
        const std::string texture(io::material_of_colour(name));
        std::size_t line = lines.size();
        if (!texture.empty()) line = textures.try_emplace(texture, line).first->second;
        if (line == lines.size())
            lines.push_back({texture.empty() ? name : texture + " (texture)", material});
        lines[line].add(material, areas[i]);
    }
    return lines;
}

}  // namespace

Html materials_table(const Scene& scene) {
    using enum Table::Column;
    Table table({{"Material"},
                 {"Type"},
                 {"Reflectance", numbers},
                 {"Red, green, blue"},
                 {"Area [m²]", numbers},
                 {"Parameters"}});
    for (const Line& line : lines_of(scene)) {
        const Material& material = line.material;
        const Rgb reflectance = line.reflectance();
        const std::string_view type = materials::type_name(material);
        std::string parameters = parameters_text(material);
        // Types that have a transmittance state it themselves.
        if (passes_straight(material) && parameters.find("transmittance ") == parameters.npos)
            parameters += fmt::format(", transmittance {}", number_text(straight_transmittance(material, 1)));
        if (line.colours > 1) parameters = fmt::format("{} colours", line.colours);
        table.add({swatch(reflectance) + text(line.name), text(type),
                   text(fmt::format("{:.2f}", reflectance.luminance())),
                   text(fmt::format("{:.2f} {:.2f} {:.2f}", reflectance[0], reflectance[1], reflectance[2])),
                   text(fmt::format("{:.4g}", line.area_m2)), text(parameters)});
    }
    return table.is_empty() ? Html{} : table.html();
}

}  // namespace stilb::report
