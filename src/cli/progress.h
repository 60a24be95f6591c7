// The progress and the warnings of a command, on stderr.
#pragma once

#include <atomic>
#include <span>
#include <string>
#include <utility>

#include "run/run.h"

namespace stilb::cli {

/// Rewrites one line of stderr and clears it at the end. Shows nothing where stderr is not a terminal.
class ProgressLine {
  public:
    ProgressLine();
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;
    void show(double elapsed_s, const std::string& text);

  private:
    bool is_terminal_;
};

/// Progress of any run. Requests no unfinished pictures.
class TerminalProgress : public PictureSink {
  public:
    /// `samples`: the name of the run's samples.
    explicit TerminalProgress(std::string samples = "paths") : samples_(std::move(samples)) {}
    void report_set_up(const SetUp& set_up) override;
    void report(const Progress& progress) override;
    bool wants_picture() override { return false; }
    void show(const run::Pixels&) override {}

  private:
    std::string samples_;
    ProgressLine line_;
};

/// Puts the warnings of a scene's file before those of a run.
void add_warnings(RunSummary& result, std::span<const std::string> of_file);
void print_warnings(std::span<const std::string> warnings);

/// The flag that is set by the first Ctrl-C after this call, by SIGTERM, and by SIGHUP (the terminal closes);
/// a second Ctrl-C or SIGTERM ends the program at once.
const std::atomic<bool>& watch_for_interrupt();

/// Makes these signals remove a file that is being written before they end the program; until
/// watch_for_interrupt().
void leave_no_unfinished_files();

}  // namespace stilb::cli
