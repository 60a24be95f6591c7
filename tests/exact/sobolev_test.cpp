#include "exact/sobolev.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "exact/quadrature.h"

namespace stilb::exact {
namespace {

using std::numbers::pi;
using test::integrate;

/// The share of the flux of a plane's ring of radius b (per metre of radius) that reaches a square metre at
/// radius a of the other plane, at a separation of 1: the kernel 1 / (pi (1 + d2)^2) integrated around the
/// ring.
double ring_kernel(double a, double b) {
    const double sum = 1 + a * a + b * b;
    const double root = std::sqrt((1 + (a - b) * (a - b)) * (1 + (a + b) * (a + b)));
    return 2 * b * sum / (root * root * root);
}

/// Sobolev's problem with the planes 1 m apart, cut off at `half_size_m`, solved without any transform: the
/// integral equation between the planes by the method of Nystroem and fixed-point iteration.
class PlanesBySuccessiveReflection {
  public:
    PlanesBySuccessiveReflection(const ParallelPlanes& planes, double half_size_m) : planes_(planes) {
        // Near the foot as fine as the source is near, farther out as fine as the kernel is wide.
        for (double from = 0; from < half_size_m;) {
            const double to = std::min(from + std::clamp(from / 2, 0.1, 1.0), half_size_m);
            add_panel(from, to);
            from = to;
        }
        const std::size_t n = radii_.size();
        std::vector<double> kernel(n * n);
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < n; ++j)
                kernel[i * n + j] = weights_[j] * ring_kernel(radii_[i], radii_[j]);

        const auto reflected = [&](const std::vector<double>& from, double reflectance, double distance) {
            std::vector<double> to(n);
            for (std::size_t i = 0; i < n; ++i) {
                double sum = 0;
                for (std::size_t j = 0; j < n; ++j) sum += kernel[i * n + j] * from[j];
                to[i] = direct(radii_[i], distance) + reflectance * sum;
            }
            return to;
        };
        on_1_.assign(n, 0.0);
        double change = 1;
        while (change > 1e-13) {
            on_2_ = reflected(on_1_, planes.reflectance_1, planes.distance_2_m);
            std::vector<double> next = reflected(on_2_, planes.reflectance_2, planes.distance_1_m);
            change = 0;
            for (std::size_t i = 0; i < n; ++i) change = std::max(change, std::abs(next[i] - on_1_[i]));
            on_1_ = std::move(next);
        }
    }

    double illuminance_lx(Plane plane, double radius) const {
        const bool first = plane == Plane::first;
        const std::vector<double>& from = first ? on_2_ : on_1_;
        double sum = 0;
        for (std::size_t j = 0; j < radii_.size(); ++j)
            sum += weights_[j] * ring_kernel(radius, radii_[j]) * from[j];
        return first ? direct(radius, planes_.distance_1_m) + planes_.reflectance_2 * sum
                     : direct(radius, planes_.distance_2_m) + planes_.reflectance_1 * sum;
    }

  private:
    double direct(double radius, double distance) const {
        return planes_.intensity_cd * distance / std::pow(distance * distance + radius * radius, 1.5);
    }

    void add_panel(double from, double to) {
        using Rule = boost::math::quadrature::gauss<double, 8>;
        for (std::size_t i = 0; i < Rule::abscissa().size(); ++i) {
            for (const double x : {-Rule::abscissa()[i], Rule::abscissa()[i]}) {
                radii_.push_back((from + to) / 2 + x * (to - from) / 2);
                weights_.push_back(Rule::weights()[i] * (to - from) / 2);
            }
        }
    }

