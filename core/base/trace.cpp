#include "core/base/trace.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <mutex>
#include <vector>

namespace tushar::trace {

namespace {

struct Event {
  std::string_view name;
  Kind kind;
  int patch;
  Clock::time_point from, to;
};
using Events = std::vector<Event>;

/// The largest number of spans recorded for each thread: as many as viewers can show. Later spans are dropped.
constexpr std::size_t mostEvents = 2000000;

std::atomic<bool> on = false;
Clock::time_point begin;
std::mutex mutex;
std::vector<std::unique_ptr<Events>> threads;

Events& eventsOfThisThread() {
  thread_local Events* mine = nullptr;
  if (!mine) {
    const std::lock_guard<std::mutex> alone(mutex);
    mine = threads.emplace_back(std::make_unique<Events>()).get();
  }
  return *mine;
}

/// Sorts by start, with outer spans before those that they contain.
void sortByNesting(Events& events) {
  std::sort(events.begin(), events.end(),
            [](const Event& a, const Event& b) { return a.from != b.from ? a.from < b.from : a.to > b.to; });
}

/// Returns the gaps between the outermost spans.
Events gapsOf(const Events& sorted) {
  Events gaps;
  for (Clock::time_point end{}; const Event& event : sorted) {
    if (end != Clock::time_point{} && event.from > end) gaps.push_back({"wait", Kind::wait, -1, end, event.from});
    end = std::max(end, event.to);
  }
  return gaps;
}

double microseconds(Clock::duration duration) { return std::chrono::duration<double, std::micro>(duration).count(); }

void append(std::string& text, const Event& event, int rank, std::size_t thread) {
  text += fmt::format(R"(,
{{"ph":"X","name":"{}","cat":"{}","pid":{},"tid":{},"ts":{:.3f},"dur":{:.3f})",
                      event.name, nameOf(event.kind), rank, thread, microseconds(event.from - begin),
                      microseconds(event.to - event.from));
  text += event.patch < 0 ? "}" : fmt::format(R"(,"args":{{"patch":{}}}}})", event.patch);
}

}  // namespace

std::string_view nameOf(Kind kind) {
  constexpr std::string_view names[] = {"task", "message", "output", "wait"};
  return names[static_cast<std::size_t>(kind)];
}

void start() {
  begin = Clock::now();
  eventsOfThisThread();
  on = true;
}

bool isOn() { return on.load(std::memory_order_relaxed); }

void record(Kind kind, std::string_view name, int patch, Clock::time_point from, Clock::time_point to) {
  if (Events& events = eventsOfThisThread(); events.size() < mostEvents)
    events.push_back({name, kind, patch, from, to});
}

std::string events(int rank) {
  const std::lock_guard<std::mutex> alone(mutex);
  std::string text = fmt::format(R"({{"ph":"M","name":"process_name","pid":{0},"args":{{"name":"rank {0}"}}}})", rank);
  for (std::size_t thread = 0; thread < threads.size(); ++thread) {
    Events events = *threads[thread];
    sortByNesting(events);
    const Events gaps = thread == 0 ? Events{} : gapsOf(events);
    events.insert(events.end(), gaps.begin(), gaps.end());
    sortByNesting(events);
    for (const Event& event : events) append(text, event, rank, thread);
  }
  return text;
}

std::string fileOf(const std::string& events) {
  return fmt::format("{{\"displayTimeUnit\":\"ms\",\"traceEvents\":[\n{}\n]}}\n", events);
}

}  // namespace tushar::trace
