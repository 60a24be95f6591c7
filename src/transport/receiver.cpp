#include "transport/receiver.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "math/morton.h"
#include "transport/kernel_split.h"

namespace stilb::transport {
namespace {

constexpr double kPi = std::numbers::pi;

const Material& white() {
    static const Material material = Diffuse{Rgb::grey(1)};
    return material;
}

}  // namespace

Receiver::Receiver(std::uint32_t reading, const MeasuringPoint& point, const rays::RayCaster& caster)
    : position_(point.position),
      lifted_(lifted_position(point, caster)),
      normal_(point.normal),
      surface_(white(), normal_, normal_),
      outgoing_{0, 0, 1},
      factor_(Rgb::grey(kPi)),
      constant_response_(Rgb::grey(1)),
      reading_(reading) {}

Receiver::Receiver(std::uint32_t reading, const BodyPoint& body, const rays::RayCaster& caster)
    : position_(body.position),
      lifted_(body.position),
      surface_(white(), body.axis, body.axis),
      body_(body.sensitivity),
      outgoing_{0, 0, 1},
      factor_(Rgb::grey(kPi)),
      constant_response_(Rgb::grey(1)),
      reading_(reading) {
    if (const auto surface = surface_at(body, caster)) {
        lifted_ = surface->lifted;
        horizon_ = surface->normal;
    }
}

Receiver::Receiver(std::uint32_t reading, const SubPoint& sub_point, const Material& material)
    : position_(sub_point.surface.position),
      lifted_(sub_point.surface.lifted),
      normal_(sub_point.surface.normal),
      surface_(material, normal_, sub_point.surface.shading_normal),
      outgoing_(surface_.frame().to_local(sub_point.outgoing)),
      factor_(sub_point.transmission),
      reflections_(sub_point.reflections + 1),
      reading_(reading) {
    const auto* diffuse = std::get_if<Diffuse>(&material);
    if (diffuse && !surface_.is_bent()) {
        constant_response_ = factor_ * diffuse->reflectance * std::numbers::inv_pi;
    }
}

double Receiver::sensitivity(const Vec3& direction) const {
    if (!body_) return std::max(0.0, dot(direction, normal_));
    if (horizon_ && dot(direction, *horizon_) <= 0) return 0;
    return body_->of(surface_.frame().to_local(direction));
}

Rgb Receiver::response(const Vec3& direction) const {
    if (constant_response_) return *constant_response_;
    return factor_ * surface_.brdf_per_sr(surface_.frame().to_local(direction), outgoing_);
}

double Receiver::relative_response(const Vec3& direction) const {
    if (constant_response_) return 1;
    return relative_brdf(surface_.material(),
                         surface_.brdf_per_sr(surface_.frame().to_local(direction), outgoing_));
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
    result.surface_ = {white(), normal_, normal_};
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
    const std::vector<std::uint64_t> codes = math::morton_codes(positions);
    std::vector<std::uint32_t> order(receivers.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return codes[a] < codes[b]; });
    // So that at most one packet has bodies beside other receivers.
    std::stable_partition(order.begin(), order.end(), [&](auto i) { return !receivers[i].is_body(); });
    std::vector<Receiver> sorted;
    sorted.reserve(receivers.size());
    for (const std::uint32_t i : order) sorted.push_back(receivers[i]);
    return sorted;
}

}  // namespace stilb::transport
