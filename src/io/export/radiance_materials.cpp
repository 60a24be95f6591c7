// Materials for Radiance, whose gloss is Ward's model: Phong lobes and GGX facets get a near one.

#include <fmt/format.h>

#include <cmath>

#include "io/export/radiance_scene.h"
#include "materials/model_list.h"

namespace stilb::io::exporting {
namespace {

std::string with_rgb(std::string_view type, const std::string& id, const Rgb& rgb,
                     std::initializer_list<double> more) {
    std::vector<double> numbers{rgb[0], rgb[1], rgb[2]};
    numbers.insert(numbers.end(), more);
    return radiance_primitive("void", type, id, {}, numbers);
}

/// A diffuse part beside a lobe of a grey share. Radiance multiplies the colour by the rest, 1 - share.
std::string with_lobe(const std::string& id, const Rgb& diffuse, double share, double roughness) {
    const Rgb color = share < 1 ? diffuse * (1 / (1 - share)) : Rgb{};
    return with_rgb("plastic", id, color, {share, roughness});
}

struct RadianceMaterial {
    const std::string& id;
    const std::string& name;
    Output& output;

    void warn(std::string_view text) const { output.warn("material", name, text); }

    /// Any model that none of the others is for.
    template <typename Model>
    std::string operator()(const Model& m) const {
        warn(no_equal(Model::kType, "Radiance", "a diffuse surface that reflects as much stands for it"));
        return with_rgb("plastic", id, stated_reflectance(Material(m)), {0, 0});
    }
    std::string operator()(const Diffuse& m) const { return with_rgb("plastic", id, m.reflectance, {0, 0}); }
    std::string operator()(const materials::Black&) const { return with_rgb("plastic", id, {}, {0, 0}); }
    std::string operator()(const Phong& m) const {
        warn(
            "Radiance has no Phong model. A lobe of Ward's of the same grey share and about the same width "
            "stands for it.");
        return with_lobe(id, m.diffuse, m.specular.luminance(), std::sqrt(2 / (m.exponent + 2)));
    }
    std::string operator()(const materials::RoughConductor& m) const {
        warn("Radiance has no GGX facets. Metal with a lobe of Ward's of the same roughness stands for it.");
        return with_rgb("metal", id, m.parameters().reflectance, {1, m.parameters().roughness});
    }
    std::string operator()(const Plastic& m) const {
        warn("Radiance's plastic has no GGX facets, and its gloss hardly depends on the angle.");
        const double ior = m.parameters().ior, ratio = (ior - 1) / (ior + 1);
        const double share = ratio * ratio;
        return with_lobe(id, m.mean_reflectance() + Rgb::grey(-share), share, m.parameters().roughness);
    }
    std::string operator()(const materials::Ward& m) const {
        const auto& [u, v] = m.parameters().roughness;
        warn("Radiance's gloss has one grey share, and here one roughness in all directions.");
        return with_lobe(id, m.parameters().diffuse, m.parameters().specular.luminance(), std::sqrt(u * v));
    }
    std::string operator()(const materials::Mirror& m) const {
        warn("Radiance's mirrors reflect on their front only; Stilb's do so on both sides.");
        return with_rgb("mirror", id, m.reflectance, {});
    }
    std::string operator()(const materials::Dielectric& m) const {
        warn(
            "in Radiance no light of lamps passes solid glass straight: the light behind it is missing, "
            "unless the lamps are made of glow.");
        const Rgb inside = m.inside().left_after(1), outside = m.outside.left_after(1);  // per metre
        if (m.outside == materials::Medium{}) return with_rgb("dielectric", id, inside, {m.ior, 0});
        return with_rgb("interface", id, inside, {m.ior, outside[0], outside[1], outside[2], m.outside.ior});
    }
    std::string operator()(const materials::Translucent& m) const {
        const auto& [reflected, diffuse, straight] = m.parameters();
        const Rgb color = reflected + diffuse + straight;
        const double passing = (diffuse + straight).luminance();
        const double trans = passing > 0 ? passing / color.luminance() : 0;
        const double tspec = passing > 0 ? straight.luminance() / passing : 0;
        constexpr double rounding = 1e-9;
        const auto is_grey_share = [&](const Rgb& part, double share) {
            return (part + color * -share).max() <= rounding && (color * share + part * -1).max() <= rounding;
        };
        if (!is_grey_share(diffuse + straight, trans) || !is_grey_share(straight, trans * tspec))
            warn("Radiance's trans has the same colour for the light that it reflects and transmits.");
        return with_rgb("trans", id, color, {0, 0, trans, tspec});
    }
    std::string operator()(const materials::Fabric& m) const {
        const auto& [openness, transmittance, reflectance] = m.parameters();
        warn(
            "Radiance's trans lets the same share pass straight at all angles; the holes of a fabric close.");
        return (*this)(
            materials::Translucent({reflectance, transmittance + Rgb::grey(-openness), Rgb::grey(openness)}));
    }
    std::string operator()(const materials::Glazing& m) const {
        if (!m.parameters().visible_transmittance.is_given())
            warn(no_equal("glazing", "Radiance",
                          "an uncoated pane that transmits as much along the normal stands for it"));
        return (*this)(m.uncoated());
    }
    std::string operator()(const materials::ThinDielectric& m) const {
        return with_rgb("glass", id, m.internal_transmittance, {m.ior});
    }
};

}  // namespace

std::string radiance_material(const NamedMaterial& material, const std::string& id, Output& output) {
    return materials::visit_model(RadianceMaterial{id, material.name, output}, material.material);
}

}  // namespace stilb::io::exporting
