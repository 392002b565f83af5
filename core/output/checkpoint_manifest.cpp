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
#include "core/base/mpi_together.hpp"
#include "core/output/archive_files.hpp"

namespace tushar::output {

namespace fs = std::filesystem;

namespace {

constexpr const char* manifestName = "manifest";

constexpr std::uint64_t blockBytes = std::uint64_t{1} << 24;

struct StateFree {
  void operator()(XXH64_state_t* state) const { XXH64_freeState(state); }
};

/// The hash of bytes of a file, read piece by piece; none if it cannot be read.
std::optional<XXH64_hash_t> hashOf(std::ifstream& in, std::uint64_t first, std::uint64_t count) {
  const std::unique_ptr<XXH64_state_t, StateFree> state(XXH64_createState());
  XXH64_reset(state.get(), 0);
  std::vector<char> piece(std::min<std::uint64_t>(count, 1 << 20));
  in.seekg(static_cast<std::streamoff>(first));
  while (count > 0) {
    const std::uint64_t next = std::min<std::uint64_t>(count, piece.size());
    if (!in.read(piece.data(), static_cast<std::streamsize>(next))) return {};
    XXH64_update(state.get(), piece.data(), next);
    count -= next;
  }
  return XXH64_digest(state.get());
}

[[noreturn]] void refuseToRead(const fs::path& file) {
  throw FileError(fmt::format("cannot read '{}'", file.string()));
}

/// The hashes of the blocks of a file that are a writer's.
std::vector<std::uint64_t> hashesOf(const fs::path& file, std::uint64_t size, int writer, int writers) {
  std::ifstream in(file, std::ios::binary);
  if (!in) refuseToRead(file);
  const std::uint64_t blocks = (size + blockBytes - 1) / blockBytes;
  const auto cut = [&](int before) {
    return blocks * static_cast<std::uint64_t>(before) / static_cast<std::uint64_t>(writers);
  };
  std::vector<std::uint64_t> hashes;
  for (std::uint64_t block = cut(writer); block < cut(writer + 1); ++block) {
    const std::uint64_t first = block * blockBytes;
    const auto hash = hashOf(in, first, std::min(blockBytes, size - first));
    if (!hash) refuseToRead(file);
    hashes.push_back(*hash);
  }
  return hashes;
}

/// The hash of a file that has been written. `onDisk`: waits until it is there.
std::string hashByBlocks(const fs::path& file, std::uint64_t size, const Writers& writers, bool onDisk) {
  std::vector<std::uint64_t> mine;
  mpi::together(writers.ranks(), [&] {
    if (writers.mine() < 0) return;
    mine = hashesOf(file, size, writers.mine(), writers.count());
    if (onDisk) syncToDisk(file);
  });
  const std::vector<std::uint64_t> all = mpi::allOf(writers.ranks(), mine);
  if (all.size() == 1) return fmt::format("{:016x}", all.front());
  return fmt::format("{:016x}/{}", XXH64(all.data(), all.size() * sizeof(all[0]), 0), all.size());
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

/// Name and size of each file in a folder, for all ranks; those of the manifest, and no others.
struct ListedFile {
  std::string name;
  std::uint64_t size;
};

std::vector<ListedFile> listedIn(const fs::path& folder, const mpi::Communicator& ranks) {
  std::string lines;
  ranks.onFirst([&] {
    for (const fs::path& file : filesIn(folder))
      lines += fmt::format("{} {}\n", fs::file_size(file), file.filename().string());
  });
  std::istringstream in(ranks.broadcast(lines));
  std::vector<ListedFile> files;
  for (ListedFile file; in >> file.size >> std::ws && std::getline(in, file.name);) files.push_back(file);
  return files;
}

/// The hash of a file by the first rank alone, as older versions have made it; empty if it cannot be read.
std::string hashOfWhole(const fs::path& file, std::uint64_t size) {
  std::ifstream in(file, std::ios::binary);
  const auto hash = in ? hashOf(in, 0, size) : std::nullopt;
  return hash ? fmt::format("{:016x}", *hash) : "";
}

/// What is wrong with the file of a manifest's line `hash size name`, or `hash/blocks size name`.
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
  try {
    const bool isByBlocks = hash.find('/') != std::string::npos;
    const std::string now =
        isByBlocks ? hashByBlocks(folder / name, size, {}, false) : hashOfWhole(folder / name, size);
    if (now.empty()) return fmt::format("{} cannot be read", name);
    return now == hash ? "" : fmt::format("the content of {} has changed", name);
  } catch (const FileError&) {
    return fmt::format("{} cannot be read", name);
  }
}

}  // namespace

void writeManifest(const fs::path& folder, const Writers& writers) {
  std::string lines;
  for (const auto& [name, size] : listedIn(folder, writers.ranks()))
    lines += fmt::format("{} {} {}\n", hashByBlocks(folder / name, size, writers, true), size, name);
  writers.ranks().onFirst([&] { replaceFileOnDisk(folder / manifestName, lines + lastLine(lines)); });
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
