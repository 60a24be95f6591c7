#include "exact/sobolev.h"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/special_functions/bessel.hpp>
#include <cmath>
#include <numbers>

#include "exact/domain.h"

namespace stilb::exact {
namespace {

constexpr Plane other(Plane plane) { return plane == Plane::first ? Plane::second : Plane::first; }

// Plain double precision suffices inside the Bessel functions; long double makes them several times slower.
using DoublePrecision = boost::math::policies::policy<boost::math::policies::promote_double<false>>;

/// The planes as one of them sees them, in units of their separation and for an intensity of 1 cd.
struct View {
    double own_reflectance, other_reflectance;
    double own_distance, other_distance;
};

View view_from(Plane plane, const ParallelPlanes& planes) {
    const double separation = planes.distance_1_m + planes.distance_2_m;
    const View first{planes.reflectance_1, planes.reflectance_2, planes.distance_1_m / separation,
                     planes.distance_2_m / separation};
    if (plane == Plane::first) return first;
    return {first.other_reflectance, first.own_reflectance, first.other_distance, first.own_distance};
}

/// The Hankel transform of the indirect illuminance times the wave number, without J0.
double indirect_spectrum(const View& view, double wave_number) {
    const double flight = wave_number * boost::math::cyl_bessel_k(1, wave_number, DoublePrecision());
    const double round_trip = view.own_reflectance * view.other_reflectance * flight * flight;
    const double sources = std::exp(-view.other_distance * wave_number) +
                           view.own_reflectance * flight * std::exp(-view.own_distance * wave_number);
    return view.other_reflectance * flight * sources / (1 - round_trip) * wave_number;
}

/// The integral of indirect_spectrum(k) J0(k radius) over all k. Panels of Gauss points, each shorter than
/// half a period of J0 and, because of the logarithm at k = 0, no longer than its own distance from 0. No
/// acceleration of the alternating series is needed since the spectrum falls off as exp(-k).
double indirect_illuminance(const View& view, double radius) {
    constexpr double kEnd = 60;  // exp(-60) = 1e-26
    const double longest = std::min(1.0, std::numbers::pi / radius);
    const auto integrand = [&](double wave_number) {
        return indirect_spectrum(view, wave_number) *
               boost::math::cyl_bessel_j(0, wave_number * radius, DoublePrecision());
    };
    using Rule = boost::math::quadrature::gauss<double, 20>;
    double from = 1e-12;
    double sum = Rule::integrate(integrand, 0.0, from);
    while (from < kEnd) {
        const double to = from + std::min(from, longest);
        sum += Rule::integrate(integrand, from, to);
        from = to;
    }
    return sum;
}

/// A bound of the probability that this many diffuse flights between the planes lead farther than `distance`
/// from where they start, in units of the separation: one of them has to be longer than its share of the
/// distance.
double share_beyond(double distance, int flights) {
    const double length = distance / flights;
    return flights / (1 + length * length);
}

}  // namespace

SobolevProblem::SobolevProblem(const ParallelPlanes& planes) : planes_(planes) {
    require(planes.reflectance_1 >= 0 && planes.reflectance_1 <= 1 && planes.reflectance_2 >= 0 &&
                planes.reflectance_2 <= 1,
            "Sobolev's problem: a reflectance is not between 0 and 1");
    require(planes.reflectance_1 * planes.reflectance_2 < 1,
            "Sobolev's problem: both reflectances are 1, so that the illuminance is infinite");
    require_positive(planes.distance_1_m, "Sobolev's problem: distance_1_m is not positive and finite");
    require_positive(planes.distance_2_m, "Sobolev's problem: distance_2_m is not positive and finite");
    require_not_negative(planes.intensity_cd, "Sobolev's problem: intensity_cd is negative or not finite");
}

double SobolevProblem::separation_m() const { return planes_.distance_1_m + planes_.distance_2_m; }

double SobolevProblem::direct_illuminance_lx(Plane plane, double radius_m) const {
    require_not_negative(radius_m, "Sobolev's problem: the radius is negative or not finite");
    const double height_m = plane == Plane::first ? planes_.distance_1_m : planes_.distance_2_m;
    const double distance_m = std::hypot(height_m, radius_m);
    return planes_.intensity_cd * (height_m / distance_m) / (distance_m * distance_m);
}

double SobolevProblem::indirect_illuminance_lx(Plane plane, double radius_m) const {
    require_not_negative(radius_m, "Sobolev's problem: the radius is negative or not finite");
    const double radius = radius_m / separation_m();
    require(radius <= kLargestRelativeRadius,
            "Sobolev's problem: the radius is more than 100 times the distance of the planes");
    return planes_.intensity_cd * indirect_illuminance(view_from(plane, planes_), radius) /
           (separation_m() * separation_m());
}

double SobolevProblem::illuminance_lx(Plane plane, double radius_m) const {
    return direct_illuminance_lx(plane, radius_m) + indirect_illuminance_lx(plane, radius_m);
}

double SobolevProblem::truncation_bound_lx(Plane plane, double radius_m, double half_size_m) const {
    require_not_negative(radius_m, "Sobolev's problem: the radius is negative or not finite");
    require(half_size_m > radius_m && std::isfinite(half_size_m),
            "Sobolev's problem: the truncation is not beyond the radius or not finite");
    // Illuminance falls with the radius, so that its value farther in is a bound too.
    const double edge_m = std::min(half_size_m, kLargestRelativeRadius * separation_m());
    const View view = view_from(plane, planes_);
    const double from_other_lx = view.other_reflectance * illuminance_lx(other(plane), edge_m);
    const double from_own_lx = view.other_reflectance * view.own_reflectance * illuminance_lx(plane, edge_m);
    const double round_trip = view.other_reflectance * view.own_reflectance;
    const double margin = (half_size_m - radius_m) / separation_m();

    // An odd number of flights from `plane` ends on the other plane, an even one on the same.
    double bound_lx = 0;
    double earlier_round_trips = 1;
    for (int flights = 1; earlier_round_trips > 0; flights += 2) {
        const double share = share_beyond(margin, flights);
        if (share >= 1)
            return bound_lx + earlier_round_trips * (from_other_lx + from_own_lx) / (1 - round_trip);
        bound_lx += earlier_round_trips *
                    (from_other_lx * share + from_own_lx * std::min(1.0, share_beyond(margin, flights + 1)));
        earlier_round_trips *= round_trip;
    }
    return bound_lx;
}

}  // namespace stilb::exact
