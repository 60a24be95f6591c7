#include "bindings/called_run.h"

#include <utility>

namespace stilb::api::bindings {

namespace nb = nanobind;

void CalledRun::report(const Progress& progress) {
    const std::lock_guard lock(mutex_);
    latest_ = progress;
}

void CalledRun::finish() {
    {
        const std::lock_guard lock(mutex_);
        is_finished_ = true;
    }
    finished_.notify_one();
}

void CalledRun::wait() {
    constexpr std::chrono::milliseconds interval(50);
    std::unique_lock lock(mutex_);
    while (!finished_.wait_for(lock, interval, [this] { return is_finished_; })) {
        const std::optional<Progress> progress = std::exchange(latest_, std::nullopt);
        lock.unlock();
        attend(progress);
        lock.lock();
    }
}

void CalledRun::attend(const std::optional<Progress>& progress) {
    if (caller_error_) return;  // the run is about to end
    const nb::gil_scoped_acquire acquire;
    try {
        if (PyErr_CheckSignals() != 0) throw nb::python_error();
        if (progress && !progress_.is_none() && progress_(*progress).is(nb::handle(Py_False)))
            interrupt_ = true;
    } catch (...) {
        caller_error_ = std::current_exception();
        interrupt_ = true;
    }
}

void CalledRun::throw_with(const nb::object& result) const {
    try {
        std::rethrow_exception(caller_error_);
    } catch (nb::python_error& error) {
        nb::setattr(error.value(), "result", result);
        throw;
    }
}

}  // namespace stilb::api::bindings
