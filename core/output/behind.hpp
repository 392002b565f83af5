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

/// A thread that runs jobs in order while the caller continues. Each job has a buffer, and the total size of all
/// buffers is bounded: if the bound is reached, the caller waits. The first failure is kept, and later jobs are
/// abandoned, so that a process that fails still takes part in collective operations. All functions must be called from
/// the same thread.
class Behind {
 public:
  Behind() = default;
  /// Waits for all jobs.
  ~Behind();
  Behind(const Behind&) = delete;
  Behind& operator=(const Behind&) = delete;

  /// Sets the largest total size of all buffers; if it is 0, put() runs each job itself. Waits for all jobs, and clears
  /// a failure.
  void setMost(std::size_t bytes);
  std::size_t most() const { return most_; }

  /// Returns a buffer of at least `bytes` bytes for the next job, after waiting until there is space for it.
  std::vector<std::byte> buffer(std::size_t bytes);
  /// Queues a job, which may use the bytes of its buffer until it is done. Returns the number of the job.
  long put(std::vector<std::byte> buffer, std::function<void()> job);

  /// Whether all jobs are done or abandoned.
  bool isDone() const;
  /// Waits for the job with this number and for all earlier jobs.
  void waitFor(long job);
  /// Waits for all jobs; rethrows the first exception.
  void wait();
  /// Time that the caller has spent waiting [s].
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
  std::size_t in_use_ = 0;  ///< total size of all buffers in use [bytes]
  std::deque<Job> jobs_;
  std::vector<std::vector<std::byte>> spare_;
  long given_ = 0, done_ = 0;
  bool ends_ = false;
  std::exception_ptr failure_;
  double waited_ = 0;
  mutable std::mutex mutex_;
  std::condition_variable news_;  ///< signals that a job has been queued or is done
  std::thread thread_;
};

}  // namespace tushar::output
