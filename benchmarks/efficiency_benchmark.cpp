// Efficiency 1 / (variance x time) of the methods on a 64 x 64 grid in a furnished room, one thread, over
// `path`.
//
// Variance is that of the value of a run (16 replicates), relative to the value squared: its mean over the
// readings, its median, and the square of the error that 95 % of the readings keep, which is what a run stops
// by.
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <vector>

#include "estimators/estimator_list.h"
#include "rooms.h"

namespace stilb {
namespace {

constexpr std::uint64_t kReplicates = 16;

double cpu_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Efficiency {
    double by_mean = 0, by_median = 0, by_95_percent = 0;
    double cpu_s = 0;
};

Efficiency measure(const Estimator& estimator, std::size_t readings, std::uint64_t samples) {
    std::vector<double> sum(readings), sum_of_squares(readings);
    const double start = cpu_s();
    for (std::uint64_t r = 0; r < kReplicates; ++r) {
        ReadingSums sums(readings);
        estimator.run_batch({RandomKey{3}.derived(r), 0, samples}, sums);
        for (std::size_t j = 0; j < readings; ++j) {
            const double value = estimator.known_part()[j].luminance() +
                                 sums.sum[j].luminance() / static_cast<double>(samples);
            sum[j] += value;
            sum_of_squares[j] += value * value;
        }
    }
    const double elapsed_s = cpu_s() - start;
    std::vector<double> variances;
    double mean_variance = 0;
    for (std::size_t j = 0; j < readings; ++j) {
        const double mean = sum[j] / kReplicates;
        if (mean <= 0) continue;
        const double variance = (sum_of_squares[j] / kReplicates - mean * mean) / (kReplicates - 1);
        variances.push_back(variance / (mean * mean));
        mean_variance += variances.back();
    }
    mean_variance /= static_cast<double>(variances.size());
    std::sort(variances.begin(), variances.end());
    const auto efficiency = [&](double variance) { return 1 / (variance * elapsed_s); };
    return {efficiency(mean_variance), efficiency(variances[variances.size() / 2]),
            efficiency(variances[variances.size() * 95 / 100]), elapsed_s};
}

void compare(const Scene& scene) {
    const RayCaster caster(scene);
    const std::vector<Measurand> points = make_grid(64);
    const auto make = [&](std::string_view name) {
        return find_estimator(name).make({scene, caster, points, 1 << 20, RandomKey{5}});
    };
    const Efficiency path = measure(*make("path"), points.size(), 32);
    fmt::print("path: {:.1f} s\n{:8} {:>10} {:>10} {:>10} {:>8}\n", path.cpu_s, "", "mean", "median", "95 %",
               "s");
    for (const std::string_view name : {"auto", "local"}) {
        const Efficiency e = measure(*make(name), points.size(), name == "auto" ? 8192 : 512);
        fmt::print("{:8} {:10.1f} {:10.1f} {:10.1f} {:8.1f}\n", name, e.by_mean / path.by_mean,
                   e.by_median / path.by_median, e.by_95_percent / path.by_95_percent, e.cpu_s);
    }
}

}  // namespace
}  // namespace stilb

int main() {
    const stilb::Scene room = stilb::make_room(30);
    fmt::print("Efficiency 1 / (variance x time) over path tracing, 64 x 64 points, {}\n", room.name);
    stilb::compare(room);
}
