#include "estimators/local/node_pool.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "materials/diffuse.h"
#include "materials/shaded_surface.h"
#include "math/morton.h"
#include "transport/weights.h"

namespace stilb::estimators {
namespace {

/// The index of the axis direction nearest to a normal, of six.
int orientation(const Vec3& normal) {
    const Vec3 size{std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)};
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    return 2 * axis + (normal[static_cast<std::size_t>(axis)] < 0 ? 1 : 0);
}

std::vector<std::size_t> order_over_surfaces(const std::vector<transport::LightVertex>& nodes) {
    std::vector<Vec3> positions;
    positions.reserve(nodes.size());
    for (const transport::LightVertex& node : nodes) positions.push_back(node.position);
    const std::vector<std::uint64_t> codes = math::morton_codes(positions);
    std::vector<std::tuple<int, std::uint64_t, std::size_t>> keys;
    keys.reserve(nodes.size());
    for (std::size_t n = 0; n < nodes.size(); ++n)
        keys.emplace_back(orientation(nodes[n].normal), codes[n], n);
    std::sort(keys.begin(), keys.end());
    std::vector<std::size_t> order;
    order.reserve(nodes.size());
    for (const auto& key : keys) order.push_back(std::get<2>(key));
    return order;
}

/// Residual light may be negative, in one band or in all.
double reflected_flux(const transport::LightVertex& node) {
    const Rgb reflected = node.flux_lm * reflectance_bound(*node.material);
    return Rgb{{std::abs(reflected[0]), std::abs(reflected[1]), std::abs(reflected[2])}}.luminance();
}

/// The importance of a vertex: the reflected flux with its favour, times the root mean square of the relative
/// BRDF.
double importance_of(const transport::LightVertex& node) {
    return node.favour * reflected_flux(node) * std::sqrt(mean_concentration(*node.material));
}

/// The lobe in which a vertex reflects, from two values of its BRDF: in the middle of the lobe, and far from
/// it. Nothing where there is no distinct lobe.
std::optional<KernelChoice::Lobe> lobe_of(const transport::LightVertex& node) {
    if (node.material->is<Diffuse>()) return std::nullopt;
    const materials::ShadedSurface surface(*node.material, node.normal, node.shading_normal);
    const Vec3 in = surface.frame().to_local(node.incoming);
    const Vec3 normal = surface.frame().to_local(node.shading_normal);
    const Vec3 mirror = 2 * dot(in, normal) * normal - in;
    const Vec3 aside = cross(normal, in);
    const double sine = length(aside);
    constexpr double polar_sine = 0.8, polar_cosine = 0.6;
    const Vec3 far = polar_sine * (sine > 0 ? aside / sine : Frame::around(normal).u) + polar_cosine * normal;
    const auto relative = [&](const Vec3& out) {
        return transport::relative_brdf(*node.material, surface.brdf_per_sr(in, out));
    };
    constexpr double least_base = 0.01, most_base = 0.98, least_peak = 2;
    const double base = std::clamp(relative(far), least_base, most_base), peak = relative(mirror) - base;
    if (peak < least_peak) return std::nullopt;
    // So the lobe has the rest of the light: 2 pi peak / (3 sharpness) in steradians, times the cosine.
    const double sharpness = 2 * peak * std::max(in.z, 0.1) / (3 * (1 - base));
    return KernelChoice::Lobe{surface.frame().to_world(mirror), base, peak, sharpness};
}

}  // namespace

NodePool::NodePool(const std::vector<transport::LightVertex>& nodes) {
    nodes_.reserve(nodes.size());
    passed_.reserve(nodes.size());
    double passed = 0;
    for (const std::size_t n : order_over_surfaces(nodes)) {
        nodes_.push_back(nodes[n]);
        passed_.push_back(passed += importance_of(nodes[n]));
    }
}

std::vector<transport::LightVertex> NodePool::select(std::size_t count, double u) const {
    if (count >= nodes_.size()) return nodes_;
    const double step = passed_.back() / static_cast<double>(count);
    std::vector<transport::LightVertex> selected;
    selected.reserve(count + 1);
    double next = u * step;  // flux at which the next vertex is selected
    for (auto bound = passed_.begin(); bound != passed_.end(); ++bound) {
        bound = std::upper_bound(bound, passed_.end(), next);
        if (bound == passed_.end()) break;
        const double times = std::ceil((*bound - next) / step);
        next += times * step;
        const transport::LightVertex& node = nodes_[static_cast<std::size_t>(bound - passed_.begin())];
        selected.push_back(node);
        selected.back().flux_lm *= times * step / importance_of(node);
    }
    return selected;
}

NearNodePool::NearNodePool(const std::vector<transport::LightVertex>& nodes, const Vec3& center)
    : choice_(center) {
    nodes_.reserve(nodes.size());
    std::vector<std::pair<std::size_t, KernelChoice::Lobe>> with_lobes;
    for (const std::size_t n : order_over_surfaces(nodes)) {
        if (const auto lobe = lobe_of(nodes[n])) {
            with_lobes.emplace_back(n, *lobe);
        } else {
            nodes_.push_back(nodes[n]);
            choice_.add(nodes[n].position, nodes[n].normal, nodes[n].favour * reflected_flux(nodes[n]));
        }
    }
    for (const auto& [n, lobe] : with_lobes) {
        nodes_.push_back(nodes[n]);
        choice_.add(nodes[n].position, nodes[n].normal, nodes[n].favour * reflected_flux(nodes[n]), lobe);
    }
}

std::vector<transport::LightVertex> NearNodePool::select(const KernelChoice::Sums& sums, std::size_t count,
                                                         double u) const {
    std::vector<transport::LightVertex> selected;
    selected.reserve(count);
    KernelChoice::select(sums, count, u, [&](std::size_t i, double times, double) {
        selected.push_back(nodes_[i]);
        selected.back().flux_lm *= times;
    });
    return selected;
}

}  // namespace stilb::estimators
