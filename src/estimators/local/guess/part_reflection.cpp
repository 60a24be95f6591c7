#include "estimators/local/guess/part_reflection.h"

#include <algorithm>
#include <numbers>

#include "math/sampling.h"
#include "transport/receiver.h"

namespace stilb::estimators {
namespace {

/// The parts of a surface's BRDF with their shares, as one BRDF that is sampled by part.
class SharedReflection {
  public:
    SharedReflection(const rays::Hit& surface, const Vec3& outgoing, const materials::SplitMaterial& material,
                     const PartShares& shares)
        : material_(material),
          shares_(shares),
          gloss_(material.gloss ? *material.gloss : material.diffuse, surface.normal, surface.normal),
          outgoing_(gloss_.frame().to_local(outgoing)) {
        const double diffuse = material.diffuse_reflectance.luminance() * shares.diffuse();
        const double gloss = material.gloss ? material.gloss_reflectance().luminance() *
                                                  shares.of_mean_gloss(mean_concentration(*material.gloss))
                                            : 0;
        diffuse_probability_ = diffuse + gloss > 0 ? diffuse / (diffuse + gloss) : 1;
    }

    const Frame& frame() const { return gloss_.frame(); }

    /// For a direction of incident light in frame().
    materials::ScatterValue evaluate(const Vec3& in) const {
        if (in.z <= 0) return {};
        materials::ScatterValue value{
            material_.diffuse_reflectance * (std::numbers::inv_pi * shares_.diffuse()),
            diffuse_probability_ * math::cosine_hemisphere_pdf_per_sr(in.z)};
        if (material_.gloss) {
            const auto [brdf, pdf] = gloss_.evaluate(in, outgoing_);
            value.brdf_per_sr += brdf * shares_.of_gloss(transport::relative_brdf(*material_.gloss, brdf));
            value.pdf_per_sr += (1 - diffuse_probability_) * pdf;
        }
        return value;
    }

    std::optional<Vec3> sample_incoming(math::SampleStream& stream) const {
        const double u = stream.next();
        const auto [u1, u2] = stream.next_two();
        if (u < diffuse_probability_) return math::sample_cosine_hemisphere(u1, u2).direction;
        const auto scattered = gloss_.sample_incoming(outgoing_, u1, u2);
        return scattered ? std::optional{scattered->direction} : std::nullopt;
    }

  private:
    const materials::SplitMaterial& material_;
    const PartShares& shares_;
    materials::ShadedSurface gloss_;
    Vec3 outgoing_;
    double diffuse_probability_ = 1;
};

}  // namespace

double continuation_probability(const materials::SplitMaterial& material, const PartShares& shares) {
    const double of_diffuse = shares.diffuse();
    if (!material.gloss) return of_diffuse;
    const double gloss = material.gloss_reflectance().luminance();
    const double all = gloss + material.diffuse_reflectance.luminance();
    const double of_gloss = shares.of_mean_gloss(mean_concentration(*material.gloss));
    return std::max(of_diffuse, all > 0 ? of_gloss * gloss / all : 0);
}

transport::LightSum reflected_luminance(const transport::PathTracer& tracer, const rays::Hit& surface,
                                        const Vec3& outgoing, const materials::SplitMaterial& material,
                                        const PartShares& shares, math::SampleStream& stream,
                                        const transport::Channels* channels) {
    const SharedReflection reflection(surface, outgoing, material, shares);
    transport::LightSum sum(channels);
    if (const auto light = tracer.sample_light(surface, stream)) {
        const Vec3 in = reflection.frame().to_local(light->direction);
        const auto [brdf, pdf] = reflection.evaluate(in);
        sum.add(light->normal_illuminance_lx * brdf * (in.z * transport::balance(light->pdf_per_sr, pdf)),
                light->light, 1);
    }
    const double survival = transport::survival_probability(
        Rgb::grey(1), material.diffuse_reflectance + material.gloss_reflectance());
    if (stream.next() >= survival) return sum;
    const auto in = reflection.sample_incoming(stream);
    if (!in || in->z <= 0) return sum;
    const auto [brdf, pdf] = reflection.evaluate(*in);
    if (!(pdf > 0)) return sum;
    transport::LightSum incoming(channels);
    incoming.add_sample(Rgb::grey(1), [&](auto* parts) {
        return tracer.incoming_luminance({surface.lifted, reflection.frame().to_world(*in)},
                                         {pdf, surface.position, surface.normal}, transport::kUnlimited,
                                         stream, parts);
    });
    incoming.reflect();
    sum.add(incoming *= brdf, Rgb::grey(in->z / (pdf * survival)));
    return sum;
}

}  // namespace stilb::estimators
