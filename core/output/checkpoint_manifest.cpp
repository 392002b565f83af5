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

/// The hashes of share number `one` of `several` of the blocks of a file.
std::vector<std::uint64_t> hashesOf(const fs::path& file, std::uint64_t size, int one, int several) {
  std::ifstream in(file, std::ios::binary);
  if (!in) refuseToRead(file);
  const std::uint64_t blocks = (size + blockBytes - 1) / blockBytes;
  const auto cut = [&](int before) {
    return blocks * static_cast<std::uint64_t>(before) / static_cast<std::uint64_t>(several);
  };
  std::vector<std::uint64_t> hashes;
  for (std::uint64_t block = cut(one); block < cut(one + 1); ++block) {
    const std::uint64_t first = block * blockBytes;
    const auto hash = hashOf(in, first, std::min(blockBytes, size - first));
    if (!hash) refuseToRead(file);
    hashes.push_back(*hash);
  }
  return hashes;
}

/// The hash of a file in a manifest, by those of its blocks.
std::string hashOf(const std::vector<std::uint64_t>& blocks) {
  if (blocks.size() == 1) return fmt::format("{:016x}", blocks.front());
  return fmt::format("{:016x}/{}", XXH64(blocks.data(), blocks.size() * sizeof(blocks[0]), 0), blocks.size());
}

/// The hash of a file that has been written; it is on the disk then.
std::string hashOnDisk(const fs::path& file, std::uint64_t size, const Writers& writers) {
  std::vector<std::uint64_t> mine;
  mpi::together(writers.ranks(), [&] {
    if (writers.mine() < 0) return;
    mine = hashesOf(file, size, writers.mine(), writers.count());
    syncToDisk(file);
  });
  return hashOf(mpi::allOf(writers.ranks(), mine));
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

/// Name and size of each file in a folder, for all ranks; only of the files in the manifest.
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

/// A line of a manifest: `hash size name`, or `hash/blocks size name`.
struct Line {
  std::string hash, name;
  std::uintmax_t size = 0;
};

std::vector<Line> linesOf(const std::string& text) {
  std::vector<Line> lines;
  std::istringstream in(text);
  for (Line line; in >> line.hash >> line.size >> std::ws && std::getline(in, line.name);) lines.push_back(line);
  return lines;
}

/// What is wrong with the manifest, or with the names and sizes of files; `lines` gets its lines, one per file.
std::string damageOfList(const fs::path& folder, std::string& lines) {
  const auto text = textOf(folder / manifestName);
  if (!text) return fmt::format("{} is missing", manifestName);
  const std::size_t end = text->rfind('\n', text->size() < 2 ? 0 : text->size() - 2);
  lines = text->substr(0, end == std::string::npos ? 0 : end + 1);
  if (lines.empty() || *text != lines + lastLine(lines))
    return fmt::format("the content of {} has changed", manifestName);
  for (const Line& line : linesOf(lines)) {
    std::error_code error;
    const std::uintmax_t found = fs::file_size(folder / line.name, error);
    if (error) return fmt::format("{} is missing", line.name);
    if (found != line.size) return fmt::format("{} has {} bytes instead of {}", line.name, found, line.size);
  }
  return "";
}

/// The hash of a file as the manifest has it; empty if it cannot be read. That of a large file of older versions is not
/// by blocks, and made by rank 0 alone.
std::string hashNow(const fs::path& file, const Line& line, const mpi::Communicator& ranks) {
  const bool isByBlocks = line.hash.find('/') != std::string::npos;
  bool failed = false;
  std::vector<std::uint64_t> hashes;
  try {
    if (isByBlocks) hashes = hashesOf(file, line.size, ranks.rank(), ranks.size());
  } catch (const FileError&) {
    failed = true;
  }
  if (!isByBlocks && ranks.isFirst()) {
    std::ifstream in(file, std::ios::binary);
    const auto hash = in ? hashOf(in, 0, line.size) : std::nullopt;
    failed = !hash;
    hashes.push_back(hash.value_or(0));
  }
  return ranks.any(failed) ? "" : hashOf(mpi::allOf(ranks, hashes));
}

}  // namespace

void writeManifest(const fs::path& folder, const Writers& writers) {
  std::string lines;
  for (const auto& [name, size] : listedIn(folder, writers.ranks()))
    lines += fmt::format("{} {} {}\n", hashOnDisk(folder / name, size, writers), size, name);
  writers.ranks().onFirst([&] { replaceFileOnDisk(folder / manifestName, lines + lastLine(lines)); });
}

std::string damageOf(const fs::path& folder, const mpi::Communicator& ranks) {
  std::string damage, lines;
  if (ranks.isFirst()) damage = damageOfList(folder, lines);
  damage = ranks.broadcast(damage);
  if (!damage.empty()) return damage;
  for (const Line& line : linesOf(ranks.broadcast(lines))) {
    const std::string now = hashNow(folder / line.name, line, ranks);
    if (now.empty()) return fmt::format("{} cannot be read", line.name);
    if (now != line.hash) return fmt::format("the content of {} has changed", line.name);
  }
  return "";
}

}  // namespace tushar::output
