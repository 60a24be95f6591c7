// The content of the library's states of runs.
#pragma once

#include <span>

#include "io/results/run_file.h"
#include "run/plan.h"
#include "stilb/measure.h"

namespace stilb::api {

struct RunState::Data {
    io::RunOrigin origin;  ///< without traits before the run has begun
    run::RunState sums;

    /// Takes the traits of a run that begins; throws InputError where this is the state of another one.
    void require(const Scene& scene, std::span<const Sensor> sensors, const RunOptions& options);
    /// Takes the traits of a scene that is the same in another form, such as its file.
    void adopt(const Scene& scene, std::span<const Sensor> sensors, const RunOptions& options);
    /// Adds the time and the ending of a call that has added samples, and tells it the time of all.
    void end(RunSummary& call);
};

}  // namespace stilb::api
