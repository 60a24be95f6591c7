// How many threads a run takes.
#pragma once

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/task_arena.h>

namespace stilb::run {

/// So many for all that runs in the arena, while this lives; 0: as many as the machine has.
struct Threads {
    explicit Threads(int asked)
        : count(asked > 0 ? asked : tbb::info::default_concurrency()),
          parallelism(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(count)),
          arena(count) {}

    int count;
    tbb::global_control parallelism;
    tbb::task_arena arena;
};

}  // namespace stilb::run
