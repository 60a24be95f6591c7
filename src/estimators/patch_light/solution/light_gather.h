// The light that reaches the vertices of a solution after one reflection or more, by rays from the vertices.
//
// Where a ray meets a surface, the direct light there is sampled, and the light that it reflects after
// further reflections is known in two ways: from the patches of the walks (gathered once), or from the
// vertices around, as the rays have found it so far (gathered twice, and more often as the run goes on). The
// result is gathered twice. What the two differ by, along the same rays, is the error of the patches in the
// light of one more reflection: a bound for the error of the result.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/monitor.h"
#include "estimators/patch_light/incoming_light.h"
#include "estimators/patch_light/patch_transport.h"
#include "estimators/patch_light/solution/grouped_lights.h"
#include "estimators/patch_light/solution/light_vertices.h"
#include "estimators/patch_light/solution/patch_solution.h"
#include "estimators/patch_light/solution/reflection_table.h"
#include "math/zernike.h"
#include "transport/path_tracer.h"

namespace stilb::estimators {

/// Keeps references to all arguments but the key.
class LightGather {
  public:
    /// `walks`: their light. `is_lit`: per side of the walks' patches.
    LightGather(const PatchTransport& coarse, const TermSums& walks, std::size_t replicates,
                const std::vector<bool>& is_lit, const patches::FinePatches& fine, const LightGroups& groups,
                math::RandomKey key, const Monitor& monitor);

    /// One ray from every vertex for each replicate.
    void step();
    std::uint64_t steps() const { return steps_; }
    /// Steps before there is light that was gathered twice, in all replicates.
    static constexpr std::uint64_t kFirstSteps = 2;

    /// What it has gathered between two steps, as bytes. Reading throws InputError where they are not those
    /// of such a gathering.
    void write(ByteWriter& bytes) const;
    void read(ByteReader& bytes);

    /// The layout and the light; without light before kFirstSteps.
    PatchSolution solution() const;

    /// The illuminances of the vertices, for errors.
    struct Illuminances {
        /// Replicates x vertices: the mean of each, direct light included [lx].
        std::vector<double> replicate_means;
        std::vector<double> bias_lx;               ///< per vertex: what the patches add or lack at most
        std::vector<double> area_m2;               ///< per vertex: of the surface around
        std::span<const std::uint32_t> lit_sides;  ///< of the vertices, see LightVertices
    };
    Illuminances illuminances() const;

  private:
    struct GatheredRay;
    struct LitCorners;

    void find_origins(const std::vector<bool>& is_lit);
    bool is_covered(const SurfacePoint& origin, const std::vector<bool>& is_lit) const;
    void add_direct_light();
    void renew_source();
    void renew_source_shares();
    void forget_first_step();
    /// Rays of each replicate: without the first one, as soon as there are others.
    double rays_that_count() const { return static_cast<double>(steps_ > 1 ? steps_ - 1 : steps_); }
    /// All replicates' next rays of some vertices.
    void gather(std::uint32_t first, std::uint32_t last);
    std::optional<GatheredRay> start(std::uint32_t vertex, std::uint32_t replicate) const;
    void follow(std::span<GatheredRay> rays) const;
    void reflect(GatheredRay& ray, const std::optional<PatchLocation>& location) const;
    void add_of_walk(const GatheredRay& ray, std::uint32_t coarse_side) const;
    void add_of_vertices(GatheredRay& ray, const PatchLocation& location) const;
    void add_of_lamps(GatheredRay& ray) const;
    LitCorners lit_corners(const PatchLocation& location, std::uint32_t replicate) const;
    void add(const GatheredRay& ray);
    std::size_t group_of(const transport::Path& ended) const;
    /// The number of a vertex's first term of a group. Its groups lie beside each other in memory, because
    /// they are read together.
    std::size_t first_of(std::size_t group, std::uint32_t vertex) const {
        return groups_.count() * vertices_.first_term(vertex) + group * vertices_.terms_of(vertex);
    }
    double illuminance_lx(std::uint32_t vertex) const;
    double bias_lx(std::uint32_t vertex) const;

    const PatchTransport& coarse_;
    const TermSums& walks_;
    std::size_t replicates_;
    const patches::FinePatches& fine_;
    const LightGroups& groups_;
    math::RandomKey key_;
    const Monitor& monitor_;
    patches::PatchCaster fine_caster_;
    math::ZernikeBasis basis_;
    std::vector<ReflectionTable> tables_;  ///< per material of the scene
    GroupedLights lights_;
    /// The lights that first shot replaces; the walks' patches have the direct light of others.
    std::optional<GroupedLights> replaced_lights_;
    transport::PathTracer tracer_;

    LightVertices vertices_;
    std::vector<std::size_t> first_origin_;    ///< per vertex, and the end
    std::vector<SurfacePoint> origins_;        ///< places of a vertex that rays start from
    std::vector<double> direct_lx_, area_m2_;  ///< per vertex

    std::uint64_t steps_ = 0;
    /// Sums of the vertices' terms over the rays of all replicates. Rays of the first step bring light that
    /// was gathered once, all others light that was gathered twice.
    std::vector<FloatRgb> sums_;
    std::vector<FloatRgb> source_;  ///< their mean, renewed from time to time
    /// Vertices x replicates: the illuminance that each replicate found, divided by their mean.
    std::vector<float> source_shares_;
    /// Vertices x replicates: sums of illuminances, luminance-weighted, by each replicate's own light.
    std::vector<double> replicate_lx_;
    std::vector<double> difference_lx_;  ///< per vertex: sum of what the two ways differ by
};

}  // namespace stilb::estimators
