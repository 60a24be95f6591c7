#include "estimators/local/local_picture.h"

#include <algorithm>
#include <limits>

#include "estimators/local/connection.h"
#include "estimators/local/gather.h"
#include "estimators/local/node_pool.h"
#include "estimators/local/split_plan.h"
#include "estimators/local/sub_points.h"

namespace stilb::estimators {
namespace {

/// Light paths of a pass, and the number of them for one selected path's vertices in a packet. The more paths
/// are traced, the more evenly the selected vertices lie; tracing costs less than a hundredth of a large
/// picture's pass.
constexpr std::uint64_t kPathsPerPass = 4096;
constexpr std::uint64_t kPathsPerSelected = 256;
/// The k of diffuse receivers, over that of a plan: plans expect vertices by their flux, but those near a
/// receiver are chosen, so that connections cost less variance (docs/performance.md).
constexpr double kDiffuseFactor = 8;
/// Planning rays from each sub-point.
constexpr unsigned kPilotRays = 4;

class LightPathPicture final : public LocalPicture {
  public:
    LightPathPicture(const LocalTransport& transport, const Problem& problem)
        : transport_(transport),
          sub_points_(transport, problem, 1),
          plan_{problem.preparation_key.derived(kPlan), 0},
          area_m2_(surface_area_m2(transport.scene)),
          k_per_m2_(sub_points_.cells()) {
        if (transport.split != Split::none)
            pilot_nodes_ =
                transport.trace_light_paths(problem.preparation_key.derived(kPilot), 0, kPilotPaths);
    }

    std::unique_ptr<const PicturePass> start(const Pass& pass) const override {
        return std::make_unique<LightPathPass>(*this, pass);
    }

  private:
    enum Purpose : std::uint64_t { kWalks = kPixels + 1, kPackets, kSelection, kGather, kPilot, kPlan };

    class LightPathPass final : public PicturePass {
      public:
        LightPathPass(const LightPathPicture& picture, const Pass& pass)
            : picture_(picture),
              pass_(pass),
              pool_(picture.transport_.trace_light_paths(pass.key.derived(kWalks), pass.index * kPathsPerPass,
                                                         (pass.index + 1) * kPathsPerPass),
                    picture.transport_.caster.center()) {}

        std::uint64_t sample(const PixelBlock& block, std::span<Rgb> pixels) const override {
            ReadingSums sums(pixels.size());
            const std::vector<SubPointPacket> packets = picture_.sub_points_.of_block(block, pass_, sums);
            const double k_per_m2 =
                picture_.k_per_m2_of(picture_.sub_points_.cell_of({block.left, block.top}));
            choose_near(
                pool_, packets, k_per_m2, [&](const SubPointPacket& packet, const KernelChoice::Sums& near) {
                    picture_.receive(packet, pool_, near, {packet.key(pass_, kPackets), pass_.index}, sums);
                });
            std::copy(sums.sum.begin(), sums.sum.end(), pixels.begin());
            return sums.invalid;
        }

      private:
        const LightPathPicture& picture_;
        Pass pass_;
        NearNodePool pool_;
    };

    /// Adds a sample of a packet's indirect light.
    void receive(const SubPointPacket& packet, const NearNodePool& pool, const KernelChoice::Sums& near,
                 const Pass& own, ReadingSums& sums) const {
        std::vector<double> k_per_m2;
        for (std::size_t i = 0; i < packet.pixels.size(); ++i) {
            const double factor = packet.receivers[i].constant_response() ? kDiffuseFactor : 1;
            k_per_m2.push_back(factor * k_per_m2_of(sub_points_.cell_of(packet.pixels[i])));
        }
        const std::vector<PointTile> tiles =
            tiles_of(packet.receivers, k_per_m2, transport_.caster, transport_.max_reflections);
        const double u = math::SampleStream(own.key.derived(kSelection), own.index).next();
        std::vector<transport::LightVertex> nodes = pool.select(near, near.size() / kPathsPerSelected + 1, u);
        for (transport::LightVertex& vertex : nodes) vertex.flux_lm *= 1.0 / kPathsPerPass;
        Connections(transport_.caster, tiles, transport_.monitor).collect(nodes, sums);
        if (!transport_.gathers) return;
        const std::vector<SplitPlan> plans(packet.receivers.size(), {0, 1});
        Gather(transport_.caster, transport_.tracer, tiles, plans)
            .collect({own.key.derived(kGather), own.index, 1}, sums);
    }

    double k_per_m2_of(std::size_t cell) const {
        return k_per_m2_.of(cell, [&] {
            const std::vector<transport::Receiver> receivers = sub_points_.of_cell(cell, plan_);
            if (transport_.split == Split::none || receivers.empty())
                return std::numeric_limits<double>::infinity();
            const PilotLight pilot{pilot_nodes_,     kPilotPaths, {}, area_m2_, transport_.max_reflections,
                                   kPathsPerSelected};
            return plan_constant(transport_.caster, transport_.tracer, receivers, pilot,
                                 kPathsPerPass / kPathsPerSelected, kPilotRays, plan_.key.derived(cell));
        });
    }

    const LocalTransport& transport_;
    SubPoints sub_points_;
    Pass plan_;  ///< its sub-points represent the cells'
    double area_m2_;
    std::vector<transport::LightVertex> pilot_nodes_;
    OfCells<double> k_per_m2_;
};

}  // namespace

std::unique_ptr<const LocalPicture> make_local_picture(const LocalTransport& transport,
                                                       const Problem& problem) {
    return std::make_unique<LightPathPicture>(transport, problem);
}

}  // namespace stilb::estimators
