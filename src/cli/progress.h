// One line of progress on a terminal.
#pragma once

#include <atomic>
#include <string>
#include <utility>

#include "run/render.h"
#include "run/run.h"

namespace stilb::cli {

/// Rewrites one line of stderr; shows nothing where stderr is no terminal, and clears the line at the end.
class ProgressLine {
  public:
    ProgressLine();
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;
    /// `done`: such as "4096 paths". What is infinite is left out.
    void show(double elapsed_s, const std::string& done, double attained_error, double remaining_s);

  private:
    bool is_terminal_;
};

class TerminalProgress final : public ProgressSink {
  public:
    /// `paths`: what they are called.
    explicit TerminalProgress(std::string paths = "paths") : paths_(std::move(paths)) {}
    void report(const Progress& progress) override;

  private:
    std::string paths_;
    ProgressLine line_;
};

/// The same of a picture, which it does not ask for.
class TerminalPictureProgress : public PictureSink {
  public:
    void report(const Progress& progress) override;
    bool wants_picture() override { return false; }
    void show(const Pixels&) override {}

  private:
    ProgressLine line_;
};

/// Set by the first Ctrl-C after the call; a second one ends the program at once.
const std::atomic<bool>& watch_for_interrupt();

}  // namespace stilb::cli
