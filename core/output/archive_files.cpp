#include "core/output/archive_files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <fstream>
#include <sstream>
#include <system_error>

#include "core/base/error.hpp"

namespace tushar::output {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const char* what, const fs::path& path, const std::error_code& why) {
  throw FileError(fmt::format("cannot {} '{}': {}", what, path.string(), why.message()));
}

std::error_code lastError() { return {errno ? errno : EIO, std::generic_category()}; }

/// Transfers all `size` bytes; returns whether this succeeded. `call(done)` transfers some of the bytes after the first
/// `done`, and returns their number, as read and write do.
template <class Call>
bool isWhole(std::size_t size, const Call& call) {
  for (std::size_t done = 0; done < size;) {
    errno = 0;
    const ssize_t now = call(done);
    if (now < 0 && errno == EINTR) continue;
    if (now <= 0) return false;
    done += static_cast<std::size_t>(now);
  }
  return true;
}

/// The largest number of a folder that a run can have made.
constexpr int greatestNumber = 999'999'999;

/// The number 7 of the folder `sod.uda.007` for an archive `sod.uda`; none for other names.
std::optional<int> numberOf(const fs::path& entry, const std::string& base) {
  const std::string name = entry.filename().string();
  if (name.size() <= base.size() + 1 || !name.starts_with(base + ".")) return {};
  int number = 0;
  const auto [end, error] = std::from_chars(name.data() + base.size() + 1, name.data() + name.size(), number);
  if (error != std::errc() || end != name.data() + name.size() || number < 0 || number > greatestNumber) return {};
  return number;
}

fs::path parentOf(const fs::path& filebase) { return filebase.has_parent_path() ? filebase.parent_path() : "."; }

int nextNumber(const fs::path& filebase) {
  std::error_code error;
  int next = 0;
  for (const auto& entry : fs::directory_iterator(parentOf(filebase), error))
    next = std::max(next, numberOf(entry.path(), filebase.filename().string()).value_or(-1) + 1);
  if (error) fail("read the folder", parentOf(filebase), error);
  return next;
}

void refuseToReplace(const fs::path& filebase) {
  std::error_code error;
  const fs::file_status status = fs::symlink_status(filebase, error);
  if (fs::exists(status) && !fs::is_symlink(status))
    throw FileError(
        fmt::format("cannot create '{}' as a link to the newest archive: there is a {} of that name; move it away",
                    filebase.string(), fs::is_directory(status) ? "folder" : "file"));
}

void writeFile(const fs::path& file, const std::function<void(std::ostream&)>& write) {
  errno = 0;
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  if (!out) fail("write", file, lastError());
  write(out);
  out.close();
  if (!out) fail("write", file, lastError());
}

void writeText(const fs::path& file, const std::string& text) {
  writeFile(file, [&](std::ostream& out) { out << text; });
}

}  // namespace

fs::path makeNextFolder(const fs::path& filebase) {
  refuseToReplace(filebase);
  makeFolder(parentOf(filebase));
  std::error_code error;
  for (int number = nextNumber(filebase);; ++number) {
    const fs::path folder = fmt::format("{}.{:03}", filebase.string(), number);
    if (fs::create_directory(folder, error)) return folder;
    if (error) fail("make the folder", folder, error);
  }
}

void makeFolder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) fail("make the folder", folder, error);
}

void pointLink(const fs::path& filebase, const fs::path& folder) {
  refuseToReplace(filebase);
  const fs::path temporary = temporaryOf(folder);
  std::error_code error;
  fs::remove(temporary, error);
  fs::create_directory_symlink(folder.filename(), temporary, error);
  if (error) fail("make the link", filebase, error);
  moveInto(temporary, filebase);
}

void replaceFile(const fs::path& file, const std::string& text) {
  replaceFile(file, [&](std::ostream& out) { out << text; });
}

void replaceFile(const fs::path& file, const std::function<void(std::ostream&)>& write) {
  const fs::path temporary = temporaryOf(file);
  writeFile(temporary, write);
  moveInto(temporary, file);
}

void replaceFileOnDisk(const fs::path& file, const std::string& text) {
  const fs::path temporary = temporaryOf(file);
  writeText(temporary, text);
  syncToDisk(temporary);
  moveInto(temporary, file);
  syncToDisk(parentOf(file));
}

AppendFile::AppendFile(fs::path file)
    : path_(std::move(file)), descriptor_(::open(path_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666)) {
  if (descriptor_ < 0) fail("write", path_, lastError());
}

AppendFile::~AppendFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void AppendFile::append(std::string_view text) {
  const auto write = [&](std::size_t done) { return ::write(descriptor_, text.data() + done, text.size() - done); };
  if (!isWhole(text.size(), write)) fail("write", path_, lastError());
}

void AppendFile::sync() const {
  if (::fsync(descriptor_) != 0) fail("write", path_, lastError());
}

Scratch::~Scratch() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

std::uint64_t Scratch::append(std::span<const std::byte> bytes) {
  if (descriptor_ < 0) {
    descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
    if (descriptor_ < 0) fail("write", path_, lastError());
    ::unlink(path_.c_str());
  }
  const std::uint64_t first = size_;
  const auto write = [&](std::size_t done) {
    return ::pwrite(descriptor_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(first + done));
  };
  if (!isWhole(bytes.size(), write)) fail("write", path_, lastError());
  size_ += bytes.size();
  return first;
}

void Scratch::read(std::uint64_t first, std::span<std::byte> to) const {
  const auto read = [&](std::size_t done) {
    return ::pread(descriptor_, to.data() + done, to.size() - done, static_cast<off_t>(first + done));
  };
  if (!isWhole(to.size(), read)) fail("read", path_, lastError());
}

void moveInto(const fs::path& temporary, const fs::path& file) {
  std::error_code error;
  fs::rename(temporary, file, error);
  if (error) fail("write", file, error);
}

void syncToDisk(const fs::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) fail("open", path, lastError());
  const bool done = ::fsync(descriptor) == 0;
  const std::error_code why = lastError();
  ::close(descriptor);
  if (!done) fail("write", path, why);
}

std::optional<std::string> textOf(const fs::path& file) {
  std::ostringstream text;
  std::ifstream in(file, std::ios::binary);
  if (!in) return {};
  text << in.rdbuf();
  return in.bad() ? std::nullopt : std::optional(text.str());
}

fs::path temporaryOf(const fs::path& file) { return fs::path(file) += ".tmp"; }

std::string nameInPath(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == '/' || c == ':'; }, '_');
  return name;
}

std::string groupName(const std::string& material, int materialIndex) {
  return material.empty() || material == "." ? fmt::format("material{}", materialIndex) : nameInPath(material);
}

std::string stepName(int step) { return fmt::format("t{:05}", step); }

std::string outputName(int step) { return stepName(step) + ".h5"; }

std::optional<int> stepOf(const std::string& name) {
  int step = 0;
  if (!name.starts_with('t') || std::from_chars(name.data() + 1, name.data() + name.size(), step).ec != std::errc())
    return {};
  return stepName(step) == name ? std::optional(step) : std::nullopt;
}

}  // namespace tushar::output
