#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/output/archive_disk.hpp"
#include "core/output/head_image.hpp"
#include "core/output/snapshot.hpp"

namespace tushar::output {

/// The version of HDF5 in use.
std::string hdf5Version();

/// A dataset that is shown as a box of a virtual dataset. `file` is the file that contains it, relative to the folder
/// of the virtual dataset's file, or `.` if both are in the same file.
struct VirtualPart {
  std::string file, dataset;
  std::vector<std::uint64_t> source;  ///< shape of the dataset; the part shown has the size of the box, or is the whole
                                      ///< dataset if that has more axes
  std::vector<std::uint64_t> first, extent;  ///< corner and size of the box
  std::vector<std::uint64_t> from{};         ///< start of the shown section in the dataset; empty: 0
};

/// Precision of real numbers: as chosen when the file was opened, or always 8 bytes.
enum class Precision { asAsked, full };

/// Writes one HDF5 file. It neither needs nor initialises MPI. Each function may throw FileError with the path and the
/// reason: the system's or, if the system gives none, HDF5's innermost error. HDF5 itself prints no errors.
class Hdf5File {
 public:
  /// Creates the file, replacing an existing one. Real numbers are stored in 4 bytes if `doubleAsFloat` is true, and
  /// all values are compressed by gzip at level `compression` if that is above 0. Datasets have attributes only if
  /// `describes` is true. If `draft` is given, it marks the values of attributes and texts by which files may differ.
  Hdf5File(std::filesystem::path path, bool doubleAsFloat, int compression, bool describes = true,
           HeadDraft* draft = nullptr);
  /// Makes no file: `draft` collects the content instead.
  explicit Hdf5File(HeadDraft& draft) : Hdf5File("", false, 0, true, &draft) {}
  /// Closes the file if close() was not called; errors are then lost.
  ~Hdf5File();
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;

  /// Makes a group such as `/particles/gas`, and its parent groups.
  void group(const std::string& name);
  /// Writes an array as a dataset with the attributes unit and description, and makes its parent groups. The shape of
  /// the dataset is `shape`, followed by the number of components if there are several. Values of a source are written
  /// piece by piece.
  void dataset(const std::string& name, const Array& array, const std::vector<std::uint64_t>& shape,
               Precision precision = Precision::asAsked);
  /// Prepares a dataset whose values are written later: allocates contiguous space for them and returns where it starts
  /// in the file. Returns 0 in a compressed file, where each chunk gets its space when it is written.
  std::uint64_t room(const std::string& name, const Array& array, const std::vector<std::uint64_t>& shape);
  /// Writes a packed chunk of a dataset for which space has been allocated; `corner` is the index of its first number,
  /// `skipped` HDF5's mask of filters.
  void chunk(const std::string& name, const std::vector<unsigned long long>& corner, std::uint32_t skipped,
             std::span<const std::byte> bytes);
  /// Writes a text of any length as a dataset, and makes its parent groups.
  void text(const std::string& name, const std::string& value);
  /// Makes a dataset of real numbers, or of integers if `type` has integers, that shows parts of other datasets and
  /// stores no numbers itself. Entries that no part covers are NaN or 0. If it shows parts of this file, it has their
  /// type. `parts` must be sorted by their first entries.
  void virtualDataset(const std::string& name, const Array::Values& type, const std::vector<std::uint64_t>& shape,
                      const std::vector<VirtualPart>& parts);
  /// Writes 0, 1, 2, … as signed integers of 8 bytes.
  void sequence(const std::string& name, std::uint64_t count);
  /// Makes a dataset of `count` equal bytes that takes up no space.
  void equalBytes(const std::string& name, std::uint8_t value, std::uint64_t count);
  /// Sets an attribute of an existing group; `/` is the root group.
  void attribute(const std::string& object, const char* name, double value);
  void attribute(const std::string& object, const char* name, int value);
  void attribute(const std::string& object, const char* name, std::uint64_t value);
  void attribute(const std::string& object, const char* name, const std::string& value);
  void attribute(const std::string& object, const char* name, const Vec3& value);
  void attribute(const std::string& object, const char* name, const Index3& value);
  void attribute(const std::string& object, const char* name, const std::vector<double>& value);
  void attribute(const std::string& object, const char* name, const std::vector<int>& value);
  /// Sets an attribute to a text of fixed length in ASCII.
  void fixedText(const std::string& object, const char* name, const std::string& value);
  /// Writes everything to the disk and closes the file; detects a full disk.
  void close();

 private:
  using Id = std::int64_t;                        ///< HDF5's hid_t
  using Shape = std::vector<unsigned long long>;  ///< vector of HDF5's hsize_t
  template <class Result>
  Result checked(Result result, const std::string& what) const;
  Id makeDataset(const std::string& name, const Array& array, const Shape& shape, bool asFloat, Id creation);
  void showParts(const std::string& name, const Array::Values& type, const std::vector<std::uint64_t>& shape,
                 std::span<const VirtualPart> parts);
  void reopen();
  template <class Number>
  void writeValues(Id data, const std::vector<Number>& values, const std::string& what);
  template <class Number>
  void writePieces(Id data, const Array& array, const Shape& shape, const std::string& what);
  bool isDrafted(const std::string& text) const;
  template <class Number>
  bool isDrafted(const std::string& object, const char* name, Number& value) const;
  void describe(const std::string& dataset, const Array& array);
  void writeAttribute(const std::string& object, const char* name, Id space, Id type, const void* data);

  std::filesystem::path path_;
  bool double_as_float_;
  int compression_;
  bool describes_;
  HeadDraft* draft_;
  DiskFailure failure_;
  Id file_ = -1;
  std::size_t shown_ = 0;         ///< number of parts in virtual datasets since the file was opened
  std::vector<std::byte> piece_;  ///< memory for one piece, reused for the next
};

}  // namespace tushar::output
