#include "io/import/radiance/primitives.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "io/text/text.h"

namespace stilb::io::radiance {
namespace {

struct SurfaceType {
    std::string_view name;
    SurfaceKind kind, inverse;
    std::size_t numbers;  ///< 0: three for each corner
};
constexpr std::array kSurfaceTypes{
    SurfaceType{"polygon", SurfaceKind::polygon, SurfaceKind::polygon, 0},
    SurfaceType{"sphere", SurfaceKind::sphere, SurfaceKind::bubble, 4},
    SurfaceType{"bubble", SurfaceKind::bubble, SurfaceKind::sphere, 4},
    SurfaceType{"ring", SurfaceKind::ring, SurfaceKind::ring, 8},
    SurfaceType{"cylinder", SurfaceKind::cylinder, SurfaceKind::tube, 7},
    SurfaceType{"tube", SurfaceKind::tube, SurfaceKind::cylinder, 7},
    SurfaceType{"cone", SurfaceKind::cone, SurfaceKind::cup, 8},
    SurfaceType{"cup", SurfaceKind::cup, SurfaceKind::cone, 8},
    SurfaceType{"source", SurfaceKind::source, SurfaceKind::source, 4},
    SurfaceType{"mesh", SurfaceKind::mesh, SurfaceKind::mesh, kMeshTriangleNumbers}};

constexpr std::array<std::string_view, 28> kMaterialTypes{
    "plastic",   "metal",     "trans",      "plastic2", "metal2",  "trans2",    "ashik2",
    "glass",     "mirror",    "light",      "glow",     "illum",   "spotlight", "dielectric",
    "interface", "mist",      "antimatter", "plasfunc", "metfunc", "transfunc", "plasdata",
    "metdata",   "transdata", "BRTDfunc",   "BSDF",     "aBSDF",   "prism1",    "prism2"};
constexpr std::array<std::string_view, 16> kPatternTypes{
    "brightdata", "brightfunc", "brighttext", "colordata", "colorfunc", "colorpict", "colortext", "texdata",
    "texfunc",    "mixdata",    "mixfunc",    "mixpict",   "mixtext",   "spectrum",  "specfile",  "specfunc"};

const SurfaceType& type_of(SurfaceKind kind) {
    return *std::ranges::find(kSurfaceTypes, kind, &SurfaceType::kind);
}

/// A surface in the making: its numbers are checked and transformed in place.
struct SurfaceNumbers {
    SurfaceKind& kind;
    std::vector<double>& numbers;
    const SourceLocation& where;

    [[noreturn]] void fail(const std::string& message) const { throw InputError(message, where); }

    Vec3 at(std::size_t i) const { return {numbers[i], numbers[i + 1], numbers[i + 2]}; }
    void put(std::size_t i, const Vec3& v) { numbers[i] = v.x, numbers[i + 1] = v.y, numbers[i + 2] = v.z; }

    void check_count() const {
        const auto& [name, own, inverse, expected] = type_of(kind);
        const std::size_t found = numbers.size();
        if (expected > 0 && found != expected)
            fail(fmt::format("a {} has {} numbers, but {} were found.", name, expected, found));
        if (expected == 0 && (found < 9 || found % 3 != 0)) {
            fail(
                fmt::format("a polygon has three numbers for each of three or more corners, but {} numbers "
                            "were found.",
                            found));
        }
    }
    void check_radii(std::size_t first) const {
        for (std::size_t i = first; i < numbers.size(); ++i) {
            if (numbers[i] < 0)
                fail(fmt::format("the radius {} is below 0. Allowed: 0 and more.", numbers[i]));
        }
        if (*std::max_element(numbers.begin() + static_cast<std::ptrdiff_t>(first), numbers.end()) <= 0)
            fail("the radius is 0. Allowed: above 0.");
    }
    void check_shape() {
        switch (kind) {
            case SurfaceKind::sphere:
            case SurfaceKind::bubble:
                // A sphere of a negative radius is a bubble, and the other way round.
                if (numbers[3] < 0) kind = type_of(kind).inverse, numbers[3] = -numbers[3];
                return check_radii(3);
            case SurfaceKind::ring:
                if (numbers[6] > numbers[7]) std::swap(numbers[6], numbers[7]);
                if (!(length(at(3)) > 0)) fail("the direction of the ring is 0 0 0. Allowed: any other.");
                return check_radii(6);
            case SurfaceKind::cylinder:
            case SurfaceKind::tube:
            case SurfaceKind::cone:
            case SurfaceKind::cup:
                if (!(length(at(3) - at(0)) > 0)) {
                    fail(
                        fmt::format("both ends of the {} are the same point. Allowed: two points; a flat "
                                    "one is a ring.",
                                    type_of(kind).name));
                }
                return check_radii(6);
            case SurfaceKind::source:
                if (!(length(at(0)) > 0)) fail("the direction of the source is 0 0 0. Allowed: any other.");
                if (!(numbers[3] > 0))
                    fail("the angle of the source is not above 0. Allowed: degrees above 0.");
                return;
            case SurfaceKind::polygon:
            case SurfaceKind::mesh:
                return;
        }
    }

