#include "report/materials.h"

#include <fmt/format.h>

#include <cmath>
#include <type_traits>
#include <variant>

#include "geometry/shape.h"
#include "io/image/tone_curve.h"
#include "report/drawing.h"

namespace stilb::report {
namespace {

std::string number_text(double value) { return fmt::format("{:.3g}", value); }
std::string number_text(const Rgb& value) { return number_text(value.luminance()); }
std::string number_text(const std::array<double, 2>& values) {
    return fmt::format("{} × {}", number_text(values[0]), number_text(values[1]));
}

/// "diffuse 0.45, exponent 40", but for the reflectance, which has a column of its own.
std::string parameters_text(const Material& material) {
    return std::visit(
        []<typename Model>(const Model& model) {
            std::string text;
            for_each_field<materials::ParametersOf<Model>>([&](const auto& field) {
                if (field.key == "reflectance") return;
                text += fmt::format("{}{} {}", text.empty() ? "" : ", ", field.key,
                                    number_text(materials::parameters_of(model).*field.member));
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

double area_of(const Scene& scene, std::uint32_t material) {
    double area = 0;
    for (const Object& object : scene.objects) {
        if (object.materials.size() == 1) {
            if (index_of(object.materials.front()) == material) area += area_m2(object.shape);
            continue;
        }
        const auto& mesh = std::get<Mesh>(object.shape);
        for (std::size_t t = 0; t < object.materials.size(); ++t) {
            if (index_of(object.materials[t]) != material) continue;
            area += geometry::triangle_area_m2(mesh, t);
        }
    }
    return area;
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
    for (std::uint32_t i = 0; i < scene.materials.size(); ++i) {
        const auto& [name, material] = scene.materials[i];
        const Rgb reflectance = stated_reflectance(material);
        const std::string_view type =
            std::visit([]<typename Model>(const Model&) { return Model::kType; }, material);
        std::string parameters = parameters_text(material);
        if (passes_straight(material))
            parameters += fmt::format(", transmittance {}", number_text(straight_transmittance(material, 1)));
        table.add({swatch(reflectance) + text(name), text(type),
                   text(fmt::format("{:.2f}", reflectance.luminance())),
                   text(fmt::format("{:.2f} {:.2f} {:.2f}", reflectance[0], reflectance[1], reflectance[2])),
                   text(fmt::format("{:.4g}", area_of(scene, i))), text(parameters)});
    }
    return table.is_empty() ? Html{} : table.html();
}

}  // namespace stilb::report
