#include "core/simulation/trigger_files.hpp"

#include <system_error>

namespace tushar::simulation {

TriggerFiles::TriggerFiles(std::filesystem::path folder) : folder_(std::move(folder)) { look(0); }

TriggerFiles::Found TriggerFiles::look(double now) {
  constexpr double interval = 0.1;  // s
  if (now < next_) return {};
  next_ = now + interval;
  return {take("output_now"), take("stop_now")};
}

bool TriggerFiles::take(const char* name) const {
  std::error_code ignored;
  return std::filesystem::remove(folder_ / name, ignored);
}

}  // namespace tushar::simulation
