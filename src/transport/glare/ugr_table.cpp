#include "transport/glare/ugr_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "lights/emitter_surface.h"
#include "lights/luminaire.h"
#include "math/random.h"
#include "transport/glare/glare.h"

namespace stilb::transport {
namespace {

constexpr double kMostGamma_deg = 85;
/// Directions of the luminaire's flux, for the shares that fall on floor and walls.
constexpr std::uint32_t kFluxDirections = 1 << 16;

enum class Orientation { c0_to_eye, c90_to_eye };

/// A luminaire's horizontal components along C0 and C90 for those along and across the line of sight, and the
/// other way round.
Vec3 turned(Orientation orientation, double along, double across, double down) {
    return orientation == Orientation::c0_to_eye ? Vec3{along, across, down} : Vec3{across, along, down};
}

/// The luminaire, looked at from far away.
class Lamp {
  public:
    Lamp(const PhotometricSolid& solid, const lights::Opening& opening)
        : Lamp(solid, shape_of(opening, hanging(), solid)) {
        for (std::uint32_t i = 0; i < kFluxDirections; ++i)
            directions_.push_back(
                solid.sample_direction((i + 0.5) / kFluxDirections, math::sobol(i, 0) * 0x1p-32));
    }

    double flux_lm() const { return solid_.flux_lm(); }
    /// L^2 w r^2 [cd2/m2], for a unit direction in the luminaire's frame.
    double glare(const Vec3& direction) const {
        const double area_m2 = surface_.projected_area_m2({direction.x, direction.y, -direction.z});
        if (!(area_m2 > 0)) return 0;
        const double intensity_cd = scale_ * solid_.intensity_cd(direction);
        return intensity_cd * intensity_cd / area_m2;
    }
    /// Of its flux, all with the same share.
    const std::vector<Vec3>& directions() const { return directions_; }

  private:
    Lamp(const PhotometricSolid& solid, const lights::OpeningShape& opening)
        : solid_(solid), surface_(opening.shape, Lift{}), scale_(1 / (1 - opening.hidden_share)) {}
    /// C0 towards +x, C90 towards +y.
    static Luminaire hanging() { return {{}, {}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}, Rgb::grey(1)}; }

    const PhotometricSolid& solid_;
    lights::EmitterSurface surface_;
    std::vector<Vec3> directions_;
    double scale_;  ///< for the flux whose directions see nothing of the opening
};

/// The luminaires of a room.
struct LampGrid {
    LampGrid(const UgrRoom& room, double between)
        : across(static_cast<int>(std::lround(room.across / between))),
          along(static_cast<int>(std::lround(room.along / between))),
          spacing(between) {}

    int count() const { return across * along; }
    /// The share of the luminaires from which a ray that moves so far on its way to the floor reaches it.
    double share_on_floor(double moves_across, double moves_along) const {
        return share(moves_across, across) * share(moves_along, along);
    }

    int across, along;
    double spacing;

