#pragma once

#include <chrono>
#include <cstdio>
#include <string>

namespace tushar {

/// Shows the progress of a run. Prints a line for each output. On a terminal, it also keeps redrawing one live line; in
/// a file, such as the log of a batch job, it writes one line per minute of wall time instead.
class Progress {
 public:
  using Clock = std::chrono::steady_clock;

  /// If quiet, prints nothing. `stream` is the terminal or file; `period` is the time between the lines that go to a
  /// file.
  Progress(bool quiet, std::FILE* stream, Clock::duration period = std::chrono::minutes(1));

  /// Prints a permanent line.
  void line(const std::string& text);
  /// Starts to measure how fast the run proceeds. `done` is the fraction of the whole run that is done already.
  void begin(double done);
  /// Draws the live line, or writes a line to a file. `time` and `dt` [s]; `done` is the fraction of the run.
  void live(int step, double time, double dt, double done);
  /// Ends the live line.
  void finish();
  /// Whether the next live() is due, at most ten times a second; cheap enough to call in every step.
  bool due();

 private:
  bool quiet_, terminal_, drawn_ = false;
  std::FILE* stream_;
  Clock::duration period_;  ///< time between live lines
  Clock::time_point started_, next_;
  double done_at_start_ = 0;  ///< fraction of the run that was done at started_
};

}  // namespace tushar
