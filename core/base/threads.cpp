#include "core/base/threads.hpp"

#include <sched.h>
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/version.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <numeric>
#include <utility>
#include <vector>

#include "core/base/even_order.hpp"
#include "core/base/launcher.hpp"

namespace tushar {

using trace::Clock;

namespace {

double seconds(Clock::duration duration) { return std::chrono::duration<double>(duration).count(); }

int boundCores() {
  cpu_set_t cores;
  return sched_getaffinity(0, sizeof(cores), &cores) == 0 ? CPU_COUNT(&cores) : 1;
}

/// Among the exceptions thrown in a loop, keeps the one with the lowest loop index.
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

std::string tbbVersion() { return TBB_runtime_version(); }

int allowedThreads() {
  const int share = static_cast<int>(sysconf(_SC_NPROCESSORS_ONLN)) / ranksOnThisMachine();
  return std::max(1, std::min({boundCores(), share, launchedCoresPerRank()}));
}

class Threads::Pool {
 public:
  explicit Pool(int count) : limit_(tbb::global_control::max_allowed_parallelism, count), arena_(count), busy_(count) {}

  /// Runs the loop; returns the total working time of all threads.
  template <class Work>
  Clock::duration run(int times, const Work& work) {
    started_.store(true, std::memory_order_release);
    arena_.execute([&] {
      const auto from = Clock::now();
      myBusy() = {from, {}};
      tbb::parallel_for(
          tbb::blocked_range<int>(0, times), [&](const tbb::blocked_range<int>& part) { runPart(part, work); },
          partitioner_);
      if (trace::isOn()) trace::record(trace::Kind::wait, "wait", -1, myBusy().until, Clock::now());
    });
    finished_.load(std::memory_order_acquire);
    Clock::duration all{};
    for (Busy& busy : busy_) all += std::exchange(busy.time, {});
    return all;
  }

 private:
  /// Working time of one thread in a loop.
  struct alignas(64) Busy {
    Clock::time_point until;
    Clock::duration time{};
  };
  Busy& myBusy() { return busy_[tbb::this_task_arena::current_thread_index()]; }

  template <class Work>
  void runPart(const tbb::blocked_range<int>& part, const Work& work) {
    started_.load(std::memory_order_acquire);
    const auto from = Clock::now();
    for (int k = part.begin(); k < part.end(); ++k) work(k);
    Busy& busy = myBusy();
    busy.until = Clock::now();
    busy.time += busy.until - from;
    finished_.fetch_add(1, std::memory_order_release);
  }

  tbb::global_control limit_;
  tbb::task_arena arena_;
  tbb::affinity_partitioner
      partitioner_;  ///< gives each thread the same indices again, so that data remain in its cache
  std::vector<Busy> busy_;
  /// TBB synchronises caller and workers. These two variables do so again, in a way that the thread sanitizer can
  /// detect.
  std::atomic<bool> started_ = false;
  std::atomic<long> finished_ = 0;
};

Threads::Threads(int count) { resize(count); }

Threads::~Threads() = default;

void Threads::resize(int count) {
  if (count == count_) return;
  count_ = count;
  counted_outside_ = false;
  pool_.reset();
  if (count > 1) pool_ = std::make_unique<Pool>(count);
}

// TBB divides a loop evenly, so each thread begins with an equal part of the order.
void Threads::distribute(const std::vector<double>& costs) {
  constexpr double worthwhile = 0.95;
  if (costs.empty()) return order_.clear();
  std::vector<int> now = order_;
  if (now.size() != costs.size()) {
    now.resize(costs.size());
    std::iota(now.begin(), now.end(), 0);
  }
  std::vector<int> even = evenOrder(costs, count_);
  if (greatestLoad(costs, even, count_) < worthwhile * greatestLoad(costs, now, count_)) order_ = std::move(even);
}

void Threads::run(int times, const Loop& loop, trace::Kind kind) {
  if (counted_outside_ && times == 1) return loop.call(loop.called, 0);
  FirstFailure failure;
  const bool isOrdered = order_.size() == static_cast<std::size_t>(times);
  const auto watched = [&](int turn) {
    const int k = isOrdered ? order_[turn] : turn;
    failure.watch(k, [&] { loop.call(loop.called, k); });
  };
  const auto workAlone = [&] {
    for (int k = 0; k < times; ++k) watched(k);
  };
  if (counted_outside_) {
    workAlone();
    return failure.rethrow();
  }
  const auto from = Clock::now();
  const double before = use_.loops;
  Clock::duration busy{};
  if (pool_ && times > 1)
    busy = pool_->run(times, watched);
  else
    workAlone();
  const Clock::duration wall = Clock::now() - from;
  const double inner = use_.loops - before;  // has been counted by loops that the work itself ran
  (kind == trace::Kind::message ? use_.message : use_.task) += seconds(pool_ && times > 1 ? busy : wall) - inner;
  use_.loops += seconds(wall) - inner;
  failure.rethrow();
}

}  // namespace tushar
