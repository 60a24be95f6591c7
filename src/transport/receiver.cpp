
#include "transport/receiver.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "materials/diffuse.h"
#include "math/morton.h"
#include "sensors/place.h"
#include "transport/weights.h"

namespace stilb::transport {

namespace {

const Material& white() {
    static const Material material = Diffuse{Rgb::grey(1)};
    return material;
}

}  // namespace

Receiver::Receiver(std::uint32_t reading, const MeasuringPoint& point, const rays::RayCaster& caster)
    : surface_(white(), point.normal, point.normal),
      outgoing_{0, 0, 1},
      factor_(Rgb::grey(kPi)),
      constant_response_(Rgb::grey(1)),
      reading_(reading) {
    const sensors::Place place = place_of(point, caster);
    point_ = place;
    lift_ = place.lift;
}

Receiver::Receiver(std::uint32_t reading, const BodyPoint& body, const rays::RayCaster& caster)
    : surface_(white(), body.axis, body.axis),
      body_(body.sensitivity),
      outgoing_{0, 0, 1},
      factor_(Rgb::grey(kPi)),
      constant_response_(Rgb::grey(1)),
      reading_(reading) {
    const sensors::Place place = place_of(body, caster);
    point_ = {place.position, {}, place.lifted};
    lift_ = place.lift;
    if (place.surface) horizon_ = place.surface->normal;
}

Receiver::Receiver(std::uint32_t reading, const SubPoint& sub_point, const Material& material)
    : point_(sub_point.surface),
      lift_(sub_point.surface.lift_m * sub_point.surface.normal),
      surface_(sub_point.lobe ? sub_point.lobe->scattering : material, point_.normal,
               sub_point.surface.shading_normal),
      outgoing_(surface_.frame().to_local(sub_point.outgoing)),
      factor_(sub_point.transmission),
      material_(sub_point.lobe ? std::nullopt : std::optional(sub_point.surface.material)),
      reflections_(sub_point.reflections + 1),
      reading_(reading) {
    set_constant_response();
}

void Receiver::set_constant_response() {
    const auto* diffuse = surface_.material().get_if<Diffuse>();
    constant_response_.reset();
    if (diffuse && !surface_.is_bent())
        constant_response_ = factor_ * diffuse->reflectance * std::numbers::inv_pi;
}

Receiver Receiver::with_material(const Material& material) const {
    Receiver result = *this;
    result.surface_.set_material(material);
    result.set_constant_response();
    return result;
}

double Receiver::sensitivity(const Vec3& direction) const {
    if (!body_) return std::max(0.0, dot(direction, point_.normal));
    if (horizon_ && dot(direction, *horizon_) <= 0) return 0;
    return body_->of(surface_.frame().to_local(direction));
}

Receiver::Response Receiver::response(const Vec3& direction) const {
    if (constant_response_) return {*constant_response_};
    const Rgb brdf = surface_.brdf_per_sr(surface_.frame().to_local(direction), outgoing_);
    return {factor_ * brdf, relative_brdf(surface_.material(), brdf)};
}

std::optional<Receiver::Sample> Receiver::sample(double u1, double u2) const {
    if (body_) {
        const Vec3 local = body_->sample(u1, u2);
        const Vec3 direction = surface_.frame().to_world(local);
        if (horizon_ && dot(direction, *horizon_) <= 0) return std::nullopt;
        return Sample{direction, factor_, body_->of(local) / kPi};
    }
    const auto scattered = surface_.sample_incoming(outgoing_, u1, u2);
    if (!scattered) return std::nullopt;
    return Sample{surface_.frame().to_world(scattered->direction), factor_ * scattered->weight,
                  scattered->pdf_per_sr};
}

double Receiver::pdf_per_sr(const Vec3& direction) const {
    if (body_) return sensitivity(direction) / kPi;
    return surface_.pdf_of_incoming_per_sr(outgoing_, surface_.frame().to_local(direction));
}

Receiver Receiver::without_response() const {
    Receiver result = *this;
    result.surface_ = {white(), point_.normal, point_.normal};
    result.outgoing_ = {0, 0, 1};
    result.factor_ = Rgb::grey(kPi);
    result.constant_response_ = Rgb::grey(1);
    return result;
}

std::optional<Receiver> receiver_of_illuminance(std::uint32_t reading, const Measurand& measurand,
                                                const rays::RayCaster& caster) {
    struct Make {
        std::uint32_t reading;
        const rays::RayCaster& caster;
        std::optional<Receiver> operator()(const MeasuringPoint& point) const {
            return Receiver(reading, point, caster);
        }
        std::optional<Receiver> operator()(const BodyPoint& body) const {
            return Receiver(reading, body, caster);
        }
        std::optional<Receiver> operator()(const LineOfSight&) const { return std::nullopt; }
        std::optional<Receiver> operator()(const EmergentRay&) const { return std::nullopt; }
    };
    return std::visit(Make{reading, caster}, measurand);
}

std::vector<Receiver> sorted_receivers(std::vector<Receiver> receivers) {
    std::vector<Vec3> positions;
    for (const Receiver& receiver : receivers) positions.push_back(receiver.position());
    std::vector<std::uint32_t> order = math::morton_order(positions);
    // Bodies follow all others, so that at most one packet has both.
    std::stable_partition(order.begin(), order.end(), [&](auto i) { return !receivers[i].is_body(); });
    std::vector<Receiver> sorted;
    sorted.reserve(receivers.size());
    for (const std::uint32_t i : order) sorted.push_back(receivers[i]);
    return sorted;
}

}  // namespace stilb::transport
