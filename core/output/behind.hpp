#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace tushar::output {

/// A thread that does jobs in their order while the caller goes on. Each job has a buffer, and all together have no
/// more than a bound: where that is reached, the caller waits. The first failure is kept, and later jobs are let go: so
/// a process that fails still takes part in what others wait for. One thread calls it.
class Behind {
 public:
  Behind() = default;
  /// Waits for all jobs.
  ~Behind();
  Behind(const Behind&) = delete;
  Behind& operator=(const Behind&) = delete;

  /// Buffers may have so many bytes together from now on; 0: each job is done when it is given. Waits for all jobs, and
  /// forgets a failure.
  void setMost(std::size_t bytes);
  std::size_t most() const { return most_; }

  /// A buffer of at least so many bytes for the next job; waits until there is room for it.
  std::vector<std::byte> buffer(std::size_t bytes);
  /// Has a job done, which may use the bytes of its buffer until then. Returns its number.
  long put(std::vector<std::byte> buffer, std::function<void()> job);

  /// Whether all jobs are done, or let go.
  bool isDone() const;
  /// Waits for the job of a number, and those before it.
  void waitFor(long job);
  /// Waits for all jobs; throws what the first that failed has thrown.
  void wait();
  /// How long the caller has waited, s.
  double waited() const { return waited_; }

 private:
  struct Job {
    std::vector<std::byte> buffer;
    std::function<void()> action;
  };
  void run();
  void start();
  template <class Condition>
  void waitUntil(std::unique_lock<std::mutex>& lock, Condition&& condition);

  std::size_t most_ = 0;
  std::size_t in_use_ = 0;  ///< bytes of buffers in use
  std::deque<Job> jobs_;
  std::vector<std::vector<std::byte>> spare_;
  long given_ = 0, done_ = 0;
  bool ends_ = false;
  std::exception_ptr failure_;
  double waited_ = 0;
  mutable std::mutex mutex_;
  std::condition_variable news_;  ///< a job has been given, or done
  std::thread thread_;
};

}  // namespace tushar::output