  private:
    double share(double moves, int luminaires) const {
        const double lost = std::ceil(std::abs(moves) / spacing - 0.5);
        return std::max(0.0, 1 - lost / luminaires);
    }
};

/// The sum of L^2 w / p^2 at the eye [cd2/m4].
double glare_at_eye(const Lamp& lamp, const LampGrid& grid, Orientation orientation) {
    const double most_distance = std::tan(kMostGamma_deg * std::numbers::pi / 180);
    const Vec3 line_of_sight{0, 1, 0};
    double sum = 0;
    for (int j = 0; j < grid.along; ++j) {
        for (int i = 0; i < grid.across; ++i) {
            const double along = (j + 0.5) * grid.spacing;
            const double across = (i + 0.5 - 0.5 * grid.across) * grid.spacing;
            const Vec3 to_lamp{across, along, 1};
            if (std::hypot(across, along) > most_distance || !is_in_field(normalized(to_lamp), line_of_sight))
                continue;
            const double index = position_index(normalized(to_lamp), line_of_sight);
            const double distance_m = kUgrHeight_m * length(to_lamp);
            const double glare = lamp.glare(normalized(turned(orientation, along, -across, 1)));
            sum += glare / (distance_m * distance_m * index * index);
        }
    }
    return sum;
}

/// Where the light of the luminaires falls first, as shares of their flux.
OfSurfaces direct_shares(const Lamp& lamp, const LampGrid& grid, Orientation orientation) {
    OfSurfaces shares;
    for (const Vec3& d : lamp.directions()) {
        if (!(d.z > 0)) {
            shares.ceiling += 1.0 / kFluxDirections;
            continue;
        }
        const Vec3 moved = turned(orientation, d.x / d.z, d.y / d.z, 0);  // along, across
        const double on_floor = grid.share_on_floor(moved.y, moved.x);
        shares.floor += on_floor / kFluxDirections;
        shares.walls += (1 - on_floor) / kFluxDirections;
    }
    return shares;
}

/// The share of the light of a uniform diffuse floor that reaches the ceiling: the configuration factor of
/// equal parallel rectangles of sides x and y at distance 1.
double floor_to_ceiling(double x, double y) {
    const double of_x = std::sqrt(1 + x * x), of_y = std::sqrt(1 + y * y);
    return 2 / (std::numbers::pi * x * y) *
           (std::log(of_x * of_y / std::sqrt(1 + x * x + y * y)) + x * of_y * std::atan(x / of_y) +
            y * of_x * std::atan(y / of_x) - x * std::atan(x) - y * std::atan(y));
}

void set_ratings(const Lamp& lamp, double spacing, Orientation orientation, UgrColumns& ratings) {
    for (std::size_t r = 0; r < kUgrRooms.size(); ++r) {
        const LampGrid grid(kUgrRooms[r], spacing);
        const double glare = glare_at_eye(lamp, grid, orientation);
        const OfSurfaces direct = direct_shares(lamp, grid, orientation);
        const double walls_m2 = 2 * (kUgrRooms[r].across + kUgrRooms[r].along) * kUgrHeight_m * kUgrHeight_m;
        for (std::size_t s = 0; s < kUgrReflectances.size(); ++s) {
            const double share = indirect_share_of_walls(kUgrRooms[r], kUgrReflectances[s], direct);
            const double background_lx = share * grid.count() * lamp.flux_lm() / walls_m2;
            ratings[r][s] = 8 * std::log10(0.25 * std::numbers::pi * glare / background_lx);
        }
    }
}

}  // namespace

double indirect_share_of_walls(const UgrRoom& room, const OfSurfaces& reflectances,
                               const OfSurfaces& direct) {
    const double across = room.across, along = room.along;
    const double floor_ceiling = floor_to_ceiling(across, along), floor_walls = 1 - floor_ceiling;
    const double walls_floor = floor_walls * across * along / (2 * (across + along));
    constexpr double negligible = 1e-15;
    double indirect = 0;
    OfSurfaces incident = direct;
    while (incident.ceiling + incident.walls + incident.floor > negligible) {
        const OfSurfaces leaves{reflectances.ceiling * incident.ceiling, reflectances.walls * incident.walls,
                                reflectances.floor * incident.floor};
        incident = {floor_ceiling * leaves.floor + walls_floor * leaves.walls,
                    floor_walls * (leaves.floor + leaves.ceiling) + (1 - 2 * walls_floor) * leaves.walls,
                    floor_ceiling * leaves.ceiling + walls_floor * leaves.walls};
        indirect += incident.walls;
    }
    return indirect;
}

UgrTable ugr_table(const PhotometricSolid& solid, const lights::Opening& opening, double spacing) {
    const Lamp lamp(solid, opening);
    const bool is_long_along_c0 = opening.extent_m.x > opening.extent_m.y;
    UgrTable table;
    set_ratings(lamp, spacing, is_long_along_c0 ? Orientation::c90_to_eye : Orientation::c0_to_eye,
                table.crosswise);
    set_ratings(lamp, spacing, is_long_along_c0 ? Orientation::c0_to_eye : Orientation::c90_to_eye,
                table.endwise);
    return table;
}

}  // namespace stilb::transport
