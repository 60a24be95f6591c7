// Whether closed meshes lose rays: verify_watertight [RAYS], for each mesh and size, on all processors.
#include <fmt/format.h>

#include <atomic>
#include <cstdlib>
#include <thread>
#include <vector>

#include "support/closed_meshes.h"

int main(int count, char** arguments) {
    using namespace stilb;
    const std::uint64_t rays = count > 1 ? std::strtoull(arguments[1], nullptr, 10) : 100'000'000;
    const unsigned threads = std::max(1u, std::thread::hardware_concurrency());
    bool all_held = true;
    for (const ClosedMeshEntry& entry : kClosedMeshes) {
        for (const double size_m : {1e-3, 1.0, 1e4}) {
            const ClosedMesh closed = entry.make(size_m);
            for (const Queries queries : {Queries::single, Queries::packets}) {
                std::atomic<std::uint64_t> lost = 0;
                std::vector<std::jthread> workers;
                for (unsigned t = 0; t < threads; ++t) {
                    workers.emplace_back(
                        [&, t] { lost += lost_rays(closed, queries, rays / threads + 1, 100 + t); });
                }
                workers.clear();
                fmt::print("{:12} {:>7} m, {}: {} of {} rays lost\n", entry.name, size_m,
                           queries == Queries::single ? "single" : "packets", lost.load(), rays);
                all_held = all_held && lost == 0;
            }
        }
    }
    return all_held ? 0 : 1;
}
