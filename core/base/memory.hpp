#pragma once

namespace tushar {

/// Memory used by this process [bytes]: now, and the peak since its start. 0 if the system does not report it.
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