    ParallelPlanes planes_;
    std::vector<double> radii_, weights_, on_1_, on_2_;
};

const std::vector<ParallelPlanes> kCases{
    {0.5, 0.5, 0.5, 0.5, 1}, {0.8, 0.3, 0.2, 0.8, 1}, {0.9, 0.9, 0.7, 0.3, 25}, {0.1, 0.95, 0.4, 0.6, 1}};

TEST(Sobolev, EqualsTheIntegralEquationSolvedDirectly) {
    for (const ParallelPlanes& planes : kCases) {
        const SobolevProblem exact(planes);
        const PlanesBySuccessiveReflection expected(planes, 150);  // the loss is below 1e-8
        for (int i = 0; i < 20; ++i) {
            const double radius = 5.0 * i / 19;
            for (const Plane plane : {Plane::first, Plane::second})
                EXPECT_NEAR(exact.illuminance_lx(plane, radius) / expected.illuminance_lx(plane, radius), 1,
                            1e-8)
                    << planes.reflectance_1 << ' ' << planes.reflectance_2 << " at " << radius;
        }
    }
}

TEST(Sobolev, EqualsHighPrecisionValues) {
    // The indirect part on plane 1 at h1 + h2 = 1 and I = 1 from (T.6), by mpmath with 25 digits up to a
    // radius of 2 and in 80-bit arithmetic with finer panels beyond it.
    struct Reference {
        double reflectance_1, reflectance_2, distance_1, radius, illuminance, tolerance;
    };
    for (const Reference& reference : std::vector<Reference>{
             {0.5, 0.5, 0.5, 0, 0.528129525817337421, 1e-14},
             {0.5, 0.5, 0.5, 0.5, 0.446076518337203641, 1e-14},
             {0.5, 0.5, 0.5, 2, 0.10943054404970718, 1e-14},
             {0.8, 0.3, 0.2, 0, 0.307303050888444804, 1e-14},
             {0.8, 0.3, 0.2, 0.5, 0.271788453283185244, 1e-14},
             {0.8, 0.3, 0.2, 2, 0.0804480005480847743, 1e-14},
             {0.9, 0.99, 0.7, 0, 2.28221183282161836, 1e-14},
             {0.9, 0.99, 0.7, 0.5, 1.98103222320949093, 1e-14},
             {0.9, 0.99, 0.7, 2, 0.84621148870439541, 1e-14},
             {0.5, 0.5, 0.5, 5, 0.01045189111854001785, 1e-14},
             {0.9, 0.99, 0.7, 20, 0.0083748950250302219, 1e-13},
             {0.5, 0.5, 0.5, 50, 4.695893308569638e-06, 1e-11},
             {0.5, 0.5, 0.5, 100, 5.419231441475743e-07, 1e-9},
         }) {
        const SobolevProblem exact({reference.reflectance_1, reference.reflectance_2, reference.distance_1,
                                    1 - reference.distance_1, 1});
        EXPECT_NEAR(exact.indirect_illuminance_lx(Plane::first, reference.radius) / reference.illuminance, 1,
                    reference.tolerance)
            << reference.reflectance_1 << " at " << reference.radius;
    }
}

TEST(Sobolev, EqualsPublishedValues) {
    // From the design notes, with eight digits, where particle simulation confirms them.
    const SobolevProblem exact({0.5, 0.5, 0.5, 0.5, 1});
    EXPECT_NEAR(exact.illuminance_lx(Plane::first, 0), 4.5281295, 5e-8);
    EXPECT_NEAR(exact.illuminance_lx(Plane::first, 0.5), 1.8602901, 5e-8);
    EXPECT_NEAR(exact.illuminance_lx(Plane::first, 1), 0.6534423, 5e-8);
    EXPECT_NEAR(exact.illuminance_lx(Plane::second, 2), 0.1664977, 5e-8);
    EXPECT_NEAR(exact.illuminance_lx(Plane::second, 3), 0.0621502, 5e-8);
}

TEST(Sobolev, FirstReflectionEqualsItsIntegralOverThePlane) {
    // Without reflection at plane 1 its indirect light is reflected once. Polar coordinates around the
    // receiver.
    const ParallelPlanes planes{0, 0.7, 0.35, 0.65, 3};
    const SobolevProblem exact(planes);
    for (const double radius : {0.0, 0.3, 1.0, 2.5, 5.0}) {
        const auto along_ring = [&](double distance) {
            return integrate(
                [&](double angle) {
                    const double squared =
                        radius * radius + distance * distance + 2 * radius * distance * std::cos(angle);
                    return exact.direct_illuminance_lx(Plane::second, std::sqrt(squared));
                },
                0, 2 * pi);
        };
        // distance = t / (1 - t) reaches to infinity.
        const double sum = integrate(
            [&](double t) {
                const double distance = t / (1 - t);
                const double kernel = 1 / (pi * std::pow(1 + distance * distance, 2));
                return kernel * along_ring(distance) * distance / ((1 - t) * (1 - t));
            },
            0, 1, {radius / (1 + radius)});
        EXPECT_NEAR(exact.indirect_illuminance_lx(Plane::first, radius) / (0.7 * sum), 1, 1e-10) << radius;
        EXPECT_EQ(exact.indirect_illuminance_lx(Plane::second, radius), 0);
    }
}

TEST(Sobolev, ExchangingThePlanesExchangesTheIlluminances) {
    const SobolevProblem one({0.8, 0.3, 0.2, 0.8, 1}), other({0.3, 0.8, 0.8, 0.2, 1});
    for (const double radius : {0.0, 1.0, 7.0})
        EXPECT_DOUBLE_EQ(one.illuminance_lx(Plane::first, radius),
                         other.illuminance_lx(Plane::second, radius));
}

TEST(Sobolev, ScalesWithTheSquareOfLength) {
    const SobolevProblem small({0.8, 0.3, 0.2, 0.8, 1}), large({0.8, 0.3, 0.6, 2.4, 1});
    for (const double radius : {0.0, 1.0, 7.0}) {
        EXPECT_NEAR(small.indirect_illuminance_lx(Plane::first, radius) /
                        (9 * large.indirect_illuminance_lx(Plane::first, 3 * radius)),
                    1, 1e-12);
        EXPECT_NEAR(small.direct_illuminance_lx(Plane::second, radius) /
                        (9 * large.direct_illuminance_lx(Plane::second, 3 * radius)),
                    1, 1e-12);
    }
}

TEST(Sobolev, LosesNoLight) {
    // All of plane 1 receives 2 pi I (1 + p2) / (1 - p1 p2). What falls farther than R is in proportion to 1
    // / R, which extrapolation from two R removes.
    const SobolevProblem exact({0.8, 0.6, 0.3, 0.7, 1});
    const auto ring = [&](double r) { return 2 * pi * r * exact.illuminance_lx(Plane::first, r); };
    const double to_50_lm = integrate(ring, 0, 50, {1, 5}, 2),
                 to_100_lm = to_50_lm + integrate(ring, 50, 100, {}, 1);
    const double total_lm = 2 * pi * 1.6 / (1 - 0.8 * 0.6);
    EXPECT_LT(to_100_lm, total_lm);
    EXPECT_NEAR((2 * to_100_lm - to_50_lm) / total_lm, 1, 1e-3);
}

TEST(Sobolev, TruncationStaysBelowItsBound) {
    for (const ParallelPlanes& planes : kCases) {
        const SobolevProblem exact(planes);
        for (const double half_size : {2.0, 6.0, 20.0}) {
            const PlanesBySuccessiveReflection truncated(planes, half_size);
            for (const double share : {0.0, 0.3, 0.6, 0.95}) {
                const double radius = share * half_size;
                const double loss = exact.illuminance_lx(Plane::first, radius) -
                                    truncated.illuminance_lx(Plane::first, radius);
                EXPECT_GT(loss, 0);
                EXPECT_LT(loss, exact.truncation_bound_lx(Plane::first, radius, half_size));
            }
        }
    }
}

TEST(Sobolev, TruncationBoundIsOfUse) {
    for (const ParallelPlanes& planes : kCases) {
        const SobolevProblem exact(planes);
        for (const Plane plane : {Plane::first, Plane::second})
            EXPECT_LT(exact.truncation_bound_lx(plane, 5, 200), 1e-4 * exact.illuminance_lx(plane, 5));
    }
}

TEST(Sobolev, RefusesArgumentsOutsideItsDomain) {
    EXPECT_THROW(SobolevProblem({1, 1, 0.5, 0.5, 1}), std::domain_error);
    EXPECT_THROW(SobolevProblem({1.1, 0, 0.5, 0.5, 1}), std::domain_error);
    EXPECT_THROW(SobolevProblem({0.5, -0.1, 0.5, 0.5, 1}), std::domain_error);
    EXPECT_THROW(SobolevProblem({0.5, 0.5, 0, 0.5, 1}), std::domain_error);
    EXPECT_THROW(SobolevProblem({0.5, 0.5, 0.5, 0.5, -1}), std::domain_error);
    EXPECT_THROW(SobolevProblem({std::numeric_limits<double>::quiet_NaN(), 0.5, 0.5, 0.5, 1}),
                 std::domain_error);
    const SobolevProblem exact({0.5, 0.5, 0.5, 0.5, 1});
    EXPECT_THROW(exact.illuminance_lx(Plane::first, -1), std::domain_error);
    EXPECT_THROW(exact.illuminance_lx(Plane::first, 101), std::domain_error);
    EXPECT_THROW(exact.truncation_bound_lx(Plane::first, 5, 5), std::domain_error);
}

}  // namespace
}  // namespace stilb::exact
