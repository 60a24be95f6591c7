#include "math/zernike.h"

#include <cmath>
#include <numbers>

namespace stilb::math {
namespace {

std::size_t number_of(int n, int m) { return static_cast<std::size_t>((n * (n + 2) + m) / 2); }

}  // namespace

/// The radial polynomial is r^m P_k(t), P_k Jacobi's polynomial of parameters 0 and m, with n = m + 2 k [Born
/// and Wolf; recurrence: Abramowitz and Stegun 22.7.1].
ZernikeBasis::ZernikeBasis(int degree) : degree_(degree) {
    for (int n = 0; n <= degree; ++n) {
        for (int m = -n; m <= n; m += 2) {
            norms_.push_back(std::sqrt((m == 0 ? n + 1 : 2 * n + 2) * std::numbers::inv_pi));
        }
    }
    for (int m = 0; m <= degree; ++m) {
        recurrences_.push_back({(m + 2) / 2.0, -m / 2.0, 0});
        for (int k = 1; m + 2 * k <= degree; ++k) {
            const double sum = 2 * k + m, divisor = 2 * (k + 1.) * (k + m + 1) * sum;
            recurrences_.push_back({(sum + 1) * (sum + 2) * sum / divisor, -(sum + 1) * m * m / divisor,
                                    2. * k * (k + m) * (sum + 2) / divisor});
        }
    }
}

void ZernikeBasis::evaluate(const Vec3& direction, std::span<double> values) const {
    const auto& [x, y, z] = direction;
    const double t = 2 * (x * x + y * y) - 1;
    const Recurrence* recurrence = recurrences_.data();
    double cosine = 1, sine = 0;  // r^m cos(m phi), r^m sin(m phi)
    for (int m = 0; m <= degree_; ++m) {
        double before = 0, p = 1;
        for (int n = m; n <= degree_; n += 2) {
            const std::size_t even = number_of(n, m), odd = number_of(n, -m);
            values[odd] = norms_[odd] * p * sine;
            values[even] = norms_[even] * p * cosine;  // last: of m = 0 there is no other
            const double next = (recurrence->a * t + recurrence->b) * p - recurrence->c * before;
            before = p;
            p = next;
            ++recurrence;
        }
        const double turned = cosine * x - sine * y;
        sine = sine * x + cosine * y;
        cosine = turned;
    }
}

}  // namespace stilb::math
