// Quadrature for the tests' own integrals: Gauss panels between given kinks.
#pragma once

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <vector>

namespace stilb::exact::test {

/// The integral of f from a to b, in `panels` equal panels of 20 points between neighbouring kinks. Kinks
/// outside of (a, b) are ignored.
template <class Function>
double integrate(const Function& f, double a, double b, std::vector<double> kinks = {}, int panels = 8) {
    std::erase_if(kinks, [&](double kink) { return !(kink > a && kink < b); });
    kinks.push_back(b);
    std::sort(kinks.begin(), kinks.end());
    double sum = 0;
    for (const double end : kinks) {
        const double step = (end - a) / panels;
        for (int i = 0; i < panels; ++i)
            sum += boost::math::quadrature::gauss<double, 20>::integrate(f, a + i * step, a + (i + 1) * step);
        a = end;
    }
    return sum;
}

}  // namespace stilb::exact::test