    void transform(const Xform& xform) {
        const auto point = [&](std::size_t i) { put(i, xform.transform.point(at(i))); };
        const auto scale_from = [&](std::size_t i) {
            for (; i < numbers.size(); ++i) numbers[i] *= xform.scale;
        };
        if (xform.is_inverted) kind = type_of(kind).inverse;
        switch (kind) {
            case SurfaceKind::polygon:
                for (std::size_t i = 0; i < numbers.size(); i += 3) point(i);
                if (xform.is_mirrored != xform.is_inverted) reverse_corners();
                return;
            case SurfaceKind::sphere:
            case SurfaceKind::bubble:
                return point(0), scale_from(3);
            case SurfaceKind::ring:
                put(3, (xform.is_inverted ? -1.0 : 1.0) * xform.transform.direction(at(3)));
                return point(0), scale_from(6);
            case SurfaceKind::source:
                return put(0, xform.transform.direction(at(0)));
            case SurfaceKind::mesh:
                // Inverting has no effect on meshes.
                for (std::size_t i = 0; i < 9; i += 3) point(i);
                for (std::size_t i = 9; i < 18; i += 3) put(i, xform.transform.normal(at(i)));
                if (xform.is_mirrored) swap_triples(3, 6), swap_triples(12, 15);
                return;
            default:
                return point(0), point(3), scale_from(6);
        }
    }
    void swap_triples(std::size_t i, std::size_t j) {
        const Vec3 first = at(i);
        put(i, at(j));
        put(j, first);
    }
    void reverse_corners() {
        for (std::size_t i = 0, j = numbers.size() - 3; i < j; i += 3, j -= 3) swap_triples(i, j);
    }
    void check_size() const {
        constexpr double largest_m = 1e9;
        for (const double number : numbers) {
            if (!(std::abs(number) <= largest_m))
                fail("the surface lies beyond 1e9 m. Allowed: coordinates from -1e9 to 1e9.");
        }
    }
};

/// Types whose functions are defined in coordinates that xform changes, and those with arguments that it
/// changes.
void transform_arguments(Modifier& modifier, const Xform& xform) {
    modifier.frame = compose(xform.transform, modifier.frame);
    std::vector<double>& numbers = modifier.numbers;
    if (modifier.type == "spotlight" && numbers.size() >= 7) {
        const Vec3 aim = xform.transform.direction({numbers[4], numbers[5], numbers[6]});
        numbers[4] = aim.x, numbers[5] = aim.y, numbers[6] = aim.z;
    }
}

}  // namespace

Role role_of(std::string_view type) {
    if (type == "instance" || type == "mesh") return Role::instance;
    if (type == "alias") return Role::alias;
    if (std::ranges::find(kSurfaceTypes, type, &SurfaceType::name) != kSurfaceTypes.end())
        return Role::surface;
    if (is_material(type) || std::ranges::find(kPatternTypes, type) != kPatternTypes.end())
        return Role::modifier;
    return Role::unknown;
}

std::vector<std::string_view> type_names() {
    std::vector<std::string_view> names{"alias", "instance"};
    for (const SurfaceType& type : kSurfaceTypes) names.push_back(type.name);
    names.insert(names.end(), kMaterialTypes.begin(), kMaterialTypes.end());
    names.insert(names.end(), kPatternTypes.begin(), kPatternTypes.end());
    return names;
}

bool is_material(std::string_view type) {
    return std::ranges::find(kMaterialTypes, type) != kMaterialTypes.end();
}

void Collector::count(const Place& place) const {
    if (size() < limits_.primitives) return;
    throw InputError(
        fmt::format("the scene has more than {} primitives, copies by xform included.", limits_.primitives),
        description_.where(place));
}

std::optional<std::size_t> Collector::find(const std::string& name, const Place& place) const {
    if (name == "void") return std::nullopt;
    const auto found = latest_.find(name);
    if (found != latest_.end()) return found->second;
    constexpr std::size_t most_to_compare = 10'000;
    std::vector<std::string_view> names;
    for (const auto& [known, index] : latest_) {
        if (names.size() < most_to_compare) names.push_back(known);
    }
    std::ranges::sort(names);  // the nearest name must not depend on the order of a hash
    throw InputError(
        fmt::format("the modifier {} is not defined before this line.{} Needed: a material of this name, or "
                    "void.",
                    in_quotes(name), did_you_mean(name, names)),
        description_.where(place));
}

void Collector::add_modifier(Modifier modifier) {
    count(modifier.place);
    latest_[modifier.name] = description_.modifiers.size();
    description_.modifiers.push_back(std::move(modifier));
}

void Collector::add_alias(const Primitive& primitive) {
    const std::string& target_name = primitive.texts.front();
    const auto target = find(target_name, primitive.place);
    if (!target) throw InputError("an alias of void has no meaning.", description_.where(primitive.place));
    const Modifier& of_target = description_.modifiers[*target];
    if (primitive.modifier == "inherit" || find(primitive.modifier, primitive.place) == of_target.modifier) {
        latest_[primitive.name] = *target;
        return;
    }
    // The material of the target with another modifier. Its frame is final already.
    Modifier copy = of_target;
    copy.name = primitive.name;
    copy.modifier = find(primitive.modifier, primitive.place);
    copy.place = primitive.place;
    add_modifier(std::move(copy));
}

void Collector::add_surface(SurfaceKind kind, const std::string& name, std::optional<std::size_t> modifier,
                            std::vector<double> numbers, const Place& place) {
    count(place);
    const SourceLocation where = description_.where(place);
    SurfaceNumbers surface{kind, numbers, where};
    surface.check_count();
    surface.check_shape();
    surface.transform(xform_);
    surface.check_size();
    std::vector<double>& all = description_.numbers;
    description_.surfaces.push_back(
        {kind, xform_.prefix + name, modifier, all.size(), numbers.size(), place});
    all.insert(all.end(), numbers.begin(), numbers.end());
}

void Collector::add_surface(SurfaceKind kind, const std::string& name, const std::string& modifier,
                            std::vector<double> numbers, const Place& place) {
    const std::string& own = xform_.modifier.empty() ? modifier : xform_.modifier;
    add_surface(kind, name, find(own, place), std::move(numbers), place);
}

void Collector::add(Primitive primitive) {
    switch (role_of(primitive.type)) {
        case Role::alias:
            return add_alias(primitive);
        case Role::surface: {
            const auto type = std::ranges::find(kSurfaceTypes, primitive.type, &SurfaceType::name);
            return add_surface(type->kind, primitive.name, primitive.modifier, std::move(primitive.numbers),
                               primitive.place);
        }
        default:
            Modifier modifier{std::move(primitive.type),
                              std::move(primitive.name),
                              std::move(primitive.texts),
                              std::move(primitive.numbers),
                              find(primitive.modifier, primitive.place),
                              {},
                              primitive.place};
            transform_arguments(modifier, xform_);
            add_modifier(std::move(modifier));
    }
}

}  // namespace stilb::io::radiance
