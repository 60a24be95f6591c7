// Receivers: the points where light arrives, and their contribution to readings.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "materials/shaded_surface.h"
#include "rays/ray_caster.h"
#include "sensors/sensor.h"
#include "transport/light_sampler.h"
#include "transport/line_of_sight.h"

namespace stilb::transport {

/// Reflections without limit.
inline constexpr int kUnlimited = std::numeric_limits<int>::max();

/// A point where light arrives. It adds to its reading
///
///     integral over the sphere of L(direction) response(direction) sensitivity(direction) d direction.
///
/// On a surface the sensitivity is cos+ to the normal; on a small body that stands free it is the mean of
/// that over the body's surface. The integral of either is pi.
///
/// For illuminance the response is 1. For luminance the point is a sub-point z of the line of sight, and the
/// response is the BRDF there times the transmittance of mirrors and glass between it and the sensor
/// [LocalEstimation (8) to (10)].
class Receiver {
  public:
    /// A receiver of illuminance.
    Receiver(std::uint32_t reading, const MeasuringPoint& point, const rays::RayCaster& caster);
    Receiver(std::uint32_t reading, const BodyPoint& body, const rays::RayCaster& caster);
    /// A receiver of luminance. `material`: of the sub-point, not specular, or composed.
    Receiver(std::uint32_t reading, const SubPoint& sub_point, const Material& material);

    std::uint32_t reading() const { return reading_; }
    void set_reading(std::uint32_t reading) { reading_ = reading; }
    /// Where light arrives: in the open for a body, which has no surface normal.
    const SurfacePoint& point() const { return point_; }
    const Vec3& position() const { return point_.position; }
    const Vec3& lifted() const { return point_.lifted; }
    /// Off the surface that the point lies on; 0 where it lies on none.
    const Vec3& lift() const { return lift_; }
    const Vec3& normal() const { return point_.normal; }
    bool is_body() const { return body_ != nullptr; }
    /// The sensitivity for unit directions towards the incident light.
    double sensitivity(const Vec3& direction) const;
    /// The reflections that remain of a limit for light before it arrives here.
    int reflections_left(int max_reflections) const {
        return max_reflections == kUnlimited ? kUnlimited : max_reflections - reflections_;
    }

    /// The response where it does not depend on direction.
    const std::optional<Rgb>& constant_response() const { return constant_response_; }
    /// From here to the sensor.
    int reflections() const { return reflections_; }
    struct Response {
        Rgb value;            ///< 1, or [1/sr]
        double relative = 1;  ///< pi f / albedo: s of weights.h; 1 where the response is constant
    };
    /// For unit directions above the surface, towards the incident light.
    Response response(const Vec3& direction) const;

    struct Sample {
        Vec3 direction;
        Rgb weight;  ///< response x sensitivity / pdf
        double pdf_per_sr = 0;
    };
    /// Samples a direction of incident light, about in proportion to response x sensitivity; nothing where
    /// the surface absorbs the light.
    std::optional<Sample> sample(double u1, double u2) const;
    double pdf_per_sr(const Vec3& direction) const;

    /// The point with the response of its illuminance.
    Receiver without_response() const;
    /// The surface's material in the scene; nothing for illuminance, and for lobes of a material.
    std::optional<MaterialId> material() const { return material_; }
    /// Whether the surface's shading normal differs from its own.
    bool is_bent() const { return surface_.is_bent(); }
    /// A receiver of luminance with another material, such as a part of its own, which must outlive it.
    Receiver with_material(const Material& material) const;

  private:
    void set_constant_response();

    SurfacePoint point_;
    Vec3 lift_;
    materials::ShadedSurface surface_;  ///< its material is owned by the scene; white for illuminance
    const sensors::Sensitivity* body_ = nullptr;  ///< nothing on a surface
    /// Normal of the surface that a body lies on, which hides half of the sphere.
    std::optional<Vec3> horizon_;
    Vec3 outgoing_;  ///< in the frame of the surface
    Rgb factor_;
    std::optional<Rgb> constant_response_;
    std::optional<MaterialId> material_;
    int reflections_ = 0;  ///< from here to the sensor
    std::uint32_t reading_ = 0;
};

/// The receiver of an illuminance; nothing for a luminance.
std::optional<Receiver> receiver_of_illuminance(std::uint32_t reading, const Measurand& measurand,
                                                const rays::RayCaster& caster);

/// The receivers of all readings, sorted along a space-filling (Morton) curve, bodies after all others:
/// neighbours in space share packets of rays. A packet is kPacketWidth of them from a multiple of
/// kPacketWidth on. A reading may have several (several sub-points) or none.
std::vector<Receiver> sorted_receivers(std::vector<Receiver> receivers);

}  // namespace stilb::transport
