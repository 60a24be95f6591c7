// Time since a run began.
#pragma once

#include <chrono>

namespace stilb::run {

class Clock {
  public:
    double elapsed_s() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

  private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace stilb::run
