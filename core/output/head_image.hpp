#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/output/snapshot.hpp"

namespace tushar::output {

/// What makes up a small file: a text for all that files of the same form share, and the numbers and texts by which
/// they differ. An Hdf5File collects it instead of writing a file, or marks the places of the latter in a file.
class HeadDraft {
 public:
  enum class Use { collects, marks };
  explicit HeadDraft(Use use) : use_(use) {}

  bool collects() const { return use_ == Use::collects; }
  /// Adds to what files of the same form share.
  void share(const std::string& text) { form_ += text + '\n'; }
  /// Takes a number or a text by which files differ, or replaces it by a mark.
  void vary(void* bytes, std::size_t size);

  const std::string& form() const { return form_; }
  /// The values, or the marks in their place.
  const std::vector<std::string>& values() const { return values_; }

 private:
  Use use_;
  std::string form_;
  std::vector<std::string> values_;
};

/// All of a dataset but its values, and the values of an array in memory, as texts for a form.
std::string formOf(const std::string& name, const Array& array, const std::vector<std::uint64_t>& shape);
std::string valuesIn(const Array& array);

/// The bytes of a small HDF5 file, and where they differ from those of other files of its form: HDF5 takes a
/// millisecond to make a file, which would be most of the time of a run with many small outputs.
struct HeadImage {
  std::vector<char> bytes;
  std::vector<std::uint64_t> varying;  ///< offset of each value
  std::vector<std::uint64_t> rooms;    ///< offset of the values of each dataset

  /// That of a file whose varying values are marks; none if it does not have each exactly once, or has checksums.
  static std::optional<HeadImage> of(const std::filesystem::path& file, const std::vector<std::string>& marks,
                                     std::vector<std::uint64_t> rooms);
  void set(std::size_t varying, const std::string& value);
  /// Creates the file, or replaces it. Throws FileError.
  void write(const std::filesystem::path& file) const;
};

/// The images of the last few forms.
class HeadImages {
 public:
  /// Null if it is not known; otherwise the image, or none if the form has no image.
  const std::optional<HeadImage>* find(const std::string& form) const;
  void keep(const std::string& form, std::optional<HeadImage> image);

 private:
  struct Entry {
    std::string form;
    std::optional<HeadImage> image;
  };
  std::array<Entry, 4> entries_;
  std::size_t next_ = 0;
};

}  // namespace tushar::output
