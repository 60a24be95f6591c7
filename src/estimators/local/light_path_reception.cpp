#include "estimators/local/light_path_reception.h"

#include <algorithm>
#include <limits>

#include "estimators/limits.h"
#include "estimators/local/connection.h"
#include "estimators/local/gather.h"
#include "estimators/local/split_plan.h"

namespace stilb::estimators {
namespace {

/// Light paths of a pass, and the number of them for one selected path's vertices in a packet. The more paths
/// are traced, the more evenly the selected vertices lie; tracing costs less than a hundredth of a large
/// picture's pass.
constexpr std::uint64_t kPathsPerPass = 4096;
constexpr std::uint64_t kPathsPerSelected = 256;
/// The k of diffuse receivers, over that of a plan: plans expect vertices by their flux, but those near a
/// receiver are chosen, so that connections cost less variance (docs/lab-book.md).
constexpr double kDiffuseFactor = 8;
/// Planning rays from each sub-point.
constexpr unsigned kPilotRays = 4;

}  // namespace

LightPathReception::LightPathReception(const LocalTransport& transport, const Problem& problem,
                                       const SubPoints& sub_points)
    : transport_(transport),
      sub_points_(sub_points),
      plan_{{problem.preparation_key.derived(PreparationStream::picture_plan)}, 0},
      area_m2_(surface_area_m2(transport.scene)),
      paths_(paths_at_once(transport.scene, kPathsPerPass)),
      pilot_paths_(paths_at_once(transport.scene, kPilotPaths)),
      k_per_m2_(sub_points.cells()) {
    if (transport.split != Split::none)
        pilot_nodes_ = transport.trace_light_paths(
            problem.preparation_key.derived(PreparationStream::picture_light_paths), 0, pilot_paths_);
}

NearNodePool LightPathReception::trace(const Pass& pass) const {
    return {transport_.trace_light_paths(pass.key.derived(PassStream::light_paths), pass.index * paths_,
                                         (pass.index + 1) * paths_),
            transport_.caster.center()};
}

void LightPathReception::receive(std::span<const SubPointPacket> packets, const Pixel& block_pixel,
                                 const NearNodePool& pool, const Pass& pass, Tally& sums) const {
    choose_near(pool, packets, k_per_m2_of(block_pixel),
                [&](const SubPointPacket& packet, const KernelChoice::Sums& near) {
                    receive(packet, pool, near, pass, sums);
                });
}

void LightPathReception::receive(const SubPointPacket& packet, const NearNodePool& pool,
                                 const KernelChoice::Sums& near, const Pass& pass, Tally& sums) const {
    std::vector<double> k_per_m2;
    for (std::size_t i = 0; i < packet.pixels.size(); ++i) {
        const double factor = packet.receivers[i].constant_response() ? kDiffuseFactor : 1;
        k_per_m2.push_back(factor * k_per_m2_of(packet.pixels[i]));
    }
    const std::vector<PointTile> tiles =
        tiles_of(packet.receivers, k_per_m2, transport_.caster, transport_.max_reflections,
                 transport::VertexChoice::by_kernel);
    const double u = math::SampleStream(packet.key(pass, PassStream::selection), pass.index).next();
    std::vector<transport::LightVertex> nodes = pool.select(near, near.size() / kPathsPerSelected + 1, u);
    for (transport::LightVertex& vertex : nodes) vertex.flux_lm *= 1.0 / static_cast<double>(paths_);
    const transport::Channels* const channels = sub_points_.tracing().channels;
    Connections(transport_.caster, tiles, transport_.monitor, channels).collect(nodes, sums);
    if (!transport_.gathers) return;
    const std::vector<SplitPlan> plans(packet.receivers.size(), {0, 1});
    Gather(transport_.caster, transport_.tracer, tiles, plans, Monitor::none(), channels)
        .collect({{packet.key(pass, PassStream::gather)}, pass.index, 1}, sums);
}

double LightPathReception::k_per_m2_of(const Pixel& pixel) const {
    const std::size_t cell = sub_points_.cell_of(pixel);
    return k_per_m2_.of(cell, [&] {
        const std::vector<transport::Receiver> receivers = sub_points_.of_cell(cell, plan_);
        if (transport_.split == Split::none || receivers.empty())
            return std::numeric_limits<double>::infinity();
        const PilotLight pilot{pilot_nodes_,     pilot_paths_, {}, area_m2_, transport_.max_reflections,
                               kPathsPerSelected};
        return plan_constant(transport_.caster, transport_.tracer, receivers, pilot,
                             std::max<std::uint64_t>(1, paths_ / kPathsPerSelected), kPilotRays,
                             plan_.key.derived(PassStream::plan_rays).derived(cell));
    });
}

}  // namespace stilb::estimators
