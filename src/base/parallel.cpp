#include "base/parallel.h"

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

namespace stilb {

void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body) {
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) { body(i); });
}

void parallel_for_parts(std::size_t count, const std::function<void(std::size_t, std::size_t)>& body,
                        std::size_t size) {
    parallel_for((count + size - 1) / size,
                 [&](std::size_t part) { body(part * size, std::min(count, (part + 1) * size)); });
}

struct ThreadPool::Arena {
    explicit Arena(int count)
        : limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(count)),
          arena(count) {}

    tbb::global_control limit;
    tbb::task_arena arena;
};

ThreadPool::ThreadPool(int threads)
    : arena_(std::make_unique<Arena>(threads > 0 ? threads : tbb::info::default_concurrency())) {}
ThreadPool::~ThreadPool() = default;

void ThreadPool::execute(const std::function<void()>& action) { arena_->arena.execute(action); }

}  // namespace stilb
