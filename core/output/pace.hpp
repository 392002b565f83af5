#pragma once

#include <algorithm>
#include <chrono>

namespace tushar::output {

/// Decides when to rewrite a list that can only be written as a whole, which takes longer the longer the list is.
/// Between two rewrites, at least one second and at least 20 times the duration of the previous rewrite must therefore
/// pass.
class Pace {
 public:
  /// Records that there is a new entry; `urgent`: whether readers need it immediately.
  void note(bool urgent) {
    behind_ = true;
    urgent_ = urgent_ || urgent;
  }
  bool isBehind() const { return behind_; }
  bool isDue() const { return urgent_ || (behind_ && Clock::now() >= next_); }
  /// Calls `write`; the list is then up to date, unless `write` throws.
  template <class Write>
  void catchUp(const Write& write) {
    const auto started = Clock::now();
    write();
    const auto ended = Clock::now();
    next_ = ended + std::max<Clock::duration>(std::chrono::seconds(1), 20 * (ended - started));
    behind_ = urgent_ = false;
  }

 private:
  using Clock = std::chrono::steady_clock;

  bool behind_ = false, urgent_ = false;
  Clock::time_point next_;
};

}  // namespace tushar::output
