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

/// The content of a small file in two parts: a text that describes what files of the same form share, and the numbers
/// and texts by which they differ. An Hdf5File fills a draft instead of writing a file or, with Use::marks, writes a
/// file in which marks replace these numbers and texts.
class HeadDraft {
 public:
  enum class Use { collects, marks };
  explicit HeadDraft(Use use) : use_(use) {}

  bool collects() const { return use_ == Use::collects; }
  /// Adds a text to the description of what files of the same form share.
  void share(const std::string& text) { form_ += text + '\n'; }
  /// Records a number or a text by which files differ, or replaces it by a mark and records the mark.
  void vary(void* bytes, std::size_t size);

  const std::string& form() const { return form_; }
  /// The recorded values or marks.
  const std::vector<std::string>& values() const { return values_; }

 private:
  Use use_;
  std::string form_;
  std::vector<std::string> values_;
};

/// Texts for a form: a dataset without its values, and the values of an array in memory.
std::string formOf(const std::string& name, const Array& array, const std::vector<std::uint64_t>& shape);
std::string valuesIn(const Array& array);

/// The bytes of a small HDF5 file, and the positions at which files of the same form differ. Copying an image is fast,
/// whereas HDF5 takes a millisecond to make a file, which would be most of the time of a run with many small outputs.
struct HeadImage {
  std::vector<char> bytes;
  std::vector<std::uint64_t> varying;  ///< offset of each value
  std::vector<std::uint64_t> rooms;    ///< offset of the values of each dataset

  /// The image of a file that contains marks as its varying values; none if some mark does not occur exactly once, or
  /// if the file has checksums.
  static std::optional<HeadImage> of(const std::filesystem::path& file, const std::vector<std::string>& marks,
                                     std::vector<std::uint64_t> rooms);
  void set(std::size_t varying, const std::string& value);
  /// Creates the file, or replaces it. Throws FileError.
  void write(const std::filesystem::path& file) const;
};

/// The images of the most recent forms.
class HeadImages {
 public:
  /// The image of a form: null if the form is unknown, none if it is known to have no image.
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
