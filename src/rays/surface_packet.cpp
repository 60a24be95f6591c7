#include "rays/surface_packet.h"

#include <algorithm>
#include <cmath>

#include "rays/ray_caster.h"

namespace stilb::rays {
namespace {

double largest(double a, double b, double c) {
    return std::max(std::max(std::abs(a), std::abs(b)), std::abs(c));
}

/// In double precision: lifted points are rounded once, as those of single rays.
STILB_VECTORIZED void find_points(const RayPacket& __restrict ray, const RayPacket::Floats& __restrict us,
                                  const RayPacket::Floats& __restrict vs, const LaneVectors& __restrict a,
                                  const LaneVectors& __restrict b, const LaneVectors& __restrict c,
                                  double least_size_m, LaneVectors& __restrict position,
                                  LaneVectors& __restrict normal, LaneVectors& __restrict lifted,
                                  LaneMask& __restrict is_on_front, LaneMask& __restrict is_inside) {
    for (int i = 0; i < kPacketWidth; ++i) {
        const double ax = a.x[i], ay = a.y[i], az = a.z[i];
        const double bx = b.x[i] - ax, by = b.y[i] - ay, bz = b.z[i] - az;
        const double cx = c.x[i] - ax, cy = c.y[i] - ay, cz = c.z[i] - az;
        const double nx = by * cz - bz * cy, ny = bz * cx - bx * cz, nz = bx * cy - by * cx;
        const double doubled_area = std::sqrt(nx * nx + ny * ny + nz * nz);
        const double u = us[i], v = vs[i];
        const double px = ax + u * bx + v * cx, py = ay + u * by + v * cy, pz = az + u * bz + v * cz;
        const double size = std::max(largest(bx, by, bz), largest(cx, cy, cz));
        const double offset_m = Lift::kShare * std::max(std::max(largest(px, py, pz), size), least_size_m);
        const double facing = nx * double{ray.direction_x[i]} + ny * double{ray.direction_y[i]} +
                              nz * double{ray.direction_z[i]};
        const double scale = (facing < 0 ? 1 : -1) / doubled_area;
        const double ux = scale * nx, uy = scale * ny, uz = scale * nz;
        const double least = std::min(std::min(u, v), 1 - u - v);
        position.x[i] = static_cast<float>(px);
        position.y[i] = static_cast<float>(py);
        position.z[i] = static_cast<float>(pz);
        normal.x[i] = static_cast<float>(ux);
        normal.y[i] = static_cast<float>(uy);
        normal.z[i] = static_cast<float>(uz);
        lifted.x[i] = static_cast<float>(px + offset_m * ux);
        lifted.y[i] = static_cast<float>(py + offset_m * uy);
        lifted.z[i] = static_cast<float>(pz + offset_m * uz);
        is_on_front[i] = facing < 0 ? -1 : 0;
        is_inside[i] = least * doubled_area >= kEdgeMargin * offset_m * 4 * size ? -1 : 0;
    }
}

}  // namespace

void SurfacePacket::set(std::size_t lane, const Hit& hit, const Vec3& center) {
    position.set(lane, hit.position - center);
    normal.set(lane, hit.normal);
    lifted.set(lane, hit.lifted - center);
    object[lane] = static_cast<std::uint32_t>(index_of(hit.object));
    material[lane] = static_cast<std::uint32_t>(index_of(hit.material));
    is_smooth[lane] = hit.shading_normal == hit.normal ? 0 : -1;
    is_on_front[lane] = hit.on_front ? -1 : 0;
}

void find_surfaces(const RayHitPacket& hits, const CornerPacket& corners, const Lift& lift,
                   SurfacePacket& surfaces, LaneMask& is_inside) {
    const auto& [a, b, c] = corners.corner;
    find_points(hits.ray, hits.u, hits.v, a, b, c, lift.least_size_m(), surfaces.position, surfaces.normal,
                surfaces.lifted, surfaces.is_on_front, is_inside);
}

}  // namespace stilb::rays
