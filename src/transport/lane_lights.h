// Next-event estimation for sixteen surface points at once, in scenes that have few lights, all of them
// points or right-angled rectangles. The expectation is that of LightSampler, in a
// fraction of its time; the densities are its own.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "lights/solid_angle/lane_rectangle.h"
#include "math/random_lanes.h"
#include "rays/ray_caster.h"
#include "transport/light_sampler.h"

namespace stilb::transport {

/// The decisions that take hashed numbers (NumberPacket).
enum HashedNumber : std::uint32_t { kChoiceOfLight, kRoulette };

/// Light that arrives at the lanes' points, visibility left out; as IncidentLight.
struct alignas(64) LightPacket {
    using Floats = RayPacket::Floats;
    rays::LaneVectors source;                          ///< lifted; relative to the scene's centre
    rays::LaneVectors direction;                       ///< unit
    std::array<Floats, kBands> normal_illuminance_lx;  ///< 0 where no light arrives
    Floats inverse_pdf_sr;                             ///< 0 for points
    RayPacket::Words light;                            ///< of Scene::lights
};

/// Immutable.
class LaneLights {
  public:
    static constexpr std::size_t kMost = 32;

    /// Nothing where some light is of another kind, or where there are none or too many.
    static std::optional<LaneLights> of(const Scene& scene, const Lift& lift, const LightSampler& lights);

    /// Samples one light at each point by the first two numbers.
    void sample(const rays::SurfacePacket& at, const math::NumberPacket& numbers, LightPacket& light) const;
    /// The density of the direction from a surface to a point of a light's surface in sample(). Relative to
    /// the scene's centre.
    float pdf_per_sr(std::size_t light, const Vec3& position, const Vec3& from, const Vec3& normal) const;

  private:
    struct Light {
        lights::LaneRectangle rectangle;           ///< of points: its corner
        std::array<float, kBands> emission;        ///< luminance [cd/m2] or, of points, intensity [cd]
        float squared_radius_m2 = 0, flux_lm = 0;  ///< for the choice among lights; of points: 4 pi intensity
        bool is_point = false;
    };
    /// The lights of the lanes.
    struct alignas(64) Chosen;

    static void add_rough(const Light& light, const rays::SurfacePacket& at, RayPacket::Floats& rough,
                          RayPacket::Floats& sum);
    void choose(const rays::SurfacePacket& at, const math::NumberPacket& numbers, Chosen& chosen) const;
    void sample_chosen(const Chosen& chosen, const rays::SurfacePacket& at, const math::NumberPacket& numbers,
                       LightPacket& light) const;
    static float rough_lx(const Light& light, const lights::LanePoint& from, const lights::LanePoint& normal);

    std::vector<Light> lights_;
    std::shared_ptr<const Chosen> only_;  ///< the choice where there is one light; else null
    float least_size_m_ = 0;              ///< see Lift
};

/// Samples of direct light at packets of surface points: one light at each, by LaneLights where it has all
/// lights, else by LightSampler, lane by lane. Immutable. Keeps references to caster and lights.
class PacketLights {
  public:
    PacketLights(const Scene& scene, const rays::RayCaster& caster, const LightSampler& lights);

    /// For the lanes that are set. Uses numbers of the streams up; of those that it returns, the third and
    /// the fourth one are left. `sobol_dimensions`: of the streams.
    math::NumberPacket sample(const rays::SurfacePacket& at, const LaneMask& lanes,
                              math::StreamPacket& streams, unsigned sobol_dimensions,
                              LightPacket& light) const;
    /// The density of the direction from a point to `hit`, on the emitter of a light.
    double pdf_per_sr(std::size_t light, const rays::Hit& hit, const SurfacePoint& at) const;

  private:
    void sample_one_by_one(const rays::SurfacePacket& at, const LaneMask& lanes,
                           const math::StreamPacket& streams, unsigned sobol_dimensions,
                           LightPacket& light) const;

    const rays::RayCaster& caster_;
    const LightSampler& lights_;
    std::optional<LaneLights> lane_lights_;
};

}  // namespace stilb::transport
