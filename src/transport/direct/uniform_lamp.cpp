#include "transport/direct/uniform_lamp.h"

#include <algorithm>
#include <array>
#include <utility>

namespace stilb::transport {

std::optional<UniformLamp> UniformLamp::of(const Scene& scene, std::size_t light, const Lift& lift) {
    const auto emission = lights::uniform_emission(scene.lights[light]);
    if (!emission) return std::nullopt;
    std::vector<lights::EmitterElement> elements =
        lights::emitter_elements(scene.object(emission->object).shape);
    if (elements.size() > kMostElements || !std::ranges::all_of(elements, lights::has_closed_form))
        return std::nullopt;
    return UniformLamp(light, emission->object, emission->luminance_cd_m2, std::move(elements), lift);
}

UniformLamp::UniformLamp(std::size_t light, ObjectId object, const Rgb& luminance_cd_m2,
                         std::vector<lights::EmitterElement> elements, const Lift& lift)
    : light_(light),
      luminance_cd_m2_(luminance_cd_m2),
      elements_(std::move(elements)),
      lift_(lift),
      hull_(object, elements_, lift) {}

double UniformLamp::projected_solid_angle_sr(const SurfacePoint& at) const {
    double sum = 0;
    for (const lights::EmitterElement& element : elements_)
        sum += lights::projected_solid_angle_sr(element, at);
    return sum;
}

std::optional<DirectSample> UniformLamp::sample(const SurfacePoint& at, math::SampleStream& stream) const {
    const auto sample_of = [&](const lights::EmitterElement& element) -> std::optional<DirectSample> {
        const auto sample = lights::sample_projected(element, at, stream);
        if (!sample) return std::nullopt;
        const Vec3& position = sample->point.position;
        const double lift_m = lift_.offset_m(position, element.size_m, length(position - at.position));
        return DirectSample{{at.lifted, position + lift_m * sample->point.normal},
                            sample->projected_solid_angle_sr * luminance_cd_m2_};
    };
    if (elements_.size() == 1) return sample_of(elements_[0]);
    const double u = stream.next();
    std::array<double, kMostElements> sums;
    double total = 0;
    for (std::size_t i = 0; i < elements_.size(); ++i)
        sums[i] = total += lights::projected_solid_angle_sr(elements_[i], at);
    if (!(total > 0)) return std::nullopt;
    const auto choice = math::choose_by_sums({sums.data(), elements_.size()}, u);
    auto sample = sample_of(elements_[choice.index]);
    if (sample) sample->illuminance_lx = total * luminance_cd_m2_;
    return sample;
}

}  // namespace stilb::transport
