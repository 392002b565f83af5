#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/trace.hpp"

namespace tushar {

/// Number of cores that this rank may use: at most the cores to which it is bound, at most its equal share if a
/// launcher started several ranks on this machine, and at most SLURM_CPUS_PER_TASK, if that is set.
int allowedThreads();

/// The version of TBB in use.
std::string tbbVersion();

/// A fixed number of threads, including the calling thread, that share the iterations of loops.
class Threads {
 public:
  explicit Threads(int count = 1);
  ~Threads();
  Threads(const Threads&) = delete;
  Threads& operator=(const Threads&) = delete;

  int count() const { return count_; }
  /// Sets the number of threads for the next and later loops.
  void resize(int count);

  /// Distributes the iterations of later loops that have as many of them as `costs` has entries, so that the sum of
  /// costs is about the same for each thread. Until the next call, each thread gets the same iterations in every loop,
  /// except those that it takes from a thread that is late. Does nothing if the gain would be less than a twentieth. If
  /// `costs` is empty, each thread gets consecutive iterations again.
  void distribute(const std::vector<double>& costs);
  /// The order in which threads get these iterations, one thread after the other; empty: consecutive.
  const std::vector<int>& order() const { return order_; }

  /// Calls `work(0)` to `work(times - 1)`, in any order and possibly concurrently, and returns when all are done. If a
  /// call throws, the remaining calls are made nevertheless; then the exception of the call with the lowest number is
  /// rethrown. Work that is called once, or that a single thread does, may itself run such loops.
  template <class Work>
  void forEach(int times, const Work& work, trace::Kind kind = trace::Kind::task) {
    run(times, {&work, [](const void* called, int k) { (*static_cast<const Work*>(called))(k); }}, kind);
  }

  /// Calls `work()` once, on this thread; it appears in a trace as `name`, which must outlive the trace.
  template <class Work>
  void alone(const Work& work, trace::Kind kind, std::string_view name) {
    const auto named = [&](int) {
      const trace::Span span(kind, name);
      work();
    };
    forEach(1, named, kind);
  }

  /// Time spent in loops so far [s].
  struct Use {
    double task = 0, message = 0;  ///< sum over all threads, separately for each kind of loop
    double loops = 0;              ///< elapsed time, from the start of each loop to its end
  };
  const Use& use() const { return use_; }

  /// If `outside` is true, loops on a single thread do not read the clock, because their caller measures the time.
  void countOutside(bool outside) { counted_outside_ = outside && !pool_; }
  bool isCountedOutside() const { return counted_outside_; }
  /// Adds the time [s] of loops that did not read the clock.
  void count(double seconds, trace::Kind kind) {
    (kind == trace::Kind::message ? use_.message : use_.task) += seconds;
    use_.loops += seconds;
  }

 private:
  struct Loop {
    const void* called;
    void (*call)(const void* called, int k);
  };
  class Pool;
  void run(int times, const Loop& loop, trace::Kind kind);

  int count_ = 1;
  bool counted_outside_ = false;
  Use use_;
  std::unique_ptr<Pool> pool_;  ///< null if there is only one thread
  std::vector<int> order_;      ///< see order()
};

}  // namespace tushar
