#include "lights/photometric_solid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "stilb/error.h"

namespace stilb::lights {
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180;
/// The tolerance by which rounding may move a direction out of the grid.
constexpr double kBorderRad = 1e-10;

/// The frame of the two angles; orthonormal, left-handed for type A, whose planes turn the other way.
Frame axes_of(PhotometryType type) {
    const Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
    switch (type) {
        case PhotometryType::A:
            return {x, -y, z};
        case PhotometryType::B:
            return {z, x, y};
        case PhotometryType::C:
            break;
    }
    return {x, y, z};
}

/// The value of polar_deg at the pole that polar angles start from.
double pole_deg(PhotometryType type) { return type == PhotometryType::C ? 0 : -90; }

void check_angles(const std::vector<double>& angles, const char* what, double least, double greatest) {
    for (std::size_t i = 0; i < angles.size(); ++i) {
        if (!(angles[i] >= least && angles[i] <= greatest)) {
            throw InputError(fmt::format("{} {} is outside its range of {} to {} degrees", what, angles[i],
                                         least, greatest));
        }
        if (i > 0 && angles[i] - angles[i - 1] < PhotometricSolid::kSmallestStepDeg) {
            throw InputError(
                fmt::format("{} {} follows {}: angles must increase", what, angles[i], angles[i - 1]));
        }
    }
}

void check_planes(const PhotometricSolid::Grid& grid) {
    if (grid.type != PhotometryType::C) {
        if (grid.planes_deg.size() < 2)
            throw InputError("the grid has fewer than two planes, but type A or B needs at least two");
        check_angles(grid.planes_deg, "plane angle", -180, 180);
        return;
    }
    if (grid.planes_deg.empty()) throw InputError("the grid has no plane, but type C needs at least one");
    check_angles(grid.planes_deg, "C angle", -360, 720);
    const double turn = grid.planes_deg.back() - grid.planes_deg.front();
    if (grid.planes_deg.size() > 1 && std::abs(turn - 360) > PhotometricSolid::kSmallestStepDeg) {
        throw InputError(fmt::format(
            "the C planes span {} degrees: they must cover a full turn, or be a single plane", turn));
    }
}

void check(const PhotometricSolid::Grid& grid) {
    check_planes(grid);
    if (grid.polar_deg.size() < 2) throw InputError("each plane needs intensities at two angles or more");
    const double pole = pole_deg(grid.type);
    check_angles(grid.polar_deg, "polar angle", pole, pole + 180);
    if (grid.intensity_cd.size() != grid.planes_deg.size() * grid.polar_deg.size()) {
        throw InputError(fmt::format("{} intensities for {} planes of {} angles", grid.intensity_cd.size(),
                                     grid.planes_deg.size(), grid.polar_deg.size()));
    }
    for (const double intensity : grid.intensity_cd) {
        if (!(intensity >= 0) || !std::isfinite(intensity)) {
            throw InputError(
                fmt::format("intensity {} cd: intensities must be finite and not negative", intensity));
        }
    }
}

/// sin h - h cos h without cancellation.
double sine_minus_chord(double h, double sine, double cosine) {
    if (std::abs(h) > 0.2) return sine - h * cosine;
    const double q = h * h;
    return h * q * (1. / 3 - q * (1. / 30 - q * (1. / 840 - q * (1. / 45360 - q / 3991680))));
}

/// Integrals over an interval of the polar angle: of sin, and of (angle - start) sin; and sin at its end.
struct SineMoments {
    double zeroth, first, sine_at_end;
};
SineMoments sine_moments(double start, double width) {
    const double half = width / 2, middle = start + half;
    const double sine_half = std::sin(half), cosine_half = std::cos(half);
    const double sine = std::sin(middle), cosine = std::cos(middle);
    const double half_zeroth = sine * sine_half;
    return {2 * half_zeroth,
            width * half_zeroth + 2 * cosine * sine_minus_chord(half, sine_half, cosine_half),
            sine * cosine_half + cosine * sine_half};
}

/// The interval of increasing `bounds` that holds `value`, which lies between the first and the last.
std::size_t interval_of(std::span<const double> bounds, double value) {
    const auto above = std::upper_bound(bounds.begin() + 1, bounds.end() - 1, value);
    return static_cast<std::size_t>(above - bounds.begin()) - 1;
}

/// A share inside (0, 1) by more than rounding, because a sample on the edge of a cell could have zero
/// density.
double inner_share(double share) {
    constexpr double kMargin = 0x1p-44;
    return std::clamp(share, kMargin, 1 - kMargin);
}

/// The point on [0, 1] below which a linear density from a to b has the given share of its mass.
double invert_linear(double a, double b, double share) {
    const double denominator = a + std::sqrt((1 - share) * a * a + share * b * b);
    return denominator > 0 ? std::min(share * (a + b) / denominator, 1.0) : share;
}

/// The density (at_start + slope x) sin(start + x) on [0, width].
struct PolarDensity {
    double start, width, at_start, slope;

