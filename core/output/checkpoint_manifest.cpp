#include "core/output/checkpoint_manifest.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <memory>
#include <optional>
#include <sstream>
#include <string_view>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/mpi_together.hpp"
#include "core/output/archive_files.hpp"

namespace tushar::output {

namespace fs = std::filesystem;

namespace {

constexpr const char* manifestName = "manifest";

/// Size of the blocks for the hashes of older versions [bytes].
constexpr std::uint64_t blockBytes = std::uint64_t{1} << 24;
/// Smallest size of a part with a sum of its own [bytes]. Shorter parts are read twice: for the check, and for their
/// values.
constexpr std::uint64_t leastOfPart = std::uint64_t{1} << 16;

struct StateFree {
  void operator()(XXH64_state_t* state) const { XXH64_freeState(state); }
};

/// The hash of bytes of a file, read piece by piece; none if the file cannot be read.
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

/// The hashes of one rank's share of the blocks of a file.
std::vector<std::uint64_t> hashesOf(const fs::path& file, std::uint64_t size, const ShareOf& share) {
  std::ifstream in(file, std::ios::binary);
  if (!in) refuseToRead(file);
  const std::uint64_t blocks = (size + blockBytes - 1) / blockBytes;
  const auto cut = [&](int before) {
    return blocks * static_cast<std::uint64_t>(before) / static_cast<std::uint64_t>(share.several);
  };
  std::vector<std::uint64_t> hashes;
  for (std::uint64_t block = cut(share.one); block < cut(share.one + 1); ++block) {
    const std::uint64_t first = block * blockBytes;
    const auto hash = hashOf(in, first, std::min(blockBytes, size - first));
    if (!hash) refuseToRead(file);
    hashes.push_back(*hash);
  }
  return hashes;
}

/// The hash of a file in a manifest, computed from the hashes of its blocks.
std::string hashOf(const std::vector<std::uint64_t>& blocks) {
  if (blocks.size() == 1) return fmt::format("{:016x}", blocks.front());
  return fmt::format("{:016x}/{}", XXH64(blocks.data(), blocks.size() * sizeof(blocks[0]), 0), blocks.size());
}

/// The text of a sum in a manifest; it cannot be confused with a hash of older versions.
std::string textOfSum(std::uint64_t sum) { return fmt::format("s{:016x}", sum); }

/// The parts of a file outside the given ascending ranges.
std::vector<ByteRange> outside(const std::vector<ByteRange>& ranges, std::uint64_t size) {
  std::vector<ByteRange> others;
  std::uint64_t first = 0;
  for (const ByteRange& range : ranges) {
    if (first < range.first) others.push_back({first, range.first});
    first = range.last;
  }
  if (first < size) others.push_back({first, size});
  return others;
}

/// The lines of a file for the manifest; if requested, waits until the file is on the disk.
std::string linesOfFile(const fs::path& file, std::uint64_t size, const std::vector<ByteRange>& ranges,
                        const Writers& writers, bool waitsForDisk) {
  std::vector<std::uint64_t> sums(ranges.size() + 1);
  mpi::together(writers.ranks(), [&] {
    if (writers.mine() < 0) return;
    const ShareOf share{writers.mine(), writers.count()};
    for (std::size_t k = 0; k < ranges.size(); ++k) sums[k] = sumOfFile(file, {&ranges[k], 1}, share);
    sums.back() = sumOfFile(file, outside(ranges, size), share);
    if (waitsForDisk) syncToDisk(file);
  });
  sums = sumsOfRanks(writers.ranks(), sums);
  const std::string name = file.filename().string();
  std::string lines = fmt::format("{} {} {}\n", textOfSum(sums.back()), size, name);
  for (std::size_t k = 0; k < ranges.size(); ++k)
    lines += fmt::format("{} {}-{} {}\n", textOfSum(sums[k]), ranges[k].first, ranges[k].last, name);
  return lines;
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

/// The name and size of a file in the folder; the same on all ranks.
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

/// A line of a manifest: `hash size name`, or `hash first-last name`.
struct Line {
  std::string hash, place, name;

  bool isOfPart() const { return place.find('-') != std::string::npos; }
  bool isSum() const { return hash.starts_with('s'); }
  std::uint64_t sum() const { return std::strtoull(hash.c_str() + 1, nullptr, 16); }
  std::uint64_t size() const { return std::strtoull(place.c_str(), nullptr, 10); }
  ByteRange range() const { return {size(), std::strtoull(place.c_str() + place.find('-') + 1, nullptr, 10)}; }
};

constexpr std::string_view formatWord = "format ";

/// The format of a manifest with these lines; 0 if they do not contain a format number.
int formatOf(const std::string& lines) {
  if (!lines.starts_with(formatWord)) return 0;
  int format = std::numeric_limits<int>::max();  // of a number beyond it, or of another word
  std::from_chars(lines.data() + formatWord.size(), lines.data() + lines.size(), format);
  return format;
}

std::vector<Line> linesOf(const std::string& text) {
  std::vector<Line> lines;
  std::istringstream in(formatOf(text) > 0 ? text.substr(text.find('\n') + 1) : text);
  for (Line line; in >> line.hash >> line.place >> std::ws && std::getline(in, line.name);) lines.push_back(line);
  return lines;
}

/// Checks the manifest, and the names and sizes of the files; sets `lines` to the lines of the manifest, one per file.
Inspection inspectList(const fs::path& folder, std::string& lines) {
  const auto text = textOf(folder / manifestName);
  if (!text) return {fmt::format("{} is missing", manifestName)};
  const std::size_t end = text->rfind('\n', text->size() < 2 ? 0 : text->size() - 2);
  lines = text->substr(0, end == std::string::npos ? 0 : end + 1);
  if (lines.empty() || *text != lines + lastLine(lines))
    return {fmt::format("the content of {} has changed", manifestName)};
  if (formatOf(lines) > manifestFormat)
    return {fmt::format("manifest has {}, but this sus supports only formats up to {}",
                        lines.substr(0, lines.find('\n')), manifestFormat),
            true};
  for (const Line& line : linesOf(lines)) {
    if (line.isOfPart()) continue;
    std::error_code error;
    const std::uintmax_t found = fs::file_size(folder / line.name, error);
    if (error) return {fmt::format("{} is missing", line.name)};
    if (found != line.size()) return {fmt::format("{} has {} bytes instead of {}", line.name, found, line.size())};
  }
  return {};
}

/// The hash of a file, computed as in manifests of older versions; empty if the file cannot be read. The oldest
/// manifests contain the hash of a whole large file, not of its blocks; only rank 0 computes it.
std::string hashNow(const fs::path& file, const Line& line, const mpi::Communicator& ranks) {
  const bool isByBlocks = line.hash.find('/') != std::string::npos;
  bool failed = false;
  std::vector<std::uint64_t> hashes;
  try {
    if (isByBlocks) hashes = hashesOf(file, line.size(), {ranks.rank(), ranks.size()});
  } catch (const FileError&) {
    failed = true;
  }
  if (!isByBlocks && ranks.isFirst()) {
    std::ifstream in(file, std::ios::binary);
    const auto hash = in ? hashOf(in, 0, line.size()) : std::nullopt;
    failed = !hash;
    hashes.push_back(hash.value_or(0));
  }
  return ranks.any(failed) ? "" : hashOf(mpi::allOf(ranks, hashes));
}

std::string unreadable(const std::string& name) { return fmt::format("{} cannot be read", name); }
std::string changed(const std::string& name) { return fmt::format("the content of {} has changed", name); }

/// Finds damage in bytes of a file whose sum is known; all ranks read the bytes together.
std::string damageOfSum(const fs::path& file, const mpi::Communicator& ranks, std::uint64_t expected,
                        const std::function<std::uint64_t()>& mine) {
  std::uint64_t sum = 0;
  bool failed = false;
  try {
    sum = mine();
  } catch (const FileError&) {
    failed = true;
  }
  if (ranks.any(failed)) return unreadable(file.filename().string());
  return sumsOfRanks(ranks, {&sum, 1}).front() == expected ? "" : changed(file.filename().string());
}

/// Finds damage in a file outside some parts.
std::string damageOutside(const fs::path& file, const Line& line, const std::vector<Line>& lines,
                          const mpi::Communicator& ranks) {
  if (!line.isSum()) {
    const std::string now = hashNow(file, line, ranks);
    return now.empty() ? unreadable(line.name) : now == line.hash ? "" : changed(line.name);
  }
  std::vector<ByteRange> parts;
  for (const Line& other : lines)
    if (other.isOfPart() && other.name == line.name) parts.push_back(other.range());
  return damageOfSum(file, ranks, line.sum(), [&] {
    return sumOfFile(file, outside(parts, line.size()), {ranks.rank(), ranks.size()});
  });
}

}  // namespace

void writeManifest(const fs::path& folder, const Writers& writers, const std::vector<FilePart>& parts,
                   bool waitsForDisk) {
  std::string lines = fmt::format("{}{}\n", formatWord, manifestFormat);
  for (const auto& [name, size] : listedIn(folder, writers.ranks())) {
    std::vector<ByteRange> ranges;
    for (const FilePart& part : parts)
      if (part.file == name && part.bytes.size() >= leastOfPart) ranges.push_back(part.bytes);
    std::sort(ranges.begin(), ranges.end(), [](const ByteRange& a, const ByteRange& b) { return a.first < b.first; });
    lines += linesOfFile(folder / name, size, ranges, writers, waitsForDisk);
  }
  writers.ranks().onFirst([&] {
    const std::string all = lines + lastLine(lines);
    waitsForDisk ? replaceFileOnDisk(folder / manifestName, all) : replaceFile(folder / manifestName, all);
  });
}

Inspection inspect(const fs::path& folder, const mpi::Communicator& ranks) {
  Inspection found;
  std::string text;
  if (ranks.isFirst()) found = inspectList(folder, text);
  found.damage = ranks.broadcast(found.damage);
  found.isNewer = ranks.any(found.isNewer);
  if (!found.damage.empty()) return found;
  const std::vector<Line> lines = linesOf(ranks.broadcast(text));
  for (const Line& line : lines) {
    if (line.isOfPart())
      found.parts.push_back({line.name, line.range(), line.sum()});
    else
      found.damage = damageOutside(folder / line.name, line, lines, ranks);
    if (!found.damage.empty()) break;
  }
  return found;
}

std::string damageOf(const fs::path& folder, const mpi::Communicator& ranks) {
  Inspection found = inspect(folder, ranks);
  try {
    if (found.damage.empty()) CheckedParts(folder, std::move(found.parts), ranks).checkOthers();
  } catch (const DamageError& error) {
    return error.what();
  }
  return found.damage;
}

CheckedParts::CheckedParts(fs::path folder, std::vector<FilePart> parts, const mpi::Communicator& ranks)
    : folder_(std::move(folder)), parts_(std::move(parts)), ranks_(&ranks), checked_(parts_.size(), false) {}

void CheckedParts::read(const std::string& file, std::uint64_t first, const std::function<void(ByteSum*)>& read) {
  for (std::size_t k = 0; k < parts_.size(); ++k)
    if (parts_[k].file == file && parts_[k].bytes.first == first && !checked_[k]) return check(k, read);
  read(nullptr);
}

void CheckedParts::check(std::size_t part, const std::function<void(ByteSum*)>& read) {
  const std::string damage = damageOfSum(folder_ / parts_[part].file, *ranks_, parts_[part].sum, [&] {
    ByteSum sum;
    read(&sum);
    return sum.value();
  });
  if (!damage.empty()) throw DamageError(damage);
  checked_[part] = true;
}

void CheckedParts::checkOthers() {
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    if (checked_[k]) continue;
    const std::string damage = damageOfSum(folder_ / parts_[k].file, *ranks_, parts_[k].sum, [&] {
      return sumOfFile(folder_ / parts_[k].file, {&parts_[k].bytes, 1}, {ranks_->rank(), ranks_->size()});
    });
    if (!damage.empty()) throw DamageError(damage);
    checked_[k] = true;
  }
}

}  // namespace tushar::output
