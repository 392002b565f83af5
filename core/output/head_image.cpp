#include "core/output/head_image.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <random>
#include <system_error>
#include <utility>
#include <variant>

#include "core/base/error.hpp"
#include "core/base/joined.hpp"

namespace tushar::output {

void HeadDraft::vary(void* bytes, std::size_t size) {
  std::string value(static_cast<const char*>(bytes), size);
  if (collects()) {
    form_ += fmt::format("{} bytes\n", size);
  } else {
    std::mt19937 random(static_cast<std::mt19937::result_type>(values_.size() + 1));
    for (char& byte : value) byte = static_cast<char>('A' + random() % 26);  // no end of a text, and no NaN
    std::memcpy(bytes, value.data(), size);
  }
  values_.push_back(std::move(value));
}

std::string formOf(const std::string& name, const Array& array, const std::vector<std::uint64_t>& shape) {
  return fmt::format("{} {} {} {} {} {}", name, array.values.index(), array.components, joined(shape, " "), array.unit,
                     array.description);
}

std::string valuesIn(const Array& array) {
  return std::visit(
      [](const auto& all) {
        return std::string(reinterpret_cast<const char*>(all.data()), all.size() * sizeof(all[0]));
      },
      array.values);
}

std::optional<HeadImage> HeadImage::of(const std::filesystem::path& file, const std::vector<std::string>& marks,
                                       std::vector<std::uint64_t> rooms) {
  std::ifstream in(file, std::ios::binary);
  const std::string all{std::istreambuf_iterator<char>(in), {}};
  constexpr std::size_t versionAt = 8;  // of the superblock; later formats than 0 have checksums of what varies
  if (all.size() <= versionAt || all[versionAt] != 0) return {};
  HeadImage image{{all.begin(), all.end()}, {}, std::move(rooms)};
  for (const std::string& mark : marks) {
    const std::size_t at = all.find(mark);
    if (at == std::string::npos || all.find(mark, at + 1) != std::string::npos) return {};
    image.varying.push_back(at);
  }
  return image;
}

void HeadImage::set(std::size_t number, const std::string& value) {
  std::memcpy(bytes.data() + varying[number], value.data(), value.size());
}

void HeadImage::write(const std::filesystem::path& file) const {
  const auto fail = [&] {
    throw FileError(fmt::format("cannot write the file '{}': {}", file.string(),
                                std::generic_category().message(errno ? errno : EIO)));
  };
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor < 0) fail();
  for (std::size_t done = 0; done < bytes.size();) {
    errno = 0;
    const ssize_t now = ::write(descriptor, bytes.data() + done, bytes.size() - done);
    if (now < 0 && errno == EINTR) continue;
    if (now <= 0) {
      const int why = errno;
      ::close(descriptor);
      errno = why;
      fail();
    }
    done += static_cast<std::size_t>(now);
  }
  errno = 0;
  if (::close(descriptor) != 0) fail();
}

const std::optional<HeadImage>* HeadImages::find(const std::string& form) const {
  for (const Entry& entry : entries_)
    if (entry.form == form) return &entry.image;
  return nullptr;
}

void HeadImages::keep(const std::string& form, std::optional<HeadImage> image) {
  entries_[next_++ % entries_.size()] = {form, std::move(image)};
}

}  // namespace tushar::output
