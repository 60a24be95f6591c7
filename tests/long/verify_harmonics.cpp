// Whether rays miss surfaces by spherical harmonics: verify_harmonics [RAYS], in all, on all processors.
// Roots and cells must find every crossing that small steps find (support/harmonic_check.h), and what single
// precision tells of cells must be true; the paper's marching is counted only, with every tenth ray.
#include <fmt/format.h>

#include <cstdlib>
#include <iterator>
#include <map>
#include <thread>
#include <vector>

#include "support/harmonic_check.h"

namespace stilb {
namespace {

constexpr std::uint64_t kMarchedEvery = 10;

struct Shape {
    int degree;
    double falloff;  ///< 0: white relief
    double ratio;    ///< of the least radius to the greatest
};
constexpr Shape kShapes[]{
    {1, 0, 0.2},  {2, 0, 0.08},  {3, 0, 0.1},    {4, 0, 0.08},    {6, 2, 0.08},
    {8, 0, 0.08}, {8, 2.5, 0.1}, {10, 3, 0.08},  {12, 0, 0.08},   {12, 2, 0.2},
    {16, 0, 0.1}, {16, 2, 0.08}, {20, 2.5, 0.1}, {24, 0, 0.2},    {24, 2, 0.1},
    {32, 0, 0.3}, {32, 2, 0.08}, {32, 2.5, 0.3}, {48, 2.5, 0.08}, {64, 2, 0.2},
};
using Report = std::map<RayKind, Tallies>;

Report check(const CheckedSurface& surface, std::uint64_t rays_of_kind, std::uint64_t seed) {
    const unsigned threads = std::max(1u, std::thread::hardware_concurrency());
    std::vector<Report> parts(threads);
    std::vector<std::jthread> workers;
    for (unsigned t = 0; t < threads; ++t) {
        workers.emplace_back([&, t] {
            for (const RayKind kind : kRayKinds) {
                const std::uint64_t own = (seed * kRayKinds.size() + static_cast<std::uint64_t>(kind)) * 1000;
                parts[t][kind] = surface.check(kind, rays_of_kind / threads + 1, kMarchedEvery, own + t);
            }
        });
    }
    workers.clear();
    Report sum;
    for (const Report& part : parts) {
        for (const auto& [kind, tallies] : part) sum[kind] += tallies;
    }
    return sum;
}

bool is_good(const Tally& tally) { return tally.missed == 0 && tally.wrong == 0; }

void print(const char* name, const char* method, const Tally& tally) {
    fmt::print("{:16} {:6} {:>10} {:>10} {:>8} {:>8} {:10.1e}\n", name, method, tally.rays, tally.hits,
               tally.missed, tally.wrong, tally.farthest);
}

bool verify(std::uint64_t rays) {
    Report sum;
    std::uint64_t seed = 0;
    bool all_held = true;
    for (const Shape& shape : kShapes) {
        const CheckedSurface surface(strong_surface(shape.degree, shape.falloff, shape.ratio, ++seed));
        const Report report = check(surface, rays / (std::size(kShapes) * kRayKinds.size()), seed);
        Tallies own;
        for (const auto& [kind, tallies] : report) {
            sum[kind] += tallies;
            own += tallies;
        }
        const bool has_held = is_good(own.roots) && is_good(own.cells) && own.classifications.wrong == 0;
        all_held = all_held && has_held;
        fmt::print("degree {:2}, variances like l^-{:.0f}, radii 1 to {:4.1f}: {:6} cells, {}\n",
                   shape.degree, 2 * shape.falloff, 1 / shape.ratio, surface.cells().count(),
                   has_held ? "held" : "FAILED");
        std::fflush(stdout);
    }
    fmt::print("{:16} {:6} {:>10} {:>10} {:>8} {:>8} {:>10}\n", "rays", "by", "number", "hits", "missed",
               "wrong", "farthest");
    for (const auto& [kind, tallies] : sum) {
        print(name_of(kind), "roots", tallies.roots);
        print("", "cells", tallies.cells);
        print("", "march", tallies.march);
    }
    ClassificationTally classifications;
    for (const auto& [kind, tallies] : sum) classifications += tallies.classifications;
    fmt::print(
        "single precision: {} classifications of rays and cells, {} wrong; {} left to double precision\n",
        classifications.told, classifications.wrong, classifications.unclear);
    return all_held;
}

}  // namespace
}  // namespace stilb

int main(int count, char** arguments) {
    return stilb::verify(count > 1 ? std::strtoull(arguments[1], nullptr, 10) : 10'000'000) ? 0 : 1;
}
