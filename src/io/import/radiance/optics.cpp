// The mapping of materials: docs/radiance.md. Its inverse is io/export/radiance_materials.cpp.
#include "io/import/radiance/optics.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "io/import/radiance/primitives.h"
#include "io/text/text.h"
#include "materials/black.h"
#include "materials/diffuse.h"
#include "materials/mirror.h"
#include "materials/plastic.h"
#include "materials/solid.h"
#include "materials/thin_dielectric.h"
#include "materials/translucent.h"
#include "materials/ward.h"

namespace stilb::io::radiance {
namespace {

/// Up to this roughness gloss is a mirror image in Radiance; it is the least of Stilb's lobes.
constexpr double kSharp = 0.001;
/// From this share on, Radiance raises sharp reflection towards grazing angles.
constexpr double kLeastFresnelShare = 0.018;
constexpr double kDefaultIor = 1.52;
constexpr double kLargestIor = 4;

/// Reads one material.
class MaterialReader {
  public:
    MaterialReader(const Description& description, std::size_t index, GroupedWarnings& warnings)
        : description_(description), modifier_(description.modifiers[index]), warnings_(warnings) {
        optics_.definition = index;
        optics_.name = modifier_.name;
        optics_.kind = Optics::Kind::surface;
    }

    Optics read() && {
        const std::string& type = modifier_.type;
        if (type == "plastic" || type == "metal") {
            read_glossy(number(3, 5), number(4, 5));
        } else if (type == "trans") {
            read_trans();
        } else if (type == "glass") {
            read_glass();
        } else if (type == "dielectric") {
            read_dielectric();
        } else if (type == "mirror") {
            expect_numbers(3);
            optics_.material = materials::Mirror{color()};
            warn("Radiance's mirrors are black on their back; Stilb's reflect on both sides.");
        } else if (type == "light" || type == "glow" || type == "illum" || type == "spotlight") {
            read_lamp();
        } else {
            read_unsupported();
        }
        return std::move(optics_);
    }

  private:
    [[noreturn]] void fail(const std::string& message) const {
        throw InputError(fmt::format("{} {}: {}", modifier_.type, modifier_.name, message),
                         description_.where(modifier_.place));
    }
    void warn(std::string_view message) const { warnings_.add(modifier_.type, modifier_.name, message); }

    void expect_numbers(std::size_t count) const {
        if (modifier_.numbers.size() != count)
            fail(fmt::format("it has {} numbers, but {} were found.", count, modifier_.numbers.size()));
    }
    /// The number at this place of `count`.
    double number(std::size_t at, std::size_t count) const {
        expect_numbers(count);
        return modifier_.numbers[at];
    }
    double share(std::size_t at) const { return within(modifier_.numbers[at], 0, 1); }
    double within(double value, double least, double most) const {
        if (value >= least && value <= most) return value;
        const double used = std::clamp(value, least, most);
        warn(fmt::format("the value {} lies outside of {} to {}, where energy is kept; {} is used.", value,
                         least, most, used));
        return used;
    }
    Rgb color() const { return {{share(0), share(1), share(2)}}; }

    // Gloss

    void set_diffuse(const Rgb& reflectance) {
        if (reflectance.max() > 0) {
            optics_.material = Diffuse{reflectance};
        } else {
            optics_.material = Black{};
        }
    }
    void set_ward(const Rgb& diffuse, const Rgb& specular, double roughness) {
        roughness = std::max(within(roughness, 0, 1), kSharp);
        optics_.material =
            materials::Ward(materials::Ward::Parameters{diffuse, specular, {roughness, roughness}, 0});
    }
    void read_glossy(double share_in_lobe, double roughness) {
        const double s = within(share_in_lobe, 0, 1);
        const Rgb c = color();
        const bool is_metal = modifier_.type == "metal" || modifier_.type == "metal2";
        const Rgb diffuse = (1 - s) * c, specular = is_metal ? s * c : Rgb::grey(s);
        if (!(specular.max() > 0)) return set_diffuse(diffuse);
        const bool rises = roughness <= kSharp && s >= kLeastFresnelShare;
        if (rises && is_metal && s == 1) {
            optics_.material = materials::Mirror{specular};
            return;
        }
        if (rises && !is_metal && s <= kLargestCoatShare) return set_coated(c, s);
        if (rises) warn("the rise of its sharp reflection towards grazing angles is left out.");
        set_ward(diffuse, specular, roughness);
    }

