#include "estimators/local/guess/shared_places.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "scene/overlaps.h"

namespace stilb::estimators {
namespace {

using Corners = std::array<Vec3, 3>;

/// Where a triangle has the point next to `point` in its plane: nothing where that is outside, or farther
/// away than `most_m`.
std::optional<math::Barycentric> place_in(const Corners& corners, const Vec3& point, double most_m) {
    const auto& [a, b, c] = corners;
    const Vec3 doubled = cross(b - a, c - a);
    const double square = dot(doubled, doubled);
    if (std::abs(dot(doubled, point - a)) > most_m * std::sqrt(square)) return std::nullopt;
    const double b1 = dot(cross(point - a, c - a), doubled) / square;
    const double b2 = dot(cross(b - a, point - a), doubled) / square;
    if (b1 < 0 || b2 < 0 || b1 + b2 > 1) return std::nullopt;
    return math::Barycentric{1 - b1 - b2, b1, b2};
}

void append_triangle(const Corners& corners, Mesh& mesh) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), corners.begin(), corners.end());
    mesh.triangles.push_back({first, first + 1, first + 2});
}

}  // namespace

SharedPlaces::SharedPlaces(const Scene& scene, const rays::RayCaster& caster, const patches::Patches& patches,
                           const std::function<bool(ObjectId, MaterialId)>& is_traced)
    : caster_(caster), patches_(patches) {
    const auto count = static_cast<std::uint32_t>(patches.count());
    Mesh all;
    for (const patches::Float3& vertex : patches.vertices)
        all.vertices.push_back(Vec3(vertex) + patches.center);
    all.triangles = patches.corners;
    for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
        const Object& object = scene.objects[i];
        const auto* own = std::get_if<Mesh>(&object.shape);
        const Mesh mesh =
            own || std::holds_alternative<Instance>(object.shape) ? Mesh{} : scene::flat_mesh(object.shape);
        const Mesh& flat = own ? *own : mesh;
        for (std::size_t t = 0; t < flat.triangles.size(); ++t) {
            if (!is_traced(ObjectId{i}, object.materials[object.materials.size() == 1 ? 0 : t])) continue;
            const auto& [a, b, c] = flat.triangles[t];
            append_triangle({flat.vertices[a], flat.vertices[b], flat.vertices[c]}, all);
        }
    }
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (const auto& [first, second] : scene::find_overlaps(all, caster.lift())) {
        if (first < count) pairs.emplace_back(first, second);
        if (second < count) pairs.emplace_back(second, first);
    }
    if (pairs.empty()) return;
    std::ranges::sort(pairs);
    first_cover_.resize(count + std::size_t{1});
    for (const auto& [patch, other] : pairs) {
        ++first_cover_[patch + 1];
        Cover& cover = covers_.emplace_back();
        if (other < count) {
            cover = {other, corners_of(other)};
            continue;
        }
        has_traced_ = true;
        for (std::size_t c = 0; c < 3; ++c)
            cover.corners[c] = all.vertices[all.triangles[other][c]] - patches.center;
    }
    for (std::size_t p = 0; p < count; ++p) first_cover_[p + 1] += first_cover_[p];
}

/// If two surfaces are farther apart, the lifted points of one lie behind the other.
double SharedPlaces::largest_gap_m(const Vec3& position) const {
    const Lift lift = caster_.lift();
    return lift.offset_m(position, lift.largest_size_m());
}

void SharedPlaces::set_lit(const std::vector<std::uint32_t>& lit_sides) {
    if (covers_.empty()) return;
    is_lit_.resize(2 * patches_.count());
    for (const std::uint32_t side : lit_sides) is_lit_[side] = 1;
}

Corners SharedPlaces::corners_of(std::uint32_t patch) const {
    const auto& [a, b, c] = patches_.corners[patch];
    return {Vec3(patches_.vertices[a]), Vec3(patches_.vertices[b]), Vec3(patches_.vertices[c])};
}

auto SharedPlaces::owner_of(std::uint32_t side, const math::Barycentric& at) const -> Place {
    const std::uint32_t patch = patches_.patch_of(side);
    const Vec3 normal = patches_.normal_of(side);
    const Vec3 position = patches_.position(patch, at);
    const double most_m = largest_gap_m(position);
    Place owner{side, at};
    for (std::uint32_t i = first_cover_[patch]; i < first_cover_[patch + 1]; ++i) {
        const Cover& cover = covers_[i];
        const auto there = place_in(cover.corners, position - patches_.center, most_m);
        if (!there) continue;
        if (cover.patch == patches::kNoSide) return {patches::kNoSide, {}};
        const bool faces_alike = dot(patches_.normal_of(cover.patch), normal) > 0;
        const std::uint32_t other = faces_alike ? cover.patch : patches_.other_side(cover.patch);
        if (std::pair(is_lit(other), other) < std::pair(is_lit(owner.side), owner.side))
            owner = {other, *there};
    }
    return owner;
}

bool SharedPlaces::is_traced_at(const Vec3& position) const {
    if (!has_traced_) return false;
    const double most_m = largest_gap_m(position);
    return std::ranges::any_of(covers_, [&](const Cover& cover) {
        return cover.patch == patches::kNoSide &&
               place_in(cover.corners, position - patches_.center, most_m).has_value();
    });
}

}  // namespace stilb::estimators
