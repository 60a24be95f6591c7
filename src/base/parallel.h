// Parallel loops. The header of oneTBB costs every file that includes it a second; so few do.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace stilb {

/// Calls `body(i)` for 0 <= i < count in any order, on the threads of the ThreadPool that it is called in. An
/// exception of a call ends the loop and is passed on.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body);

/// Calls `body(first, last)` for consecutive parts of 0 <= i < count, as above: for loops with little work
/// for each i. A part has `size` of them, whatever the number of threads.
void parallel_for_parts(std::size_t count, const std::function<void(std::size_t, std::size_t)>& body,
                        std::size_t size = 4096);

/// Threads for parallel loops.
class ThreadPool {
  public:
    /// 0: as many threads as the machine has.
    explicit ThreadPool(int threads);
    ~ThreadPool();
    ThreadPool(const ThreadPool&) = delete;
    ThreadPool& operator=(const ThreadPool&) = delete;

    /// Calls `action`, whose parallel loops then take these threads.
    void execute(const std::function<void()>& action);

  private:
    struct Arena;
    std::unique_ptr<Arena> arena_;
};

}  // namespace stilb