    struct Value {
        double density, mass_below;
    };
    Value at(double x) const {
        const SineMoments moments = sine_moments(start, x);
        return {std::max((at_start + slope * x) * moments.sine_at_end, 0.0),
                at_start * moments.zeroth + slope * moments.first};
    }
};

/// The point below which the given share of the mass lies: Newton's iteration within a shrinking bracket.
double invert_polar(const PolarDensity& polar, double share) {
    constexpr int kMostIterations = 60;
    const PolarDensity::Value end = polar.at(polar.width);
    const double target = share * end.mass_below;
    // Cells are narrow as a rule, and there sin is almost linear.
    double x = polar.width * invert_linear(polar.at_start * std::sin(polar.start), end.density, share);
    double low = 0, high = polar.width;
    for (int i = 0; i < kMostIterations; ++i) {
        const PolarDensity::Value value = polar.at(x);
        const double excess = value.mass_below - target;
        (excess > 0 ? high : low) = x;
        const double newton = x - excess / value.density;
        const bool inside = newton > low && newton < high;
        // Newton squares the relative error: after a step as small as this, x is exact.
        if (inside && std::abs(newton - x) <= 1e-8 * std::min(x, polar.width - x)) return newton;
        x = inside ? newton : (low + high) / 2;
    }
    return x;
}

}  // namespace

PhotometricSolid::PhotometricSolid(const Grid& grid) : axes_(axes_of(grid.type)) {
    check(grid);
    peak_cd_ = *std::max_element(grid.intensity_cd.begin(), grid.intensity_cd.end());
    if (!(peak_cd_ > 0)) throw InputError("all intensities are 0: there is no light to distribute");

    for (const double angle : grid.planes_deg) planes_.push_back(angle * kRadiansPerDegree);
    for (const double angle : grid.polar_deg) {
        polar_.push_back((angle - pole_deg(grid.type)) * kRadiansPerDegree);
    }
    for (const double intensity : grid.intensity_cd) relative_intensity_.push_back(intensity / peak_cd_);
    if (planes_.size() == 1) {
        planes_ = {0, 2 * std::numbers::pi};
        const std::vector<double> only_plane = relative_intensity_;
        relative_intensity_.insert(relative_intensity_.end(), only_plane.begin(), only_plane.end());
    }
    add_up_flux();
    find_bounds();
}

void PhotometricSolid::add_up_flux() {
    flux_below_.assign(relative_intensity_.size(), 0);
    for (std::size_t ring = 0; ring + 1 < polar_.size(); ++ring) {
        const double width = polar_[ring + 1] - polar_[ring];
        const SineMoments moments = sine_moments(polar_[ring], width);
        const double weight_of_next = moments.first / width;
        const double weight_of_this = moments.zeroth - weight_of_next;
        for (std::size_t plane = 0; plane < planes_.size(); ++plane) {
            const std::size_t at = plane * polar_.size() + ring;
            flux_below_[at + 1] = flux_below_[at] + weight_of_this * relative_intensity_[at] +
                                  weight_of_next * relative_intensity_[at + 1];
        }
    }
    flux_before_.assign(planes_.size(), 0);
    for (std::size_t plane = 0; plane + 1 < planes_.size(); ++plane) {
        const double here = flux_below_[(plane + 1) * polar_.size() - 1];
        const double next = flux_below_[(plane + 2) * polar_.size() - 1];
        flux_before_[plane + 1] =
            flux_before_[plane] + (planes_[plane + 1] - planes_[plane]) * (here + next) / 2;
    }
    flux_lm_ = peak_cd_ * flux_before_.back();
    if (!std::isfinite(flux_lm_) || !(flux_lm_ > 0)) {
        throw InputError(
            fmt::format("the flux of the distribution is {} lm: intensities are out of range", flux_lm_));
    }
}

double PhotometricSolid::flux_to_horizon(std::size_t plane) const {
    constexpr double equator = std::numbers::pi / 2;
    const double* flux = &flux_below_[plane * polar_.size()];
    if (has_horizontal_pole() || polar_.back() < equator + kBorderRad) return flux[polar_.size() - 1];
    if (polar_.front() > equator - kBorderRad) return 0;
    const std::size_t ring = interval_of(polar_, equator);
    const double width = polar_[ring + 1] - polar_[ring], at_start = relative(plane, ring);
    const PolarDensity density{polar_[ring], width, at_start, (relative(plane, ring + 1) - at_start) / width};
    return flux[ring] + density.at(equator - polar_[ring]).mass_below;
}

double PhotometricSolid::share_below() const {
    constexpr double horizon = std::numbers::pi / 2;
    double below = 0;
    for (std::size_t plane = 0; plane + 1 < planes_.size(); ++plane) {
        const double start = planes_[plane], end = planes_[plane + 1];
        const double first = has_horizontal_pole() ? std::clamp(-horizon, start, end) : start;
        const double last = has_horizontal_pole() ? std::clamp(horizon, start, end) : end;
        const auto flux_at = [&](double angle) {
            return std::lerp(flux_to_horizon(plane), flux_to_horizon(plane + 1),
                             (angle - start) / (end - start));
        };
        below += (last - first) * (flux_at(first) + flux_at(last)) / 2;
    }
    return below / flux_before_.back();
}

