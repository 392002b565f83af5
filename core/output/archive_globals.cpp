#include "core/output/archive_globals.hpp"

#include <fmt/format.h>

#include <optional>
#include <system_error>

#include "core/output/archive_cut.hpp"

namespace tushar::output {

namespace fs = std::filesystem;

namespace {

/// The first line of the file: `# time [s] TotalMomentum.x [kg m/s]`, with a name for each component.
std::string headerOf(const GlobalSample& sample) {
  const std::size_t count = sample.values.size();
  std::string names = "# time [s]";
  for (std::size_t k = 0; k < count; ++k) {
    const std::string which = count == 1 ? "" : count == 3 ? std::string(".") + "xyz"[k] : fmt::format(".{}", k + 1);
    names += fmt::format(" {}{} [{}]", sample.name, which, sample.unit);
  }
  return names + "\n";
}

}  // namespace

std::string GlobalFiles::nameOf(const std::string& global) { return nameInPath(global) + ".dat"; }

bool GlobalFiles::append(const GlobalSample& sample) {
  auto found = files_.find(sample.name);
  const bool isNew = found == files_.end();
  line_.clear();
  if (isNew) {
    std::error_code ignored;
    fs::remove(pathOf(sample.name), ignored);
    found = files_.emplace(sample.name, AppendFile(pathOf(sample.name))).first;
    line_ = headerOf(sample);
  }
  line_ += fmt::format("{}", sample.time);
  for (const double value : sample.values) line_ += fmt::format(" {}", value);
  line_ += '\n';
  found->second.append(line_);
  return isNew;
}

std::vector<std::string> GlobalFiles::resume(const std::vector<std::string>& globals, double time) {
  std::vector<std::string> damages;
  for (const std::string& name : globals) {
    const std::optional<std::string> found = textOf(pathOf(name));
    const std::string lines = found.value_or(""), kept = linesUpTo(lines, time);
    const std::string damage = found ? damageBefore(lines, kept, time) : "is missing";
    if (!damage.empty()) damages.push_back(fmt::format("{}: {}", pathOf(name).string(), damage));
    if (kept.empty()) continue;
    if (kept != lines) replaceFile(pathOf(name), kept);
    files_.emplace(name, AppendFile(pathOf(name)));
  }
  return damages;
}

void GlobalFiles::sync() const {
  for (const auto& file : files_) file.second.sync();
}

}  // namespace tushar::output
