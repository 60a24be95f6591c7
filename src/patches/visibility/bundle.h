// Bundles of parallel rays: all surfaces along each of many parallel lines at once (theory:
// [FirstShot section 5]; the lines of a random direction are "global lines").
//
// The rays of a bundle stand on a square grid across its direction, so each counts for a cross-section of
// spacing^2 (in large scenes on several grids). Where the grid's offset is uniform over a square of the grid,
// sums over lines are unbiased: a patch is crossed by |n . w| A / spacing^2 lines on average. With the
// direction uniform over the sphere too, the mean cross-section of the lines that lead from side i straight
// to side j is A_i F_ij / 4, F_ij being the form factor: of all directions' 4 pi it is the share that pi A_i
// F_ij takes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "base/vec.h"
#include "patches/patches.h"
#include "patches/visibility/buffer_options.h"
#include "patches/visibility/line_cells.h"
#include "patches/visibility/patch_caster.h"

namespace stilb::patches {

// Rays that go through the edge between two patches meet both of them, though they cross one surface.

/// Merges crossings of one surface at an edge between patches: where the next crossing has the same
/// orientation (both fronts or both backs) and lies no farther behind than 2^-19 of the largest coordinate,
/// measured across the patch. Otherwise the two patches would see each other, one from its wrong side.
/// Thicker bodies keep both sides, and so do all closed bodies, however thin, because their two sides have
/// different orientations.
class CoincidentCrossings {
  public:
    /// For rays along a unit vector. Keeps a reference to the patches.
    CoincidentCrossings(const Patches& patches, const Vec3& direction)
        : patches_(patches), direction_(direction) {}
    /// `crossings` are in the order of distances. `half_extent_m` is the largest coordinate of all patches.
    void remove_from(std::vector<Crossing>& crossings, double half_extent_m) const;
    /// The same for a ray from `origin`, relative to Patches::center: its own coordinates count.
    void remove_from(std::vector<Crossing>& crossings, const Vec3& origin) const;

  private:
    bool is_same(const Crossing& before, const Crossing& after, double coordinate_m) const;

    const Patches& patches_;
    Vec3 direction_;
};

struct Bundle {
    Frame frame;           ///< w: direction of the rays; u and v: the axes of the grid
    double spacing_m = 0;  ///< of neighbouring rays; in scenes of more than 64 m the patches decide on it
    std::array<double, 2> offset{};  ///< of the grid along u and v, in spacings; in [0, 1)
};

/// The crossings of one line of a bundle. Neighbours in `sides` see each other: side other_side(sides[i])
/// of patch i faces along the line, and sees sides[i + 1].
struct CrossedLine {
    Vec3 origin;                           ///< world; before all patches
    std::span<const std::uint32_t> sides;  ///< crossed sides in the order along w
    std::span<const float> distances_m;    ///< from the origin
};

/// Lines of a bundle; lines without crossings are left out.
class CrossedLines {
  public:
    /// The cross-section that each line stands for.
    double line_area_m2() const { return line_area_m2_; }
    std::size_t count() const { return origins_.size(); }
    CrossedLine line(std::size_t i) const {
        const std::size_t first = first_crossing_[i], n = first_crossing_[i + 1] - first;
        return {origins_[i], std::span(sides_).subspan(first, n), std::span(distances_m_).subspan(first, n)};
    }

    /// Forgets all lines; those to come stand for another cross-section each.
    void start(double line_area_m2);
    /// Adds a line, unless it crosses nothing.
    void add(const Vec3& origin, std::span<const Crossing> crossings);

  private:
    double line_area_m2_ = 0;
    std::vector<Vec3> origins_;
    std::vector<std::size_t> first_crossing_{0};  ///< per line, and the number of crossings at the end
    std::vector<std::uint32_t> sides_;
    std::vector<float> distances_m_;
};

/// Calls `visit(sender, receiver)` for all pairs of sides that see each other along the lines: the sender
/// faces along w, the receiver against it.
template <typename Visitor>
void for_each_pair(const Patches& patches, const CrossedLines& lines, const Visitor& visit) {
    for (std::size_t i = 0; i < lines.count(); ++i) {
        const std::span<const std::uint32_t> sides = lines.line(i).sides;
        for (std::size_t k = 1; k < sides.size(); ++k) visit(patches.other_side(sides[k - 1]), sides[k]);
    }
}

/// Called for one block of lines after another; their data are valid during the call.
using LineVisitor = std::function<void(const CrossedLines&)>;

/// The interface of bundle backends. They agree except for lines that meet a boundary between patches.
class Bundles {
  public:
    Bundles() = default;
    Bundles(const Bundles&) = delete;
    Bundles& operator=(const Bundles&) = delete;
    virtual ~Bundles() = default;

    /// Passes all lines with crossings to `visit`, each once, on the calling thread. Throws InputError
    /// where the spacing is not above 0, or so small that there would be more than kMostLines along an edge
    /// of a uniform grid.
    virtual void cast(const Bundle& bundle, const LineVisitor& visit) const = 0;
};

/// By rays or by OpenGL. Keeps a reference to the caster or its patches. Throws InputError where OpenGL is
/// requested but missing.
std::unique_ptr<Bundles> make_bundles(BufferBackend backend, const PatchCaster& caster);

inline constexpr int kMostLines = 65'536;

/// The lines of a uniform grid: enough to cover the projection of the patches' bounding box. Line
/// (x, y) begins at `first` + x `step_x` + y `step_y`.
struct LineGrid {
    Vec3 first, step_x, step_y;  ///< relative to Patches::center
    int width = 0, height = 0;
    double line_area_m2 = 0;  ///< the cross-section that each line stands for
    double depth_m = 0;       ///< of the bounding box: all patches are nearer

    /// Throws as Bundles::cast.
    LineGrid(const Bounds& bounds, const Bundle& bundle);
    /// Those of one cell.
    LineGrid(const LineCell& cell, const Bundle& bundle);
    Vec3 origin(int x, int y) const { return first + x * step_x + y * step_y; }
};

// Bundles by rays.

/// Casts may run in parallel, each on its thread. Keeps a reference to the caster.
///
/// Most scenes have a uniform grid. In scenes of more than 64 m, and of little area for their size, it would
/// have any number of lines between things that lie far apart, and small patches beside large ones would meet
/// none: there the plane across the lines is divided into cells as the patches are (line_cells.h), each with
/// a grid as fine as its patches need.
class RayBundles : public Bundles {
  public:
    explicit RayBundles(const PatchCaster& caster);

    void cast(const Bundle& bundle, const LineVisitor& visit) const override;

  private:
    void cast_uniform(const Bundle& bundle, const LineVisitor& visit) const;
    void cast_cells(const Bundle& bundle, const LineVisitor& visit) const;

    const PatchCaster& caster_;
    Bounds bounds_;
    bool has_cells_;
};

}  // namespace stilb::patches
