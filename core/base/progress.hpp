#pragma once

#include <chrono>
#include <cstdio>
#include <string>

namespace tushar {

/// Tells how far a run is: a line for each output, and on a terminal a live line that is drawn over.
class Progress {
 public:
  /// Quiet progress says nothing. `stream` is the terminal or file.
  Progress(bool quiet, std::FILE* stream);

  /// A line that stays.
  void line(const std::string& text);
  /// The live line, at most ten times a second. Only on a terminal.
  void live(int step, double time, double delT, double maxTime);
  /// Ends the live line.
  void finish();
  /// Whether a live line is due; cheap enough for every step.
  bool due();

 private:
  using Clock = std::chrono::steady_clock;
  bool quiet_, terminal_, drawn_ = false;
  std::FILE* stream_;
  Clock::time_point started_, next_;
};

}  // namespace tushar
