#include "core/base/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

namespace tushar {

Progress::Progress(bool quiet, std::FILE* stream, Clock::duration period)
    : quiet_(quiet),
      terminal_(!quiet && isatty(fileno(stream))),
      stream_(stream),
      period_(terminal_ ? std::chrono::milliseconds(100) : period),
      started_(Clock::now()),
      next_(terminal_ ? started_ : started_ + period_) {}

void Progress::line(const std::string& text) {
  if (quiet_) return;
  finish();
  fmt::print(stream_, "{}\n", text);
  std::fflush(stream_);
}

bool Progress::due() { return !quiet_ && Clock::now() >= next_; }

void Progress::begin(double done) {
  started_ = Clock::now();
  done_at_start_ = done;
}

void Progress::live(int step, double time, double dt, double done) {
  const auto now = Clock::now();
  next_ = now + period_;
  const double elapsed = std::chrono::duration<double>(now - started_).count();
  const double left = done > done_at_start_ && done < 1 ? elapsed * (1 - done) / (done - done_at_start_) : 0.0;
  if (!terminal_)
    return line(fmt::format("step {:>6}  t = {:<12.6g} dt = {:<10.4g} {:.0f} %, {:.0f} s left", step, time, dt,
                            100 * done, left));
  fmt::print(stream_, "\r\033[Kstep {}  t = {:.5g} s  dt = {:.3g} s  {:.0f} %  {:.0f} s left", step, time, dt,
             100 * done, left);
  std::fflush(stream_);
  drawn_ = true;
}

void Progress::finish() {
  if (drawn_) fmt::print(stream_, "\r\033[K");
  drawn_ = false;
}

}  // namespace tushar
