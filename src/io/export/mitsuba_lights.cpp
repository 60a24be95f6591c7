// Lights for Mitsuba 3. It has no units: luminances and intensities are given in cd/m2 and cd.

#include <fmt/format.h>

#include "io/export/mitsuba_scene.h"

namespace stilb::io::exporting {
namespace {

std::string axis(std::string_view name, const Vec3& v) {
    return fmt::format("    <vector name=\"{}\" x=\"{:.15g}\" y=\"{:.15g}\" z=\"{:.15g}\"/>\n", name, v.x,
                       v.y, v.z);
}

std::string light_rgb(std::string_view name, const Rgb& value) {
    return fmt::format("    <rgb name=\"{}\" value=\"{}\"/>\n", name, text_of(value));
}

std::string light_of(std::string_view type, const std::string& content) {
    return fmt::format("  <emitter type=\"{}\">\n{}  </emitter>\n", type, content);
}

struct MitsubaLight {
    const Scene& scene;
    const std::string& id;
    const std::string& name;
    Output& output;

    /// Any kind of light that none of the others is for.
    template <typename Source>
    std::string operator()(const Source&) const {
        output.warn("light", name, no_equal(Source::kType, "Mitsuba", "it is left out"));
        return "";
    }
    std::string operator()(const PointLight& light) const {
        const Vec3& p = light.position;
        return light_of(
            "point", fmt::format("    <point name=\"position\" x=\"{:.15g}\" y=\"{:.15g}\" z=\"{:.15g}\"/>\n",
                                 p.x, p.y, p.z) +
                         light_rgb("intensity", light.intensity_cd));
    }
    std::string operator()(const Luminaire& light) const {
        output.warn("light", name,
                    "Mitsuba has no luminaire files. stilb_plugins.py, which is written beside the scene, "
                    "adds them; it has to be imported before scene.xml is loaded.");
        return light_of(
            "stilb_luminaire",
            fmt::format("    <string name=\"filename\" value=\"solid{}.dat\"/>\n", index_of(light.solid)) +
                axis("position", light.position) + axis("c0", light.c0) + axis("c90", light.c90) +
                axis("nadir", light.nadir) + light_rgb("factor", light.factor));
    }
    std::string operator()(const LuminousOpening& light) const {
        output.warn("light", name,
                    "Mitsuba has no surfaces whose luminance depends on direction: the luminaire becomes a "
                    "point, invisible, whose light close by is not that of its opening.");
        return (*this)(light.luminaire);
    }
    std::string operator()(const AreaLight&) const { return ""; }
    std::string operator()(const EnvironmentLight& light) const {
        if (!light.panorama) return light_of("constant", light_rgb("radiance", light.luminance_cd_m2));
        output.warn("light", name,
                    "Mitsuba interpolates between the pixels of a panorama, and has the middles of its "
                    "first and last rows at the poles.");
        write_panorama(*light.panorama);
        const Vec3 &x = light.axes.v, &y = light.axes.w, &z = light.axes.u;
        return light_of(
            "envmap",
            fmt::format("    <string name=\"filename\" value=\"{}.pfm\"/>\n    <transform "
                        "name=\"to_world\">\n      <matrix value=\"{:.15g} {:.15g} {:.15g} 0 {:.15g} {:.15g} "
                        "{:.15g} 0 {:.15g} {:.15g} {:.15g} 0 0 0 0 1\"/>\n    </transform>\n",
                        id, x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z, z.z));
    }

  private:
    /// A portable float map: rows from the bottom, little-endian.
    void write_panorama(const lights::Panorama& panorama) const {
        const auto width = static_cast<std::size_t>(panorama.width());
        const auto& pixels = panorama.image().rgb_cd_m2;
        std::string bytes = fmt::format("PF\n{} {}\n-1.0\n", panorama.width(), panorama.height());
        for (std::size_t row = pixels.size() / width; row-- > 0;) {
            bytes.append(reinterpret_cast<const char*>(&pixels[row * width]), width * sizeof pixels[0]);
        }
        output.write(id + ".pfm", bytes);
    }
};

}  // namespace

std::string mitsuba_light(const Scene& scene, const Light& light, const std::string& id, Output& output) {
    return std::visit(MitsubaLight{scene, id, light.name, output}, light.source);
}

}  // namespace stilb::io::exporting
