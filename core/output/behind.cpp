#include "core/output/behind.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <utility>

#include "core/base/trace.hpp"

namespace tushar::output {

namespace {

std::exception_ptr thrownBy(const std::function<void()>& action) {
  try {
    const trace::Span span(trace::Kind::output, "write");
    action();
  } catch (...) {
    return std::current_exception();
  }
  return {};
}

}  // namespace

Behind::~Behind() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  news_.notify_all();
  thread_.join();
}

template <class Condition>
void Behind::waitUntil(std::unique_lock<std::mutex>& lock, Condition&& condition) {
  if (condition()) return;
  const auto started = std::chrono::steady_clock::now();
  news_.wait(lock, condition);
  waited_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
}

void Behind::setMost(std::size_t bytes) {
  waitFor(given_);
  failure_ = nullptr;
  in_use_ = 0;
  most_ = bytes;
}

std::vector<std::byte> Behind::buffer(std::size_t bytes) {
  std::vector<std::byte> taken;
  std::unique_lock lock(mutex_);
  waitUntil(lock, [&] { return in_use_ == 0 || in_use_ + bytes <= most_ || most_ == 0; });
  if (!spare_.empty()) {
    taken = std::move(spare_.back());
    spare_.pop_back();
  }
  if (taken.size() < bytes) taken.resize(bytes);
  in_use_ += taken.size();
  return taken;
}

long Behind::put(std::vector<std::byte> buffer, std::function<void()> job) {
  std::unique_lock lock(mutex_);
  jobs_.push_back({std::move(buffer), std::move(job)});
  ++given_;
  if (most_ == 0) {
    lock.unlock();
    run();
    return given_;
  }
  if (!thread_.joinable()) start();
  lock.unlock();
  news_.notify_all();
  return given_;
}

/// Starts the thread; signals are still delivered to the main thread.
void Behind::start() {
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  thread_ = std::thread([this] {
    for (;;) {
      {
        std::unique_lock lock(mutex_);
        news_.wait(lock, [&] { return ends_ || !jobs_.empty(); });
        if (jobs_.empty()) return;
      }
      run();
    }
  });
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

/// Runs the next job.
void Behind::run() {
  std::unique_lock lock(mutex_);
  Job job = std::move(jobs_.front());
  jobs_.pop_front();
  std::exception_ptr failure = failure_;
  lock.unlock();
  if (!failure) failure = thrownBy(job.action);
  job.action = nullptr;
  lock.lock();
  failure_ = failure;
  in_use_ -= std::min(in_use_, job.buffer.size());
  if (!job.buffer.empty()) spare_.push_back(std::move(job.buffer));
  ++done_;
  lock.unlock();
  news_.notify_all();
}

bool Behind::isDone() const {
  const std::lock_guard lock(mutex_);
  return done_ == given_;
}

void Behind::waitFor(long job) {
  std::unique_lock lock(mutex_);
  waitUntil(lock, [&] { return done_ >= job; });
}

void Behind::wait() {
  waitFor(given_);
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

}  // namespace tushar::output
