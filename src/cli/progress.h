// One line of progress on a terminal.
#pragma once

#include <atomic>

#include "run/run.h"

namespace stilb {

/// Rewrites one line of stderr; shows nothing where stderr is no terminal, and clears the line at the end.
class TerminalProgress final : public ProgressSink {
  public:
    TerminalProgress();
    ~TerminalProgress() override;
    TerminalProgress(const TerminalProgress&) = delete;
    TerminalProgress& operator=(const TerminalProgress&) = delete;
    void report(const Progress& progress) override;

  private:
    bool is_terminal_;
};

/// Set by the first Ctrl-C after the call; a second one ends the program at once.
const std::atomic<bool>& watch_for_interrupt();

}  // namespace stilb
