// Lights for Radiance: points become spheres of a millimetre.

#include <fmt/format.h>

#include "io/export/radiance_scene.h"
#include "io/image/picture_file.h"

namespace stilb::io::exporting {
namespace {

constexpr double kPointRadius_m = 1e-3;
constexpr double kPointArea_m2 = kPi * kPointRadius_m * kPointRadius_m;  // as seen

/// Position in a panorama: A1 to A9 are the axes towards its middle, a quarter to the left, and its top.
constexpr std::string_view kPanoramaFunctions =
    R"({ Position of a direction in a panorama. Written by Stilb. }
stilb_x = Dx*A1 + Dy*A2 + Dz*A3;
stilb_y = Dx*A4 + Dy*A5 + Dz*A6;
stilb_z = Dx*A7 + Dy*A8 + Dz*A9;
stilb_u = 1 - atan2(stilb_y, stilb_x)/PI;
stilb_v = 1 - acos(stilb_z)/PI;
)";

std::vector<double> numbers_of(const Vec3& a, const Vec3& b, const Vec3& c) {
    return {a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z};
}

std::string point_lamp(const std::string& modifier, const std::string& id, const Vec3& position,
                       const Rgb& intensity_cd) {
    const Rgb radiance = intensity_cd * (1 / (kPointArea_m2 * kRadianceEfficacy_lm_w));
    return radiance_primitive(modifier, "light", id, {}, {radiance[0], radiance[1], radiance[2]}) +
           radiance_primitive(id, "sphere", id + "_lamp", {},
                              {position.x, position.y, position.z, kPointRadius_m});
}

std::string sky(const std::string& modifier, const std::string& id, const Rgb& luminance_cd_m2) {
    const Rgb radiance = luminance_cd_m2 * (1 / kRadianceEfficacy_lm_w);
    return radiance_primitive(modifier, "glow", id, {}, {radiance[0], radiance[1], radiance[2], 0}) +
           radiance_primitive(id, "source", id + "_sky", {}, {0, 0, 1, 360});
}

struct RadianceLight {
    const Scene& scene;
    const std::string& id;
    Output& output;

    /// Any kind of light that none of the others is for.
    template <typename Source>
    std::string operator()(const Source&) const {
        output.warn("light", id, no_equal(Source::kType, "Radiance", "it is left out"));
        return "";
    }
    std::string operator()(const PointLight& light) const {
        return point_lamp("void", id, light.position, light.intensity_cd);
    }
    std::string operator()(const Luminaire& light) const {
        const std::string table = fmt::format("solid{}.dat", index_of(light.solid));
        return radiance_primitive("void", "brightdata", id + "_solid",
                                  {"stilb_value", table, "luminaire.cal", "stilb_c", "stilb_gamma"},
                                  numbers_of(light.c0, light.c90, light.nadir)) +
               point_lamp(id + "_solid", id, light.position, light.factor);
    }
    /// The table is that of the opening's luminance.
    std::string operator()(const LuminousOpening& light) const {
        const Luminaire& luminaire = light.luminaire;
        const Shape& shape = scene.object(light.object).shape;
        const lights::OpeningEmitter emitter(light, scene::LightSurroundings(scene), scene::lift_of(scene));
        const double factor = luminaire.factor.luminance();
        const std::string table = id + ".dat";
        output.write(table, photometric_table([&](const Vec3& w) {
                         const Vec3 leaving =
                             w.x * luminaire.c0 + w.y * luminaire.c90 + w.z * luminaire.nadir;
                         return emitter.luminance_cd_m2(leaving).luminance() / factor;
                     }));
        const Rgb radiance = luminaire.factor * (1 / kRadianceEfficacy_lm_w);
        return radiance_primitive("void", "brightdata", id + "_solid",
                                  {"stilb_value", table, "luminaire.cal", "stilb_c", "stilb_gamma"},
                                  numbers_of(luminaire.c0, luminaire.c90, luminaire.nadir)) +
               radiance_primitive(id + "_solid", "light", id, {}, {radiance[0], radiance[1], radiance[2]}) +
               radiance_opening(shape, id, id + "_opening");
    }
    std::string operator()(const AreaLight&) const { return ""; }
    std::string operator()(const EnvironmentLight& light) const {
        if (!light.panorama) return sky("void", id, light.luminance_cd_m2);
        Picture picture;
        picture.width = light.panorama->width();
        picture.height = light.panorama->height();
        picture.rgb_cd_m2 = light.panorama->image().rgb_cd_m2;
        output.write(id + ".hdr", to_hdr(picture, HdrBands::as_they_are));
        output.write("panorama.cal", kPanoramaFunctions);
        // The picture's values are radiances already.
        return radiance_primitive("void", "colorpict", id + "_picture",
                                  {"red", "green", "blue", id + ".hdr", "panorama.cal", "stilb_u", "stilb_v"},
                                  numbers_of(light.axes.u, light.axes.v, light.axes.w)) +
               sky(id + "_picture", id, Rgb::grey(kRadianceEfficacy_lm_w));
    }
};

}  // namespace

const std::string_view kLuminaireFunctions =
    R"({ Angles of the light that leaves a luminaire, in degrees. Written by Stilb. }
stilb_value(v) = v;
stilb_x = -(Dx*A1 + Dy*A2 + Dz*A3);
stilb_y = -(Dx*A4 + Dy*A5 + Dz*A6);
stilb_z = -(Dx*A7 + Dy*A8 + Dz*A9);
stilb_azimuth = atan2(stilb_y, stilb_x) * 180/PI;
stilb_c = if(stilb_azimuth, stilb_azimuth, stilb_azimuth + 360);
stilb_gamma = acos(if(stilb_z - 1, 1, if(-1 - stilb_z, -1, stilb_z))) * 180/PI;
)";

std::string radiance_light(const Scene& scene, const Light& light, const std::string& id, Output& output) {
    return std::visit(RadianceLight{scene, id, output}, light.source);
}

}  // namespace stilb::io::exporting
