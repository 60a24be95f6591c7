// A directional albedo as a function of the cosine: tabulated, interpolated, integrated and sampled.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>

#include "base/vec.h"

namespace stilb::materials {

/// Piecewise linear in log(1 + cosine / alpha), which resolves cosines near alpha, where facets shadow
/// each other, as well for alpha = 0.001 as for 1.
class AlbedoTable {
  public:
    /// Tabulates a non-negative function of the cosine in [0, 1].
    AlbedoTable(double alpha, const std::function<double(double)>& albedo);

    double at(double cosine) const;
    /// Integral of at(c) 2 c dc: the albedo under uniform illumination.
    double average() const { return average_; }
    /// Of the cosines alpha (exp(i / cells_per_log()) - 1), from 0 to 1.
    std::span<const double> values() const { return values_; }
    double cells_per_log() const { return cells_per_log_; }

    /// Samples a direction by its cosine, with a density near at(c) c / (pi average()).
    Vec3 sample(double u1, double u2) const;
    /// The density of sample(); 0 where the average is 0.
    double pdf_per_sr(double cosine) const { return pdf_of_cosine(cosine) / (2 * kPi); }

  private:
    double sample_cosine(double u) const;
    /// The density of sample_cosine(), per unit of the cosine.
    double pdf_of_cosine(double cosine) const;
    static constexpr std::size_t kCells = 128;
    struct CellPosition {
        std::size_t cell = 0;
        double fraction = 0;
    };
    CellPosition position_of(double cosine) const;
    double cosine_at(double position) const;

    double alpha_;
    double cells_per_log_;
    std::array<double, kCells + 1> values_{};      ///< at the edges of cells
    std::array<double, kCells + 1> cumulative_{};  ///< chance of the cells below each edge; or all 0
    double average_ = 0;
};

/// Keeps the table that was made last: many materials in succession, the colours of a texture, differ in
/// their colours alone, on which tables do not depend. Tabulating takes some 20 ms.
class LastAlbedoTable {
  public:
    /// The table of a function of the parameters `of`, of which alpha is the first.
    const AlbedoTable& get(const std::array<double, 2>& of, const std::function<double(double)>& albedo) {
        if (!table_ || of_ != of) {
            table_.emplace(of[0], albedo);
            of_ = of;
        }
        return *table_;
    }

  private:
    std::array<double, 2> of_{};
    std::optional<AlbedoTable> table_;
};

}  // namespace stilb::materials