    static constexpr double kLargestCoatShare = 0.36;  // of a refractive index of 4
    /// A coat whose refractive index has this reflectance at normal incidence, over the base that reflects
    /// the share c of the light that passes the coat.
    void set_coated(const Rgb& c, double share) {
        const double root = std::sqrt(share);
        const double ior = std::min((1 + root) / (1 - root), kLargestIor);
        const Plastic black(Plastic::Parameters{Rgb{}, ior, kSharp});
        // What the coat lets pass on average, and the share of light from within that it returns.
        const double passing = 1 - black.mean_reflectance()[0], returned = 1 - passing / (ior * ior);
        Rgb base;
        for (std::size_t b = 0; b < kBands; ++b) base[b] = c[b] / (1 - returned + c[b] * returned);
        optics_.material = Plastic(Plastic::Parameters{base, ior, kSharp});
        warn(
            fmt::format("Stilb's plastic with a smooth coat, whose reflection follows Fresnel's equations, "
                        "stands for Radiance's, which approximates them."));
    }

    /// [Larson, Shakespeare: Rendering with Radiance, 5.2.6]
    void read_trans() {
        expect_numbers(7);
        const double s = share(3), transmitted = share(5) * (1 - s), straight = share(6);
        const double roughness = within(modifier_.numbers[4], 0, 1), diffuse = 1 - s - transmitted;
        const Rgb c = color();
        if (!(transmitted * c.max() > 0)) {
            if (s > 0) return set_ward(diffuse * c, Rgb::grey(s), roughness);
            return set_diffuse(diffuse * c);
        }
        const bool is_sharp = roughness <= kSharp;
        if (s > 0)
            warn(fmt::format("its gloss, {:.1f} % of the light, is reflected in all directions.", 100 * s));
        if (straight > 0 && !is_sharp)
            warn(
                "the light that its roughness spreads a little, as it lets it through, goes in all "
                "directions.");
        optics_.material = materials::Translucent({diffuse * c + Rgb::grey(s),
                                                   transmitted * (is_sharp ? 1 - straight : 1) * c,
                                                   transmitted * (is_sharp ? straight : 0) * c});
    }

    // Glass

    void read_glass() {
        const std::size_t count = modifier_.numbers.size();
        if (count != 3 && count != 4) fail(fmt::format("it has 3 or 4 numbers, but {} were found.", count));
        const double ior = count == 4 ? within(modifier_.numbers[3], 1, kLargestIor) : kDefaultIor;
        optics_.material = materials::ThinDielectric{ior, color()};
    }
    void read_dielectric() {
        expect_numbers(5);
        if (modifier_.numbers[4] != 0) warn("its dispersion is left out.");
        set_solid(medium_at(0), {});
    }
    /// Four numbers: what is left of light after a unit of length, and the refractive index.
    materials::Medium medium_at(std::size_t first) const {
        const auto left = [&](std::size_t band) {
            return std::max(share(first + band), materials::kColorOfSolid.min);
        };
        return materials::Dielectric{within(modifier_.numbers[first + 3], 1, kLargestIor),
                                     {{left(0), left(1), left(2)}}}
            .inside();
    }
    void set_solid(const materials::Medium& inside, const materials::Medium& outside) {
        optics_.material = materials::between_media(materials::Dielectric{}, inside, outside);
        optics_.is_solid = true;
    }

    // Lamps

    void read_lamp() {
        const std::string& type = modifier_.type;
        expect_numbers(type == "glow" ? 4 : type == "spotlight" ? 7 : 3);
        optics_.kind = Optics::Kind::lamp;
        const std::vector<double>& n = modifier_.numbers;
        for (std::size_t b = 0; b < kBands; ++b) {
            constexpr double largest = 1e12;
            if (!(n[b] >= 0 && n[b] <= largest))
                fail(fmt::format("the radiance {} is not allowed. Allowed: from 0 to 1e12.", n[b]));
            optics_.lamp.radiance_w_sr_m2[b] = n[b];
        }
        if (type == "glow" && n[3] < 0) {
            optics_.lamp.radiance_w_sr_m2 = {};
            warn("it lights nothing, because its radius is below 0. It is dark here.");
        }
        if (type == "illum") warn("it is seen as a lamp here; in Radiance it only casts its light.");
        if (type != "spotlight") return;
        const Vec3 axis{n[4], n[5], n[6]};
        if (!(length(axis) > 0)) fail("its direction is 0 0 0. Allowed: any other.");
        if (!(n[3] > 0)) fail("its angle is not above 0. Allowed: degrees above 0.");
        constexpr double short_m = 0.01;
        if (const double focus_m = length(axis); focus_m > short_m) {
            constexpr double near_m = 2;
            warn(
                fmt::format("its light comes from its surface; in Radiance from a focus {:.3g} m behind it, "
                            "the length of "
                            "its direction: {:g} m away this is {:.3g} times Radiance's illuminance. A "
                            "direction of 0.01 m "
                            "length gives both the same light.",
                            focus_m, near_m, std::pow((near_m + focus_m) / near_m, 2)));
        }
        optics_.lamp.cone = Cone{normalized(axis), std::min(n[3] / 2, 180.0)};
    }

