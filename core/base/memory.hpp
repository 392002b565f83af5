#pragma once

namespace tushar {

/// Memory of this process, bytes: now, and at most since it started. Zero if the system does not tell.
struct ResidentMemory {
  double now = 0, peak = 0;
};
ResidentMemory residentMemory();

/// The most that this process has had in memory, bytes; by a call that takes a microsecond.
double peakMemory();

/// Adds to a number [bytes] by how much the most that this process has had in memory grows while it lives.
class PeakGrowth {
 public:
  explicit PeakGrowth(double& sum) : sum_(sum), before_(peakMemory()) {}
  ~PeakGrowth() { sum_ += peakMemory() - before_; }
  PeakGrowth(const PeakGrowth&) = delete;
  PeakGrowth& operator=(const PeakGrowth&) = delete;

 private:
  double& sum_;
  double before_;
};

}  // namespace tushar