void PhotometricSolid::find_bounds() {
    // Wider than the step, so that rounding of a direction never leads out of it.
    constexpr double step = 2.0 / kBounds, margin = step / 64;
    for (std::size_t i = 0; i < kBounds; ++i) {
        const double low = -1 + step * static_cast<double>(i);
        const double first = std::acos(std::min(low + step + margin, 1.0));
        const double last = std::acos(std::max(low - margin, -1.0));
        // Intensities are linear between rings: those about the step hold the largest.
        for (std::size_t ring = 0; ring + 1 < polar_.size(); ++ring) {
            if (polar_[ring] > last || polar_[ring + 1] < first) continue;
            for (std::size_t plane = 0; plane < planes_.size(); ++plane) {
                const double largest = std::max(relative(plane, ring), relative(plane, ring + 1));
                bound_cd_[i] = std::max(bound_cd_[i], peak_cd_ * largest);
            }
        }
    }
}

double PhotometricSolid::intensity_bound_cd(const Vec3& direction) const {
    const double cos_polar = dot(direction, axes_.w);
    const double step = (cos_polar + 1) * (kBounds / 2.0);
    return bound_cd_[std::min(static_cast<std::size_t>(std::max(step, 0.0)), kBounds - 1)];
}

double PhotometricSolid::intensity_cd(const Vec3& direction) const {
    const Vec3 local = axes_.to_local(direction);
    const double polar = std::atan2(std::sqrt(local.x * local.x + local.y * local.y), local.z);
    if (polar < polar_.front() - kBorderRad || polar > polar_.back() + kBorderRad) return 0;

    const double turn = 2 * std::numbers::pi;
    double plane_angle = std::atan2(local.y, local.x);
    const double border = planes_.back() - planes_.front() < turn - kBorderRad ? kBorderRad : 0;
    plane_angle -= turn * std::floor((plane_angle - planes_.front() + border) / turn);
    if (border > 0 && plane_angle > planes_.back() + border) return 0;

    const std::size_t plane = interval_of(planes_, plane_angle);
    const std::size_t ring = interval_of(polar_, polar);
    const double s =
        std::clamp((plane_angle - planes_[plane]) / (planes_[plane + 1] - planes_[plane]), 0.0, 1.0);
    const double t = std::clamp((polar - polar_[ring]) / (polar_[ring + 1] - polar_[ring]), 0.0, 1.0);
    const double here = std::lerp(relative(plane, ring), relative(plane, ring + 1), t);
    const double next = std::lerp(relative(plane + 1, ring), relative(plane + 1, ring + 1), t);
    return peak_cd_ * std::lerp(here, next, s);
}

Vec3 PhotometricSolid::sample_direction(double u1, double u2) const {
    // The slice between two planes: its flux is linear in the plane angle.
    const std::size_t rings = polar_.size();
    const auto below = [](double share, double sum) {
        return std::min(share * sum, std::nextafter(sum, 0.0));
    };
    const double flux = below(u1, flux_before_.back());
    const std::size_t plane = interval_of(flux_before_, flux);
    const double* flux_here = &flux_below_[plane * rings];
    const double* flux_next = flux_here + rings;
    const double slice_share =
        inner_share((flux - flux_before_[plane]) / (flux_before_[plane + 1] - flux_before_[plane]));
    const double s = invert_linear(flux_here[rings - 1], flux_next[rings - 1], slice_share);

    // At that plane angle, the ring: the running sums interpolate as the intensities do.
    const auto flux_below = [&](std::size_t ring) { return (1 - s) * flux_here[ring] + s * flux_next[ring]; };
    const double target = below(u2, flux_below(rings - 1));
    std::size_t ring = 0, end = rings - 1;
    while (end - ring > 1) {
        const std::size_t middle = (ring + end) / 2;
        (flux_below(middle) <= target ? ring : end) = middle;
    }
    const double ring_share =
        inner_share((target - flux_below(ring)) / (flux_below(ring + 1) - flux_below(ring)));
    const double width = polar_[ring + 1] - polar_[ring];
    const double at_start = (1 - s) * relative(plane, ring) + s * relative(plane + 1, ring);
    const double at_end = (1 - s) * relative(plane, ring + 1) + s * relative(plane + 1, ring + 1);
    const PolarDensity density{polar_[ring], width, at_start, (at_end - at_start) / width};
    const double polar = polar_[ring] + invert_polar(density, ring_share);

    const double plane_angle = std::lerp(planes_[plane], planes_[plane + 1], s);
    const double equator = std::sin(polar);
    return axes_.to_world(
        {equator * std::cos(plane_angle), equator * std::sin(plane_angle), std::cos(polar)});
}

}  // namespace stilb::lights
