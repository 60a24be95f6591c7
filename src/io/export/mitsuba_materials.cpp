// Materials for Mitsuba 3: its own models where they are equal, else those of stilb_plugins.py.

#include <fmt/format.h>

#include "io/export/mitsuba_scene.h"
#include "materials/model_list.h"

namespace stilb::io::exporting {
namespace {

std::string two_sided(const std::string& id, const std::string& type, const std::string& content) {
    return fmt::format(
        "  <bsdf type=\"twosided\" id=\"{}\">\n    <bsdf type=\"{}\">\n{}    </bsdf>\n  </bsdf>\n", id, type,
        content);
}

std::string color(std::string_view name, const Rgb& value) {
    return fmt::format("      <rgb name=\"{}\" value=\"{}\"/>\n", name, text_of(value));
}

std::string real(std::string_view name, double value) {
    return fmt::format("      <float name=\"{}\" value=\"{:.9g}\"/>\n", name, value);
}

/// One model after the other. `name` is the scene's, for warnings.
struct MitsubaMaterial {
    const std::string& id;
    const std::string& name;
    Output& output;

    void warn(std::string_view message) const { output.warn("material", name, message); }
    void warn_of_plugin(std::string_view type) const {
        warn(fmt::format(
            "Mitsuba has no model equal to {}. stilb_plugins.py, which is written beside the scene, "
            "adds it; it has to be imported before scene.xml is loaded.",
            type));
    }

    /// Any model that none of the others is for.
    template <typename Model>
    std::string operator()(const Model& m) const {
        warn(no_equal(Model::kType, "Mitsuba", "a diffuse surface that reflects as much stands for it"));
        return two_sided(id, "diffuse", color("reflectance", stated_reflectance(Material(m))));
    }
    std::string operator()(const Diffuse& m) const {
        return two_sided(id, "diffuse", color("reflectance", m.reflectance));
    }
    std::string operator()(const materials::Black&) const {
        return two_sided(id, "diffuse", color("reflectance", {}));
    }
    std::string operator()(const Phong& m) const {
        warn_of_plugin("phong");
        return two_sided(
            id, "stilb_phong",
            color("diffuse", m.diffuse) + color("specular", m.specular) + real("exponent", m.exponent));
    }
    std::string operator()(const materials::RoughConductor& m) const {
        warn_of_plugin("rough, which keeps the light that facets reflect more than once");
        return two_sided(id, "stilb_ggx",
                         color("color", m.parameters().reflectance) +
                             real("roughness", m.parameters().roughness) + real("ior", 0));
    }
    std::string operator()(const Plastic& m) const {
        warn_of_plugin("plastic, which keeps the light that facets reflect more than once");
        return two_sided(id, "stilb_ggx",
                         color("color", m.parameters().diffuse) +
                             real("roughness", m.parameters().roughness) + real("ior", m.parameters().ior));
    }
    std::string operator()(const materials::Ward& m) const {
        warn(
            "Mitsuba has no Ward model. A Phong lobe of the same share and about the same mean "
            "width stands for it (stilb_plugins.py).");
        const auto& [u, v] = m.parameters().roughness;
        return two_sided(id, "stilb_phong",
                         color("diffuse", m.parameters().diffuse) +
                             color("specular", m.parameters().specular) + real("exponent", 2 / (u * v)));
    }
    std::string operator()(const materials::Mirror& m) const {
        return two_sided(id, "conductor",
                         "      <string name=\"material\" value=\"none\"/>\n" +
                             color("specular_reflectance", m.reflectance));
    }
    std::string operator()(const materials::Dielectric& m) const {
        if (!m.inside().is_clear() || !m.outside.is_clear())
            warn("Mitsuba's glass is clear: it absorbs nothing inside.");
        return dielectric("dielectric", m.ior, m.outside.ior, "");
    }
    std::string operator()(const materials::Frosted& m) const {
        if (m.parameters().thin) {
            warn(no_equal("frosted and thin", "Mitsuba",
                          "a diffuse surface that reflects as much stands for it"));
            return two_sided(id, "diffuse", color("reflectance", stated_reflectance(Material(m))));
        }
        warn("Mitsuba's roughdielectric loses the light that meets several facets.");
        return dielectric("roughdielectric", m.parameters().ior, m.parameters().outside_ior,
                          "      <string name=\"distribution\" value=\"ggx\"/>\n" +
                              real("alpha", m.parameters().roughness));
    }
    std::string operator()(const materials::Glazing& m) const {
        if (!m.parameters().visible_transmittance.is_given())
            warn(no_equal("glazing", "Mitsuba",
                          "an uncoated pane that transmits as much along the normal stands for it"));
        return (*this)(m.uncoated());
    }
    std::string operator()(const materials::ThinDielectric& m) const {
        warn(
            "Mitsuba's thin pane averages the polarisations too early, and its transmittance is "
            "up to 4 % lower at 75 degrees to the normal; absorption is taken as that along the normal.");
        return dielectric("thindielectric", m.ior, 1,
                          color("specular_transmittance", m.internal_transmittance));
    }

  private:
    std::string dielectric(std::string_view type, double ior, double outside_ior,
                           const std::string& more) const {
        return fmt::format("  <bsdf type=\"{}\" id=\"{}\">\n{}{}{}  </bsdf>\n", type, id,
                           real("int_ior", ior), real("ext_ior", outside_ior), more);
    }
};

}  // namespace

std::string mitsuba_material(const NamedMaterial& material, const std::string& id, Output& output) {
    return materials::visit_model(MitsubaMaterial{id, material.name, output}, material.material);
}

}  // namespace stilb::io::exporting
