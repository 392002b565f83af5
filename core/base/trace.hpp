#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace tushar::trace {

using Clock = std::chrono::steady_clock;

/// The kinds of activity in a trace.
enum class Kind { task, message, output, wait };

std::string_view nameOf(Kind kind);

/// Starts recording spans. Before this call, a span costs only the test of a flag.
void start();
bool isOn();

/// Records an activity of the calling thread from `from` to `to`. `name` must outlive the trace; `patch` is -1 if there
/// is none.
void record(Kind kind, std::string_view name, int patch, Clock::time_point from, Clock::time_point to);

/// Records the time from its construction to its destruction. The spans of a thread are nested.
class Span {
 public:
  Span(Kind kind, std::string_view name, int patch = -1) : name_(name), kind_(kind), patch_(patch), on_(isOn()) {
    if (on_) from_ = Clock::now();
  }
  ~Span() {
    if (on_) record(kind_, name_, patch_, from_, Clock::now());
  }
  Span(const Span&) = delete;
  Span& operator=(const Span&) = delete;

 private:
  std::string_view name_;
  Kind kind_;
  int patch_;
  bool on_;
  Clock::time_point from_;
};

/// The recorded spans of all threads of this rank, as events in Chrome's trace format (ph X: name, category, start and
/// length in microseconds; pid is the rank, tid the thread), separated by commas. On all threads except the first, idle
/// time between two spans is recorded as a wait. Must not be called while threads record.
std::string events(int rank);

/// Makes a file in Chrome's trace format from the events of all ranks.
std::string fileOf(const std::string& events);

}  // namespace tushar::trace