    // Others

    bool has_numbers(std::size_t count) const { return modifier_.numbers.size() >= count; }
    void read_unsupported() {
        const std::string& type = modifier_.type;
        if (type == "mist" || type == "antimatter") {
            optics_.kind = Optics::Kind::invisible;
            return warn("this type is not supported; its surfaces are left out.");
        }
        if (type == "interface" && has_numbers(8)) {
            return set_solid(medium_at(0), medium_at(4));
        }
        if ((type == "plastic2" || type == "metal2") && has_numbers(6)) {
            warn(
                "a lobe that is the same in all directions, of the mean of both roughnesses, stands for it.");
            return read_glossy(modifier_.numbers[3],
                               std::sqrt(std::max(0.0, modifier_.numbers[4] * modifier_.numbers[5])));
        }
        if (type.starts_with("prism")) {
            optics_.material = materials::ThinDielectric{kDefaultIor, Rgb::grey(1)};
            return warn("this type is not supported; a clear pane stands for it.");
        }
        if (has_numbers(3)) {
            set_diffuse(color());
            return warn(
                fmt::format("this type is not supported; a diffuse surface of the reflectance {:.3g} "
                            "{:.3g} {:.3g}, its first numbers, stands for it.",
                            color()[0], color()[1], color()[2]));
        }
        optics_.material = Black{};
        warn("this type is not supported; a black surface stands for it.");
    }

    const Description& description_;
    const Modifier& modifier_;
    GroupedWarnings& warnings_;
    Optics optics_;
};

bool is_mixture(const std::string& type) { return type.starts_with("mix"); }

}  // namespace

const Optics& OpticsReader::of(std::size_t modifier) {
    if (!known_[modifier]) known_[modifier] = read(modifier);
    return *known_[modifier];
}

std::optional<std::size_t> OpticsReader::latest_before(std::size_t index, const std::string& name) const {
    while (index-- > 0) {
        if (description_.modifiers[index].name == name) return index;
    }
    return std::nullopt;
}

std::optional<std::size_t> OpticsReader::foreground(std::size_t mixture) const {
    const Modifier& modifier = description_.modifiers[mixture];
    if (modifier.texts.empty() || modifier.texts[0] == "void") return std::nullopt;
    const auto found = latest_before(mixture, modifier.texts[0]);
    if (!found) {
        throw InputError(fmt::format("{} {}: the modifier {} is not defined before it.", modifier.type,
                                     modifier.name, in_quotes(modifier.texts[0])),
                         description_.where(modifier.place));
    }
    return found;
}

Optics OpticsReader::read(std::size_t modifier) {
    std::vector<std::size_t> patterns;
    std::optional<std::size_t> at = modifier;
    std::optional<std::size_t> material;
    while (at) {
        const Modifier& own = description_.modifiers[*at];
        if (is_material(own.type)) {
            if (material) break;
            // Mirrors and illums may name the material that is seen.
            if ((own.type == "mirror") && !own.texts.empty()) {
                at = foreground(*at);
                continue;
            }
            material = at;
        } else if (is_mixture(own.type)) {
            warnings_.add(own.type, own.name,
                          fmt::format("mixtures are not supported; the first of both, {}, stands for it.",
                                      own.texts.empty() ? "none" : own.texts[0]));
            at = foreground(*at);
            continue;
        } else {
            patterns.push_back(*at);
        }
        at = own.modifier;
    }
    if (material) return read_material(*material, patterns);
    const Modifier& own = description_.modifiers[modifier];
    warnings_.add("modifier", own.name, "it leads to no material; its surfaces are left out.");
    return {};
}

Optics OpticsReader::read_material(std::size_t material, const std::vector<std::size_t>& patterns) {
    Optics optics = MaterialReader(description_, material, warnings_).read();
    note_patterns(patterns, optics);
    return optics;
}

void OpticsReader::note_patterns(const std::vector<std::size_t>& patterns, Optics& optics) {
    for (const std::size_t pattern : patterns) {
        const Modifier& own = description_.modifiers[pattern];
        if (optics.kind == Optics::Kind::lamp) {
            if (own.type == "brightdata") {
                optics.lamp.patterns.push_back(pattern);
            } else if (auto sky = read_sky_pattern(own, description_)) {
                optics.lamp.skies.push_back(*sky);
            } else {
                warnings_.add(
                    own.type, own.name,
                    fmt::format("it is left out: {} has the radiance of its own numbers.", optics.name));
            }
        } else if (own.type.starts_with("tex")) {
            warnings_.add(own.type, own.name, "textures are not supported; the surface is left as it is.");
        } else {
            warnings_.add(
                own.type, own.name,
                "patterns of surfaces are not supported; their materials have their own colours everywhere.");
        }
    }
}

}  // namespace stilb::io::radiance
