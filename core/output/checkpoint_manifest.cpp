#include "core/output/checkpoint_manifest.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <fstream>
#include <memory>
#include <optional>
#include <sstream>
#include <vector>

#include "core/base/error.hpp"
#include "core/output/archive_files.hpp"

namespace tushar::output {

namespace fs = std::filesystem;

namespace {

constexpr const char* manifestName = "manifest";

struct StateFree {
  void operator()(XXH64_state_t* state) const { XXH64_freeState(state); }
};

/// The hash of a file, read piece by piece; none if it cannot be read.
std::optional<XXH64_hash_t> hashOf(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return {};
  const std::unique_ptr<XXH64_state_t, StateFree> state(XXH64_createState());
  XXH64_reset(state.get(), 0);
  std::vector<char> piece(1 << 20);
  while (in.read(piece.data(), static_cast<std::streamsize>(piece.size())) || in.gcount() > 0)
    XXH64_update(state.get(), piece.data(), in.gcount());
  return in.bad() ? std::nullopt : std::optional(XXH64_digest(state.get()));
}

std::string lastLine(const std::string& lines) {
  return fmt::format("{:016x} {}\n", XXH64(lines.data(), lines.size(), 0), manifestName);
}

std::vector<fs::path> filesIn(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().filename() != manifestName) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// What is wrong with the file of a manifest's line `hash size name`.
std::string damageOfLine(const fs::path& folder, const std::string& line) {
  std::istringstream words(line);
  std::string hash, name;
  std::uintmax_t size = 0;
  words >> hash >> size >> std::ws;
  std::getline(words, name);
  std::error_code error;
  const std::uintmax_t found = fs::file_size(folder / name, error);
  if (error) return fmt::format("{} is missing", name);
  if (found != size) return fmt::format("{} has {} bytes instead of {}", name, found, size);
  const auto now = hashOf(folder / name);
  if (!now) return fmt::format("{} cannot be read", name);
  return fmt::format("{:016x}", *now) == hash ? "" : fmt::format("the content of {} has changed", name);
}

}  // namespace

void writeManifest(const fs::path& folder) {
  std::string lines;
  for (const fs::path& file : filesIn(folder)) {
    const auto hash = hashOf(file);
    if (!hash) throw FileError(fmt::format("cannot read '{}'", file.string()));
    lines += fmt::format("{:016x} {} {}\n", *hash, fs::file_size(file), file.filename().string());
    syncToDisk(file);
  }
  replaceFileOnDisk(folder / manifestName, lines + lastLine(lines));
}

std::string damageOf(const fs::path& folder) {
  const auto text = textOf(folder / manifestName);
  if (!text) return fmt::format("{} is missing", manifestName);
  const std::size_t end = text->rfind('\n', text->size() < 2 ? 0 : text->size() - 2);
  const std::string lines = text->substr(0, end == std::string::npos ? 0 : end + 1);
  if (lines.empty() || *text != lines + lastLine(lines))
    return fmt::format("the content of {} has changed", manifestName);
  std::istringstream in(lines);
  for (std::string line; std::getline(in, line);)
    if (std::string damage = damageOfLine(folder, line); !damage.empty()) return damage;
  return "";
}

}  // namespace tushar::output
