// Where a run tells how far it is.
#pragma once

#include <cstdint>
#include <string_view>

namespace stilb::run {

struct Pixels;

class ProgressSink {
  public:
    virtual ~ProgressSink() = default;

    /// Before the first sample, some ten times in a second at most; from any thread, one call at a time.
    struct SetUp {
        std::string_view stage;  ///< "first shot", "shooting" ...
        double share = 0;        ///< of the stage, from 0 to 1
        double elapsed_s = 0;
    };
    virtual void report_set_up(const SetUp&) {}

    /// From the run's own thread, after each piece of work: a part of a second or more of all threads' work,
    /// where there is so much.
    struct Progress {
        double elapsed_s = 0;
        double remaining_s = 0;     ///< estimated; infinite where nothing says when to stop
        double attained_error = 0;  ///< at the last look; infinite before it
        std::uint64_t samples = 0;  ///< as RunSummary
    };
    virtual void report(const Progress& progress) = 0;
};

/// One that can show pictures before they are finished.
class PictureSink : public ProgressSink {
  public:
    /// Whether the picture so far is wanted now; asked for after each report(). show() is then called with
    /// it.
    virtual bool wants_picture() = 0;
    virtual void show(const Pixels& pixels) = 0;
};

}  // namespace stilb::run

namespace stilb {
using run::PictureSink;
using run::ProgressSink;
}  // namespace stilb
