#pragma once

namespace tushar {

/// Memory of this process, bytes: now, and the peak since it started. Zero if the system gives neither.
struct ResidentMemory {
  double now = 0, peak = 0;
};
ResidentMemory residentMemory();

/// Peak memory of this process, bytes; the call takes a microsecond.
double peakMemory();

/// Adds the growth of this process's peak memory during its life to a number [bytes].
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
