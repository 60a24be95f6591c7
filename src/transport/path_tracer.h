// Path tracing from a surface point: the luminance that it reflects.
//
// Every reflection adds the light of one source, chosen and sampled by next-event estimation, and that of
// emitters that the path hits or that it finds where it leaves the scene, weighted against each other by
// the balance heuristic [Veach and Guibas 1995]. Both pass straight through panes. Behind mirrors and glass,
// which next-event estimation cannot pass, emitters count in full. Not found: light that leaves a
// point-like source and meets a mirror or glass first.
//
// Lights whose first reflection is stored (StoredReflection) are left out of both techniques; every surface
// adds its stored reflection instead.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "transport/lane_lights.h"
#include "transport/light_parts.h"
#include "transport/light_sampler.h"
#include "transport/lobe_choice.h"
#include "transport/path_packet.h"
#include "transport/weights.h"

namespace stilb::transport {

/// The previous vertex of a path, from which it may hit emitters in addition to next-event estimation there.
struct PreviousVertex {
    /// Density of the path's direction; infinite where next-event estimation cannot find the light of the
    /// path, 0 where it finds all of it.
    double pdf_per_sr = std::numeric_limits<double>::infinity();
    SurfacePoint point{};    ///< where the density is finite
    bool in_packet = false;  ///< next-event estimation there was that of PacketLights
};

/// For paths that leave out directly visible emission.
inline constexpr PreviousVertex kDirectIsKnown{0};

/// A path traced against the light: its present vertex and the light gathered so far.
struct Path {
    rays::Hit hit;
    Vec3 outgoing;  ///< unit, from `hit` back along the path
    math::SampleStream stream;
    int reflections_left = 0;  ///< at `hit` and behind
    Rgb throughput = Rgb::grey(1);
    Rgb luminance_cd_m2{};  ///< so far; emission of the first hit is left out
    PreviousVertex previous_vertex{};
    /// What the luminance consists of, with the reflections on the path so far: null where nobody asks.
    LightParts* parts = nullptr;
    int reflections = 0;

    /// Adds light that arrives from a lamp.
    void add(const Rgb& value, std::size_t light) {
        add_part(value, light, reflections, luminance_cd_m2, parts);
    }
};

/// The precomputed first reflection of lights that path tracing leaves out.
class StoredReflection {
  public:
    virtual ~StoredReflection() = default;

    /// Adds to each path the light of those lights that its surface reflects. `coherence`: of the
    /// paths' last rays.
    virtual void add_to(std::span<Path* const> paths, rays::Coherence coherence) const = 0;
};

/// Keeps references to its arguments. Immutable.
class PathTracer {
  public:
    /// `stored`: null where no light is left out. The lights left out must be made elsewhere in `lights`.
    PathTracer(const Scene& scene, const rays::RayCaster& caster, const LightSampler& lights,
               const StoredReflection* stored = nullptr);

    /// Follows paths to their ends, side by side, and adds to their luminances; the rest of a path is used
    /// up. Their streams have as many Sobol' dimensions. `first`: coherence of the rays to their first hits,
    /// and of the shadow rays there.
    /// Paths with parts get these, too; then all of them have some, and as many reflections left.
    void trace(std::span<Path> paths, rays::Coherence first) const;
    /// The same for paths of which the rays to their first hits are known, in the lanes that are set; adds
    /// the light along the ray of path `number` to that element of `luminances_cd_m2`, emission of the first
    /// hit weighted by the previous vertex. Uses the packets up.
    void trace(std::span<PathPacket> packets, std::span<const LaneMask> lanes, unsigned sobol_dimensions,
               rays::Coherence first, std::span<Rgb> luminances_cd_m2) const;

    /// Follows a path through mirrors and glass to the next surface that scatters, on the side where light
    /// arrives. Nothing where the path ends before.
    std::optional<LobeChoice> follow_to_scattering(Path& path) const;

    /// Light from one source at `surface`, shadows included; nothing where none arrives.
    std::optional<IncidentLight> sample_light(const rays::Hit& surface, math::SampleStream& stream) const;

    /// One sample of the luminance [cd/m2] that arrives along a ray with the hit `hit`, without the emission
    /// of `hit` itself. Uses up numbers of the stream. `parts`: may be null, here and below.
    Rgb luminance_behind(const rays::Hit& hit, const Vec3& direction, const PreviousVertex& previous_vertex,
                         int max_reflections, math::SampleStream& stream, LightParts* parts = nullptr) const;
    /// The same without all directly visible emission: that is direct light.
    Rgb luminance_without_direct(const rays::Hit& hit, const Vec3& direction, int max_reflections,
                                 math::SampleStream& stream, LightParts* parts = nullptr) const {
        return luminance_behind(hit, direction, kDirectIsKnown, max_reflections, stream, parts);
    }
    /// All the light along a ray.
    Rgb luminance(const rays::Hit& hit, const Vec3& direction, int max_reflections,
                  math::SampleStream& stream, LightParts* parts = nullptr) const {
        return lights_.emitted_luminance(hit, -direction, parts) +
               luminance_behind(hit, direction, {}, max_reflections, stream, parts);
    }
    /// The same, where emission directly visible from `previous_vertex` is weighted against next-event
    /// estimation there.
    Rgb incoming_luminance(const rays::Ray& ray, const PreviousVertex& previous_vertex, int max_reflections,
                           math::SampleStream& stream, LightParts* parts = nullptr) const;

