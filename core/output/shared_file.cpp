#include "core/output/shared_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "core/base/error.hpp"

namespace tushar::output {

SharedFile::SharedFile(std::filesystem::path path)
    : path_(std::move(path)), descriptor_(::open(path_.c_str(), O_WRONLY | O_CLOEXEC)) {
  if (descriptor_ < 0) note("the file");
}

SharedFile::~SharedFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void SharedFile::note(const std::string& what) {
  if (failure_.empty())
    failure_ = fmt::format("cannot write {} '{}': {}", what, path_.string(),
                           std::generic_category().message(errno ? errno : EIO));
}

/// Writes a part; if it is large, the system starts to write it to the disk while the next part is prepared.
void SharedFile::write(std::uint64_t at, const std::byte* from, std::size_t count, const std::string& what) {
  constexpr std::size_t large = std::size_t{1} << 18;
  const std::uint64_t first = at;
  const std::size_t all = count;
  while (count > 0 && failure_.empty()) {
    errno = 0;
    const ssize_t done = pwrite(descriptor_, from, count, static_cast<off_t>(at));
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) return note(what + " in");
    from += done;
    at += static_cast<std::uint64_t>(done);
    count -= static_cast<std::size_t>(done);
  }
  if (all >= large && failure_.empty())
    sync_file_range(descriptor_, static_cast<off_t>(first), static_cast<off_t>(all), SYNC_FILE_RANGE_WRITE);
}

void SharedFile::close() {
  errno = 0;
  const int descriptor = std::exchange(descriptor_, -1);
  if (descriptor >= 0 && ::close(descriptor) != 0) note("the file");
  if (!failure_.empty()) throw FileError(failure_);
}

}  // namespace tushar::output
