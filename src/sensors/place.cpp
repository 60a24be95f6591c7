#include "sensors/place.h"

#include <array>
#include <cmath>

#include "geometry/shape.h"
#include "math/sampling.h"
#include "rays/surface_packet.h"
#include "scene/scene.h"

namespace stilb::sensors {
namespace {

/// The offset of rays near to a point, on whatever lies there.
double offset_at(const Vec3& position, const rays::RayCaster& caster) {
    return caster.offset_m(position, caster.lift().largest_size_m());
}

/// A point lies on a surface that is up to one offset in front of it or three behind, because a lamp in the
/// plane of a ceiling stands two in front of it (scene/overlaps.h).
constexpr double kBehind = 3, kInFront = 1;

std::optional<rays::Hit> close_surface(const MeasuringPoint& point, const rays::RayCaster& caster) {
    const double most = offset_at(point.position, caster);
    const auto below = caster.closest(point.position + kBehind * most * point.normal, -point.normal);
    return below && below->distance_m < (kBehind + kInFront) * most ? below : std::nullopt;
}

/// Whether the point lies in front of the lamp on which it seems to lie, and faces it. In double precision:
/// lamps are measured from nearer than rays can tell.
bool faces_lamp(const MeasuringPoint& point, const rays::Hit& close, const rays::RayCaster& caster) {
    if (close.on_front) return false;
    const Shape& shape = caster.scene().object(close.object).shape;
    const bool is_flat = caster.traced_mesh(close.object).has_value();
    const Vec3 on_surface = is_flat ? geometry::corners_of(shape, close.triangle)[0] : close.position;
    return dot(close.normal, point.position - on_surface) < 0 &&
           scene::lamps_of(caster.scene()).contains(close.object);
}

/// At the point's own position.
Place own_place(const MeasuringPoint& point, const rays::RayCaster& caster) {
    const auto close = close_surface(point, caster);
    if (!close) return {{point.position, point.normal}};
    const Vec3 lift = close->lift_m * close->normal;
    if (faces_lamp(point, *close, caster))
        return {{point.position, point.normal, close->lifted_behind()}, -lift};
    return {{point.position, point.normal, close->lifted}, lift, close};
}

/// Looks around a measuring point.
class Surroundings {
  public:
    Surroundings(const MeasuringPoint& point, const rays::RayCaster& caster)
        : point_(point),
          caster_(caster),
          frame_(Frame::of_surface(point.normal)),
          offset_m_(offset_at(point.position, caster)) {}

    /// Whether nothing but the surface that the point lies on is near to it. `own`: its own_place().
    bool is_clear(const SurfacePoint& own) const {
        const bool is_free = own.lifted == own.position;
        const Vec3 from = point_.position + (is_free ? 0 : offset_m_) * point_.normal;
        return is_clear_across(from, margin_m()) && !(is_free && is_on_rim());
    }

    /// The place around the point, of those that are accepted, from which most is in sight; nothing where
    /// none is clear of surfaces.
    template <typename Accepts>
    std::optional<Place> best_place(const Accepts& accepts) const {
        std::optional<Place> best;
        double best_sight = 0;
        bool best_is_on_surface = false;
        for (const Vec3& direction : directions()) {
            const Vec3 position = point_.position + margin_m() * direction;
            Place place = own_place({position, point_.normal}, caster_);
            const bool is_on_surface = place.surface && dot(place.surface->normal, point_.normal) > kParallel;
            if (best && best_is_on_surface && !is_on_surface) continue;
            if (is_on_surface) {
                place.position = place.lifted - place.lift;
                place.surface->position = place.position;
            } else if (place.surface) {
                place = {{position, point_.normal}};
            }
            if (!is_clear_around(place) || is_beyond_a_wall(direction, place) || !accepts(place)) continue;
            const double sight = sight_from(place.lifted);
            if (best && is_on_surface == best_is_on_surface && sight <= best_sight) continue;
            best = place, best_sight = sight, best_is_on_surface = is_on_surface;
        }
        return best;
    }

    /// The nearest surface that an eye sees beside the point. A ray into a corner may slip into a body and
    /// meet one of its faces from behind. Nothing where other surfaces are near to all that the eye sees.
    std::optional<rays::Hit> seen_from(const Vec3& eye) const {
        constexpr double beside = 2, near = 100;  // in margins; surfaces may be seen obliquely
        const Frame sight = Frame::around(normalized(point_.position - eye));
        std::optional<rays::Hit> nearest;
        for (int i = 0; i < 16; ++i) {
            const Vec3 away = std::cos(i * kPi / 8) * sight.u + std::sin(i * kPi / 8) * sight.v;
            const Vec3 end = point_.position + beside * margin_m() * away;
            const auto hit = caster_.closest(eye, normalized(end - eye));
            if (!hit || length(hit->position - point_.position) > near * margin_m()) continue;
            if (nearest && hit->distance_m >= nearest->distance_m) continue;
            const Surroundings there({hit->position, hit->normal}, caster_);
            if (there.is_clear(*hit)) nearest = hit;
        }
        return nearest;
    }

