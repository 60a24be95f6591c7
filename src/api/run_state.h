// The content of the library's states of runs.
#pragma once

#include <span>

#include "io/results/run_file.h"
#include "run/plan.h"
#include "stilb/measure.h"

namespace stilb::api {

struct RunState::Data {
    io::RunTraits traits;  ///< none before the run has begun
    run::RunState sums;

    /// Takes the traits of a run that begins; throws InputError where this is the state of another one.
    void require(const Scene& scene, std::span<const Sensor> sensors, const RunOptions& options);
};

}  // namespace stilb::api
