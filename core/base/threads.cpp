#include "core/base/threads.hpp"

#include <sched.h>
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <unistd.h>

#include <algorithm>
#include <exception>
#include <mutex>

#include "core/base/launcher.hpp"

namespace tushar {

namespace {

int boundCores() {
  cpu_set_t cores;
  return sched_getaffinity(0, sizeof(cores), &cores) == 0 ? CPU_COUNT(&cores) : 1;
}

/// Keeps, of what a loop throws, the exception of the least number.
class FirstFailure {
 public:
  template <class Work>
  void watch(int k, Work&& work) {
    try {
      work();
    } catch (...) {
      const std::lock_guard<std::mutex> alone(mutex_);
      if (!error_ || k < at_) {
        error_ = std::current_exception();
        at_ = k;
      }
    }
  }
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  std::mutex mutex_;
  std::exception_ptr error_;
  int at_ = 0;
};

}  // namespace

int allowedThreads() {
  const int share = static_cast<int>(sysconf(_SC_NPROCESSORS_ONLN)) / ranksOnThisMachine();
  return std::max(1, std::min({boundCores(), share, launchedCoresPerRank()}));
}

class Threads::Pool {
 public:
  explicit Pool(int count)
      : limit_(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(count)), arena_(count) {}

  template <class Work>
  void run(int times, const Work& work) {
    arena_.execute([&] {
      tbb::parallel_for(
          tbb::blocked_range<int>(0, times),
          [&](const tbb::blocked_range<int>& part) {
            for (int k = part.begin(); k < part.end(); ++k) work(k);
          },
          partitioner_);
    });
  }

 private:
  tbb::global_control limit_;
  tbb::task_arena arena_;
  tbb::affinity_partitioner partitioner_;  ///< a thread gets what it had in the loop before: it is in its cache
};

Threads::Threads(int count) : count_(count), pool_(count > 1 ? std::make_unique<Pool>(count) : nullptr) {}

Threads::~Threads() = default;

void Threads::run(int times, const Loop& loop) {
  FirstFailure failure;
  const auto watched = [&](int k) { failure.watch(k, [&] { loop.call(loop.called, k); }); };
  if (pool_ && times > 1)
    pool_->run(times, watched);
  else
    for (int k = 0; k < times; ++k) watched(k);
  failure.rethrow();
}

}  // namespace tushar