  private:
    /// The cosine between the normals of a surface and of a point that lies on it.
    static constexpr double kParallel = 0.99;

    double margin_m() const { return rays::kEdgeMargin * offset_m_; }

    /// Whether nothing crosses the plane of the point's normal within a distance of `from`.
    bool is_clear_across(const Vec3& from, double distance_m) const {
        for (int i = 0; i < 4; ++i) {
            const Vec3 away = distance_m * across(i);
            if (caster_.occluded(from - away, from + away)) return false;
        }
        return true;
    }

    bool is_clear_around(const Place& place) const {
        if (!is_clear_across(place.lifted, offset_m_)) return false;
        const Vec3 upwards = offset_m_ * point_.normal;
        return place.surface || !caster_.occluded(place.position - upwards, place.position + upwards);
    }

    /// Whether a surface separates a place in this direction from the point, one that is farther from this
    /// than it may seem to be by rounding errors.
    bool is_beyond_a_wall(const Vec3& direction, const Place& place) const {
        return caster_.occluded(place.lifted, place.lifted - (margin_m() - 2 * offset_m_) * direction);
    }

    /// Whether the point is on the rim of a surface, which a ray to it may miss by rounding errors.
    bool is_on_rim() const {
        for (int i = 0; i < 8; ++i) {
            const Vec3 beside = point_.position + offset_m_ / 4 * across(i);
            if (caster_.occluded(beside + kBehind * offset_m_ * point_.normal,
                                 beside - kInFront * offset_m_ * point_.normal))
                return true;
        }
        return false;
    }

    /// One of eight directions across the point's normal.
    Vec3 across(int number) const {
        return frame_.to_world({std::cos(number * kPi / 4), std::sin(number * kPi / 4), 0});
    }

    /// Along the surface, obliquely upwards, and upwards.
    std::array<Vec3, 25> directions() const {
        std::array<Vec3, 25> all;
        for (std::size_t i = 0; i < 24; ++i) {
            const double azimuth = static_cast<double>(i % 16) * kPi / (i < 16 ? 8 : 4);
            const double cosine = i < 16 ? 1 : std::sqrt(0.5);
            all[i] = frame_.to_world(
                {cosine * std::cos(azimuth), cosine * std::sin(azimuth), i < 16 ? 0 : cosine});
        }
        all[24] = frame_.w;
        return all;
    }

    /// How far one sees from a point: the larger, the less of the sky and the more distant surfaces are in
    /// sight.
    double sight_from(const Vec3& from) const {
        constexpr int count = 32;
        double sum = 0;
        for (int i = 0; i < count; ++i) {
            const double height = (i + 0.5) / count, azimuth = math::kGoldenAngle * i;
            const double sine = std::sqrt(1 - height * height);
            const Vec3 direction =
                frame_.to_world({sine * std::cos(azimuth), sine * std::sin(azimuth), height});
            const auto hit = caster_.closest(from, direction);
            if (hit && !caster_.is_sealed(*hit)) sum += std::log1p(hit->distance_m / margin_m());
        }
        return sum;
    }

    MeasuringPoint point_;
    const rays::RayCaster& caster_;
    Frame frame_;
    double offset_m_;
};

/// The side on which a body lies of a surface; nothing for a body that stands free.
std::optional<Vec3> side_of(const BodyPoint& body, const rays::RayCaster& caster) {
    for (const Vec3& normal : {body.axis, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
        const auto surface = own_place({body.position, normal}, caster).surface;
        if (!surface) continue;
        const bool is_along_axis = normal == body.axis;
        return is_along_axis || surface->on_front ? surface->normal : -surface->normal;
    }
    return std::nullopt;
}

}  // namespace

Place place_of(const MeasuringPoint& point, const rays::RayCaster& caster) {
    Place own = own_place(point, caster);
    const Surroundings surroundings(point, caster);
    if (surroundings.is_clear(own)) return own;
    return surroundings.best_place([](const Place&) { return true; }).value_or(own);
}

Place place_of(const BodyPoint& body, const rays::RayCaster& caster) {
    if (Place place = place_of(MeasuringPoint{body.position, body.axis}, caster); place.surface) return place;
    const auto side = side_of(body, caster);
    if (!side) return {{body.position}};
    return place_of(MeasuringPoint{body.position, *side}, caster);
}

rays::Hit clear_of_walls(const rays::Hit& hit, const Vec3& eye, const rays::RayCaster& caster) {
    const Surroundings surroundings({hit.position, hit.normal}, caster);
    if (surroundings.is_clear(hit)) return hit;
    const auto place = surroundings.best_place([&](const Place& at) {
        return at.surface && at.surface->object == hit.object && !caster.occluded(eye, at.lifted);
    });
    if (!place) return surroundings.seen_from(eye).value_or(hit);
    rays::Hit moved = *place->surface;
    moved.distance_m = length(moved.position - eye);
    return moved;
}

}  // namespace stilb::sensors
