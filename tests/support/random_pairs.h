// Pairs of random numbers for tests that need no low discrepancy; the seed is fixed by each test.
#pragma once

#include <cstdint>
#include <random>

namespace stilb {

struct RandomPair {
    double u1, u2;
};

class RandomPairs {
  public:
    explicit RandomPairs(std::uint64_t seed) : engine_(seed) {}
    double next() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
    RandomPair next_pair() {
        const double u1 = next();
        return {u1, next()};
    }

  private:
    std::mt19937_64 engine_;
};

}  // namespace stilb
