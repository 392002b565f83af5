#pragma once

namespace tushar {

/// Memory that this process uses now, and its peak use since it started [bytes]; 0 if the system does not report them.
struct ResidentMemory {
  double now = 0, peak = 0;
};
ResidentMemory residentMemory();

/// Peak memory of this process [bytes]; the call takes a microsecond.
double peakMemory();

/// Measures the growth of the process's peak memory [bytes] while this object exists, and adds it to a number.
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
