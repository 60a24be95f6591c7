#include "materials/facets/albedo_table.h"

#include <algorithm>
#include <cmath>

namespace stilb::materials {
namespace {

/// Gauss-Legendre on [0, 1].
constexpr std::array<double, 4> kNodes{0.06943184420297371, 0.33000947820757187, 0.6699905217924281,
                                       0.9305681557970263};
constexpr std::array<double, 4> kWeights{0.17392742256872693, 0.32607257743127307, 0.32607257743127307,
                                         0.17392742256872693};

}  // namespace

AlbedoTable::AlbedoTable(double alpha, const std::function<double(double)>& albedo)
    : alpha_(alpha), cells_per_log_(kCells / std::log1p(1 / alpha)) {
    for (std::size_t i = 0; i <= kCells; ++i) {
        values_[i] = albedo(std::min(cosine_at(static_cast<double>(i)), 1.0));
    }
    for (std::size_t i = 0; i < kCells; ++i) {
        const double low = cosine_at(static_cast<double>(i));
        const double width = cosine_at(static_cast<double>(i + 1)) - low;
        double integral = 0;
        for (std::size_t k = 0; k < kNodes.size(); ++k) {
            const double cosine = low + kNodes[k] * width;
            integral += kWeights[k] * width * at(cosine) * 2 * cosine;
        }
        cumulative_[i + 1] = cumulative_[i] + integral;
    }
    average_ = cumulative_.back();
    if (average_ > 0) {
        for (double& sum : cumulative_) sum /= average_;
    }
}

double AlbedoTable::cosine_at(double position) const {
    return alpha_ * std::expm1(position / cells_per_log_);
}

AlbedoTable::CellPosition AlbedoTable::position_of(double cosine) const {
    const double position = std::clamp(std::log1p(cosine / alpha_) * cells_per_log_, 0.0, double{kCells});
    const std::size_t cell = std::min(static_cast<std::size_t>(position), kCells - 1);
    return {cell, position - static_cast<double>(cell)};
}

double AlbedoTable::at(double cosine) const {
    const CellPosition position = position_of(cosine);
    return values_[position.cell] + position.fraction * (values_[position.cell + 1] - values_[position.cell]);
}

Vec3 AlbedoTable::sample(double u1, double u2) const {
    const double cosine = sample_cosine(u1);
    const double sine = std::sqrt((1 - cosine) * (1 + cosine)), phi = 2 * kPi * u2;
    return {sine * std::cos(phi), sine * std::sin(phi), cosine};
}

double AlbedoTable::sample_cosine(double u) const {
    const auto above = std::upper_bound(cumulative_.begin() + 1, cumulative_.end() - 1, u);
    const auto cell = above - cumulative_.begin() - 1;
    const double chance = *above - *(above - 1);
    const double fraction = chance > 0 ? std::clamp((u - *(above - 1)) / chance, 0.0, 1.0) : 0.5;
    const double low = cosine_at(static_cast<double>(cell)), high = cosine_at(static_cast<double>(cell + 1));
    // Uniform in the square of the cosine, as the albedo hardly varies within a cell.
    return std::min(std::sqrt(low * low + fraction * (high * high - low * low)), 1.0);
}

double AlbedoTable::pdf_of_cosine(double cosine) const {
    const std::size_t cell = position_of(cosine).cell;
    const double low = cosine_at(static_cast<double>(cell)), high = cosine_at(static_cast<double>(cell + 1));
    return (cumulative_[cell + 1] - cumulative_[cell]) * 2 * cosine / (high * high - low * low);
}

}  // namespace stilb::materials