    const Material& material(const rays::Hit& hit) const { return scene_.material(hit.material); }

  private:
    friend class PathWave;

    /// A diffuse material, in single precision; other materials are not plain.
    struct PlainMaterial {
        std::array<float, kBands> reflectance{};
        bool is_plain = false;
    };
    bool is_plain(const rays::SurfacePacket& surface, std::size_t lane) const {
        return surface.is_smooth[lane] == 0 && plain_materials_[surface.material[lane]].is_plain;
    }

    /// The light of a source at a path's surface if nothing lies in between.
    struct Connection {
        rays::Segment segment;
        Rgb luminance_cd_m2;
        std::uint32_t light = 0;
    };
    /// The next step of a path at its present vertex: it ends if there is no ray.
    struct Step {
        std::optional<Connection> connection;
        std::optional<rays::Ray> ray;
    };
    Step take_step(Path& path) const;
    /// The light of the left-out lights that the paths' surfaces reflect.
    void add_stored_reflection(std::span<Path> paths, rays::Coherence coherence) const;
    std::optional<LobeChoice> choose_lobe(Path& path) const;
    std::optional<rays::Ray> pass_specular(Path& path, const LobeChoice& specular) const;
    /// Moves a path through a specular surface to the next one; false where it ends.
    bool pass(Path& path, const LobeChoice& specular) const;
    Step reflect(Path& path, const LobeChoice& scattering) const;
    /// Continues where the step's ray has hit a surface.
    void arrive(Path& path, const Vec3& direction, const rays::Hit& next) const;
    /// Continues where the step's ray leaves the scene.
    void leave(Path& path, const Vec3& direction) const;
    /// Calls `visit(luminance, light)` for emission that a path finds, by its MIS weight; likewise for light
    /// from outside.
    template <typename Visit>
    void for_each_emission_towards(const PreviousVertex& previous_vertex, const rays::Hit& emitter,
                                   const Vec3& leaving, const Visit& visit) const;
    template <typename Visit>
    void visit_outside_light_towards(const PreviousVertex& previous_vertex, const Vec3& direction,
                                     const Visit& visit) const;
    /// The density of next-event estimation at the previous vertex.
    double pdf_per_sr(const PreviousVertex& previous_vertex, std::size_t light,
                      const rays::Hit& emitter) const;
    /// A single path.
    void follow(Path& path) const;

    const Scene& scene_;
    const rays::RayCaster& caster_;
    const LightSampler& lights_;
    const StoredReflection* stored_;
    std::vector<PlainMaterial> plain_materials_;  ///< by MaterialId
    std::vector<bool> may_emit_;                  ///< by ObjectId
    PacketLights packet_lights_;
};

/// The MIS weight of light that a path finds by itself. `other_pdf_per_sr`: the density of next-event
/// estimation at the previous vertex, if that could have found it.
template <typename Pdf>
double share_of(const PreviousVertex& previous_vertex, const Pdf& other_pdf_per_sr) {
    const double pdf_per_sr = previous_vertex.pdf_per_sr;
    if (pdf_per_sr == 0 || std::isinf(pdf_per_sr)) return pdf_per_sr == 0 ? 0 : 1;
    return balance(pdf_per_sr, other_pdf_per_sr());
}

template <typename Visit>
void PathTracer::for_each_emission_towards(const PreviousVertex& previous_vertex, const rays::Hit& emitter,
                                           const Vec3& leaving, const Visit& visit) const {
    lights_.for_each_emission(emitter, leaving, [&](std::size_t light, const Rgb& emission) {
        visit(
            emission * share_of(previous_vertex, [&] { return pdf_per_sr(previous_vertex, light, emitter); }),
            light);
    });
}

template <typename Visit>
void PathTracer::visit_outside_light_towards(const PreviousVertex& previous_vertex, const Vec3& direction,
                                             const Visit& visit) const {
    const Rgb luminance = lights_.outside_luminance(direction);
    if (!(luminance.max() > 0)) return;
    visit(luminance * share_of(previous_vertex,
                               [&] { return lights_.outside_pdf_per_sr(direction, previous_vertex.point); }),
          lights_.light_from_outside());
}

}  // namespace stilb::transport
