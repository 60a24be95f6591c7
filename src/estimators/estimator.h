// Estimation of readings and pictures. An estimator is constructed for a problem, and handles no files,
// progress or stopping: it adds batches of samples to sums of readings, and passes to pictures; a run
// turns them into values with intervals. Only its construction may use several threads.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/monitor.h"
#include "base/rgb.h"
#include "estimators/patch_light/patch_options.h"
#include "estimators/streams.h"
#include "estimators/tally.h"
#include "math/random.h"
#include "rays/ray_caster.h"
#include "sensors/sensor.h"
#include "transport/light_parts.h"

namespace stilb::estimators {

/// The problem of an estimator: readings of the measurands, a picture of the camera, or both. The
/// estimator keeps references to scene, caster and monitor, and copies the rest.
struct Problem {
    const Scene& scene;
    const rays::RayCaster& caster;
    int max_reflections;
    /// For decisions before sampling starts; independent of the keys of batches and passes. The same for all
    /// seeds of a run: a technique that is given back then decides as `auto` did that chose it.
    math::KeyOf<PreparationStream> preparation_key{{0x5ee0f7e57a11ed00}};
    std::span<const Measurand> measurands = {};
    /// The weight of each measurand's relative variance. Empty: all equal.
    std::span<const double> weights = {};
    /// The number of the sensor of each measurand, for errors relative to their means. Empty: all are one's.
    std::span<const std::uint32_t> sensors = {};
    /// Each measurand is one of so many: plans and costs are those of all of them.
    double stands_for = 1;
    /// The relative half-width of the intervals that are wanted, for choices by work: 1 % where a run asks
    /// for none.
    double error = 0.01;
    std::optional<Camera> camera = {};
    /// Options of methods on patches, and of first shot.
    PatchOptions patches = {};
    /// The channels that light is divided into (Tally::parts); null for none. Methods on patches, and `path`
    /// with first shot, do not divide their light.
    const transport::Channels* channels = nullptr;
    /// Monitors the set-up.
    const Monitor& monitor = Monitor::none();
};

/// A block of the picture, the unit of parallel work.
struct PixelBlock {
    int left = 0, top = 0, width = 0, height = 0;

    std::size_t pixels() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
};

/// Edge of the largest blocks.
inline constexpr int kBlockSize = 16;
/// Methods compute a block in packets of so many pixels to a side, from its top left corner.
inline constexpr int kPacketSide = 4;

/// The blocks of a picture, row by row, with `edge` pixels to a side; the first one extends to `offset` (each
/// from 1 to `edge`).
std::vector<PixelBlock> blocks_of(const std::array<int, 2>& resolution,
                                  const std::array<int, 2>& offset = {kBlockSize, kBlockSize},
                                  int edge = kBlockSize);

/// The unit of work for pictures: sample `index` of the replicate that `key` identifies. A pass over
/// a block depends on these and the block alone.
struct Pass {
    math::KeyOf<PassStream> key;
    std::uint64_t index = 0;
    std::uint64_t replicate = 0;  ///< its number, for light that was computed before
};

/// A pass with the data that its blocks share.
class PicturePass {
  public:
    virtual ~PicturePass() = default;

    /// Adds one unbiased sample of the luminance [cd/m2] of every pixel of a block: its pixels, row by row,
    /// are the readings of the sums. Blocks may run in parallel.
    virtual void sample(const PixelBlock& block, Tally& sums) const = 0;
};

class Estimator {
  public:
    virtual ~Estimator() = default;

    /// The name in estimator_list() that makes the same estimator of the same problem: that of the method, or
    /// of the technique that it has chosen.
    virtual std::string_view technique() const = 0;

    /// Adds a batch of the problem's measurands. Batches may run in parallel on different sums. Throws
    /// Cancelled, with unfinished sums, soon after the monitor ends the run.
    virtual void run_batch(const Batch& batch, Tally& sums) const = 0;
    /// The part of each reading that is computed without sampling [lx or cd/m2].
    virtual std::span<const Rgb> known_part() const = 0;
    /// The same for each channel: channels x readings. Empty where the problem has none, or the method does
    /// not divide its light.
    virtual std::span<const Rgb> known_parts() const { return {}; }
    /// The end of the line of sight of each luminance reading; nothing where it leaves the scene, and nothing
    /// for illuminances.
    virtual std::span<const std::optional<Vec3>> sight_ends() const = 0;
    /// The largest single contribution to each reading that the set-up has met, as Tally::largest: a
    /// short run may not meet such a one, and must allow for it. Empty where the set-up takes no samples.
    virtual std::vector<double> expected_largest() const { return {}; }
    /// Whether what this place reflects of the lamps' light is found only by those rays, one in each sample
    /// of a reading, that happen to meet it.
    virtual bool is_met_by_chance(const rays::Hit& /*place*/) const { return false; }
    /// The packet of each reading. Empty where the method has no packets with paces of their own.
    virtual std::vector<std::uint32_t> packets() const { return {}; }
    /// The number of samples of a batch is a multiple of this.
    virtual std::uint64_t batch_granularity() const = 0;
    /// The number of samples of a replicate before the first error estimate: one from fewer may be far too
    /// small.
    virtual std::uint64_t first_check() const { return 4 * batch_granularity(); }
    /// The approximate number of rays of one sample, over all readings: it determines the length of batches.
    virtual double rays_per_sample() const = 0;
    /// The approximate processor time of one sample, in units of a scattered ray's: rays of packets take
    /// less.
    virtual double cost_per_sample() const { return rays_per_sample(); }

    /// A pass over the picture of the problem's camera. Keeps a reference to the estimator.
    virtual std::unique_ptr<const PicturePass> start(const Pass& pass) const = 0;

    /// Light that the method cannot compute in this scene, as sentences for the user; empty if there is none.
    virtual std::vector<std::string> warnings() const = 0;
    /// The report on patches, for methods that use them.
    virtual std::optional<PatchReport> patch_report() const { return std::nullopt; }
};

}  // namespace stilb::estimators
