#include "core/output/archive_hdf5_parts.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/uio.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "core/base/error.hpp"

namespace tushar::output {

namespace {

/// The file, open for reading while this object exists.
class OpenFile {
 public:
  explicit OpenFile(const std::filesystem::path& path) : descriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
    if (descriptor < 0)
      throw FileError(fmt::format("cannot read '{}': {}", path.string(), std::generic_category().message(errno)));
  }
  ~OpenFile() { ::close(descriptor); }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  const int descriptor;
};

/// Largest number of parts read by one system call; the limit of Linux is 1024.
constexpr std::size_t mostAtOnce = 256;

}  // namespace

Hdf5Parts::Hdf5Parts(const Hdf5Input& file, std::string name, CheckedParts* checks)
    : file_(&file), checks_(checks), name_(std::move(name)) {
  const Hdf5Input::Placed placed = file.placed(name_);
  type_ = placed.type;
  count_ = placed.count;
  offset_ = placed.offset;
  bytes_ = std::visit([](const auto& values) { return sizeof(values[0]); }, type_);
}

void Hdf5Parts::read(std::vector<Part> parts) const {
  if (offset_ < 0) return readWhole(parts);
  std::sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.first < b.first; });
  if (!checks_) return readOnce(parts);
  checks_->read(file_->path().filename().string(), static_cast<std::uint64_t>(offset_), [&](ByteSum* sum) {
    readOnce(parts);
    for (const Part& part : parts)
      if (sum)
        sum->add(static_cast<std::uint64_t>(offset_) + part.first * bytes_,
                 {part.to, (part.count - part.others) * bytes_});
  });
}

/// Reads parts in ascending order. Numbers that a part shares with earlier parts are not read again, but copied from
/// the earlier part that extends farthest.
void Hdf5Parts::readOnce(const std::vector<Part>& parts) const {
  struct Copy {
    const std::byte* from;
    std::byte* to;
    std::size_t bytes;
  };
  std::vector<Part> reads;
  std::vector<Copy> copies;
  const Part* farthest = nullptr;
  for (const Part& part : parts) {
    const std::size_t end = farthest ? farthest->first + farthest->count : 0;
    const std::size_t common = std::min(part.count, std::max(end, part.first) - part.first);
    if (common > 0)
      copies.push_back({farthest->to + (part.first - farthest->first) * bytes_, part.to, common * bytes_});
    if (common == part.count) continue;
    reads.push_back({part.first + common, part.count - common, part.to + common * bytes_});
    farthest = &part;
  }
  readRuns(reads);
  for (const auto& [from, to, bytes] : copies) std::memcpy(to, from, bytes);
}

void Hdf5Parts::readRuns(const std::vector<Part>& parts) const {
  const OpenFile file(file_->path());
  for (const Part *first = parts.data(), *const end = first + parts.size(), *last; first != end; first = last) {
    for (last = first + 1; last != end && static_cast<std::size_t>(last - first) < mostAtOnce &&
                           last->first == last[-1].first + last[-1].count;)
      ++last;
    readRun(file.descriptor, first, last);
  }
}

void Hdf5Parts::readWhole(const std::vector<Part>& parts) const {
  const Array::Values all = file_->dataset(name_);
  const auto* from =
      std::visit([](const auto& values) { return reinterpret_cast<const std::byte*>(values.data()); }, all);
  for (const Part& part : parts) std::memcpy(part.to, from + part.first * bytes_, part.count * bytes_);
}

/// Reads parts that are consecutive in the file.
void Hdf5Parts::readRun(int descriptor, const Part* first, const Part* last) const {
  std::array<iovec, mostAtOnce> to{};
  std::size_t count = 0;
  for (const Part* part = first; part != last; ++part) to[count++] = {part->to, part->count * bytes_};
  auto at = static_cast<off_t>(offset_ + static_cast<std::int64_t>(first->first * bytes_));
  for (std::size_t next = 0; next < count;) {
    errno = 0;
    ssize_t done = preadv(descriptor, &to[next], static_cast<int>(count - next), at);
    if (done < 0 && errno == EINTR) continue;
    if (done < 0 || (done == 0 && to[next].iov_len > 0))
      throw FileError(fmt::format("cannot read {} of '{}': {}", name_, file_->path().string(),
                                  std::generic_category().message(errno ? errno : EIO)));
    at += done;
    for (; next < count && static_cast<std::size_t>(done) >= to[next].iov_len; ++next)
      done -= static_cast<ssize_t>(to[next].iov_len);
    if (next < count) to[next] = {static_cast<std::byte*>(to[next].iov_base) + done, to[next].iov_len - done};
  }
}

}  // namespace tushar::output
