#include "core/output/archive_hdf5.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cstring>
#include <functional>
#include <limits>
#include <numeric>
#include <system_error>
#include <type_traits>

#include "core/base/error.hpp"
#include "core/output/archive_hdf5_chunks.hpp"
#include "core/output/archive_hdf5_handles.hpp"

namespace tushar::output {

std::string hdf5Version() {
  unsigned major = 0, minor = 0, release = 0;
  H5get_libversion(&major, &minor, &release);
  return fmt::format("{}.{}.{}", major, minor, release);
}

namespace {

hid_t fileTypeLike(const Array::Values& type) {
  return std::visit([](const auto& all) { return fileType(typename std::decay_t<decltype(all)>::value_type{}, false); },
                    type);
}

/// Moves to the start of the next piece: along the axis that varies fastest if there is one, otherwise along the next
/// axis.
void advance(std::vector<hsize_t>& first, const std::vector<hsize_t>& piece, const std::vector<hsize_t>& shape) {
  for (std::size_t k = shape.size(); k-- > 0;) {
    first[k] += piece[k];
    if (first[k] < shape[k]) return;
    first[k] = 0;
  }
}

bool setCompression(hid_t creation, const Extents& shape, int level) {
  return level <= 0 || numbersOf(shape) == 0 || setPacking(creation, chunkOf(shape), level);
}

Handle parentsMade() {
  const hid_t links = H5Pcreate(H5P_LINK_CREATE);
  H5Pset_create_intermediate_group(links, 1);
  return {links, H5Pclose};
}

/// Creation properties of a dataset that do not store its time of creation, so that equal content gives equal files.
Handle withoutTimes() {
  const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
  H5Pset_obj_track_times(creation, false);
  return {creation, H5Pclose};
}

template <class Extent>
Handle spaceOf(const std::vector<Extent>& shape) {
  const std::vector<hsize_t> extent(shape.begin(), shape.end());
  return {H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr), H5Sclose};
}

Handle vectorSpace(hsize_t size) { return {H5Screate_simple(1, &size, nullptr), H5Sclose}; }
Handle scalarSpace() { return {H5Screate(H5S_SCALAR), H5Sclose}; }

/// The numbers 0, 1, 2, …, generated while they are written.
class Sequence : public Source {
 public:
  explicit Sequence(std::size_t count) : count_(count) {}
  std::size_t entries() const override { return count_; }
  void read(std::size_t first, std::size_t count, std::byte* to) const override {
    for (std::uint64_t k = first; k < first + count; ++k, to += sizeof(k)) std::memcpy(to, &k, sizeof(k));
  }

 private:
  std::size_t count_;
};

/// Selects the section of a dataset that a part shows.
void choose(hid_t space, const VirtualPart& part) {
  const std::size_t axes = part.source.size();
  if (axes > part.extent.size()) return;
  std::vector<hsize_t> from(part.from.begin(), part.from.end());
  from.resize(axes, 0);
  const std::vector<hsize_t> extent(part.extent.end() - static_cast<std::ptrdiff_t>(axes), part.extent.end());
  H5Sselect_hyperslab(space, H5S_SELECT_SET, from.data(), nullptr, extent.data(), nullptr);
}

/// The largest number of parts in one virtual dataset. It is limited because HDF5 keeps several copies of each part in
/// memory until the file is closed: about 2.6 kB per part (HDF5 1.10, measured with a heap profiler). With more parts,
/// the dataset shows further virtual datasets of the same file, each of which shows at most this number of parts.
constexpr std::size_t mostParts = 256;

/// Returns the end of the parts that one virtual dataset shows; parts that begin at the same entry stay together.
std::size_t endOfRun(const std::vector<VirtualPart>& parts, std::size_t begin) {
  std::size_t end = std::min(begin + mostParts, parts.size());
  while (end < parts.size() && parts[end].first[0] == parts[end - 1].first[0]) ++end;
  return end;
}

/// The type of a dataset of the file.
Handle typeIn(hid_t file, const std::string& dataset) {
  const Handle data(H5Dopen2(file, dataset.c_str(), H5P_DEFAULT), H5Dclose);
  return {H5Dget_type(data), H5Tclose};
}

}  // namespace

/// Returns `result`, which a function of HDF5 has returned. Throws FileError if the result, or the disk behind it,
/// reports a failure.
template <class Result>
Result Hdf5File::checked(Result result, const std::string& what) const {
  if (result >= 0 && failure_.error == 0) return result;
  throw FileError(fmt::format("cannot write {} '{}': {}", what, path_.string(),
                              failure_.error ? std::generic_category().message(failure_.error) : hdf5Reason()));
}

Hdf5File::Hdf5File(std::filesystem::path path, bool doubleAsFloat, int compression, bool describes, HeadDraft* draft)
    : path_(std::move(path)),
      double_as_float_(doubleAsFloat),
      compression_(compression),
      describes_(describes),
      draft_(draft) {
  if (draft_ && draft_->collects()) return;
  const Silence silence;
  const Handle access(diskAccess(failure_), H5Pclose);
  file_ = checked(H5Fcreate(path_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access), "the file");
}

Hdf5File::~Hdf5File() {
  const Silence silence;
  if (file_ >= 0) H5Fclose(file_);
}

/// If a draft collects the content instead of a file, adds a text to its form and returns true.
bool Hdf5File::isDrafted(const std::string& text) const {
  if (!draft_ || !draft_->collects()) return false;
  draft_->share(text);
  return true;
}

/// Like the function above, for a number by which files may differ; the draft records the number, or replaces it by a
/// mark.
template <class Number>
bool Hdf5File::isDrafted(const std::string& object, const char* name, Number& value) const {
  const bool collects = isDrafted(object + " " + name);
  if (draft_) draft_->vary(&value, sizeof value);
  return collects;
}

void Hdf5File::group(const std::string& name) {
  if (isDrafted("group " + name)) return;
  const Silence silence;
  const Handle links = parentsMade();
  const Handle made(H5Gcreate2(file_, name.c_str(), links, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  checked<hid_t>(made, name + " in");
}

/// Makes a dataset, which the caller must close.
Hdf5File::Id Hdf5File::makeDataset(const std::string& name, const Array& array, const Shape& shape, bool asFloat,
                                   Id creation) {
  const Handle space = spaceOf(shape);
  const Handle links = parentsMade();
  assert(static_cast<hsize_t>(H5Sget_simple_extent_npoints(space)) == array.entries() * array.components);
  const hid_t type = std::visit(
      [&](const auto& values) { return fileType(typename std::decay_t<decltype(values)>::value_type{}, asFloat); },
      array.values);
  return checked(H5Dcreate2(file_, name.c_str(), type, space, links, creation, H5P_DEFAULT), name + " in");
}

void Hdf5File::dataset(const std::string& name, const Array& array, const std::vector<std::uint64_t>& shape,
                       Precision precision) {
  if (isDrafted(formOf(name, array, shape) + valuesIn(array))) return;
  const Silence silence;
  const Shape full = fullShape(shape, array);
  const Handle creation = withoutTimes();
  checked(setCompression(creation, full, compression_) ? 0 : -1,
          name + (compression_ > 0 ? ", compressed, in" : " in"));
  const bool asFloat = double_as_float_ && precision == Precision::asAsked;
  const Handle data(makeDataset(name, array, full, asFloat, creation), H5Dclose);
  std::visit(
      [&](const auto& values) {
        using Number = typename std::decay_t<decltype(values)>::value_type;
        array.source ? writePieces<Number>(data, array, full, name) : writeValues(data, values, name);
      },
      array.values);
  describe(name, array);
}

std::uint64_t Hdf5File::room(const std::string& name, const Array& array, const std::vector<std::uint64_t>& shape) {
  if (isDrafted(formOf(name, array, shape))) return 0;
  const Silence silence;
  const Shape full = fullShape(shape, array);
  const Handle creation = withoutTimes();
  checked(setCompression(creation, full, compression_) ? 0 : -1,
          name + (compression_ > 0 ? ", compressed, in" : " in"));
  if (compression_ <= 0) {
    H5Pset_alloc_time(creation, H5D_ALLOC_TIME_EARLY);
    H5Pset_fill_time(creation, H5D_FILL_TIME_NEVER);
  }
  const Handle data(makeDataset(name, array, full, double_as_float_, creation), H5Dclose);
  describe(name, array);
  if (compression_ > 0 || array.entries() == 0) return 0;
  const haddr_t offset = H5Dget_offset(data);
  checked(offset == HADDR_UNDEF ? -1 : 0, name + " in");
  return offset;
}

void Hdf5File::describe(const std::string& dataset, const Array& array) {
  if (!describes_) return;
  attribute(dataset, "unit", array.unit);
  attribute(dataset, "description", array.description);
}

void Hdf5File::chunk(const std::string& name, const std::vector<unsigned long long>& corner, std::uint32_t skipped,
                     std::span<const std::byte> bytes) {
  const Silence silence;
  const Handle data(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
  checked(H5Dwrite_chunk(data, H5P_DEFAULT, skipped, corner.data(), bytes.size(), bytes.data()), name + " in");
}

template <class Number>
void Hdf5File::writeValues(Id data, const std::vector<Number>& values, const std::string& what) {
  checked(H5Dwrite(data, memoryType(Number{}), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), what + " in");
}

/// Writes the values piece by piece; each piece is a box that is contiguous in the file.
template <class Number>
void Hdf5File::writePieces(Id data, const Array& array, const Shape& shape, const std::string& what) {
  if (array.entries() == 0) return;
  const Handle space(H5Dget_space(data), H5Sclose);
  const std::vector<hsize_t> most = chunkOf(shape);
  std::vector<hsize_t> first(shape.size(), 0), extent(shape.size());
  piece_.resize(std::max<std::size_t>(piece_.size(), numbersOf(most) * sizeof(Number)));
  for (std::size_t read = 0; read < array.entries();) {
    for (std::size_t k = 0; k < shape.size(); ++k) extent[k] = std::min(most[k], shape[k] - first[k]);
    const std::size_t entries = numbersOf(extent) / array.components;
    array.source->read(read, entries, piece_.data());
    const Handle memory = vectorSpace(numbersOf(extent));
    H5Sselect_hyperslab(space, H5S_SELECT_SET, first.data(), nullptr, extent.data(), nullptr);
    checked(H5Dwrite(data, memoryType(Number{}), memory, space, H5P_DEFAULT, piece_.data()), what + " in");
    read += entries;
    advance(first, most, shape);
  }
}

void Hdf5File::text(const std::string& name, const std::string& value) {
  constexpr std::size_t least = 16;  // a shorter mark may be found elsewhere
  std::string written = value;
  const bool collects = isDrafted("text " + name + (value.size() < least ? " " + value : ""));
  if (draft_ && value.size() >= least) draft_->vary(written.data(), written.size());
  if (collects) return;
  const Silence silence;
  const Handle links = parentsMade(), space = scalarSpace(), type = stringType();
  const Handle creation = withoutTimes();
  const Handle data(H5Dcreate2(file_, name.c_str(), type, space, links, creation, H5P_DEFAULT), H5Dclose);
  checked<hid_t>(data, name + " in");
  const char* characters = written.c_str();
  checked(H5Dwrite(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, &characters), name + " in");
}

/// Makes one virtual dataset that shows all parts.
void Hdf5File::showParts(const std::string& name, const Array::Values& type, const std::vector<std::uint64_t>& shape,
                         std::span<const VirtualPart> parts) {
  const Handle space = spaceOf(shape), links = parentsMade(), creation = withoutTimes();
  for (const VirtualPart& part : parts) {
    const std::vector<hsize_t> first(part.first.begin(), part.first.end());
    const std::vector<hsize_t> extent(part.extent.begin(), part.extent.end());
    const Handle source = spaceOf(part.source);
    choose(source, part);
    H5Sselect_hyperslab(space, H5S_SELECT_SET, first.data(), nullptr, extent.data(), nullptr);
    checked(H5Pset_virtual(creation, space, part.file.c_str(), part.dataset.c_str(), source), name + " in");
  }
  H5Sselect_all(space);
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const bool isDouble = std::holds_alternative<std::vector<double>>(type);
  if (isDouble) H5Pset_fill_value(creation, H5T_NATIVE_DOUBLE, &nan);
  // Opening a dataset of many parts takes as long as making it, and only integers of this file may have another type.
  const bool hasOwnType = !isDouble && !parts.empty() && parts.front().file == ".";
  const Handle kept = hasOwnType ? typeIn(file_, parts.front().dataset) : Handle(H5Tcopy(fileTypeLike(type)), H5Tclose);
  const Handle data(H5Dcreate2(file_, name.c_str(), kept, space, links, creation, H5P_DEFAULT), H5Dclose);
  checked<hid_t>(data, name + " in");
  shown_ += parts.size();
}

/// Reopens the file, discarding its contents: HDF5 keeps the parts of all virtual datasets as long as their file is
/// open.
void Hdf5File::reopen() {
  const Handle access(diskAccess(failure_), H5Pclose);
  close();
  file_ = checked(H5Fopen(path_.c_str(), H5F_ACC_RDWR, access), "the file");
  shown_ = 0;
}

void Hdf5File::virtualDataset(const std::string& name, const Array::Values& type,
                              const std::vector<std::uint64_t>& shape, const std::vector<VirtualPart>& parts) {
  const Silence silence;
  std::vector<VirtualPart> runs;
  if (shown_ + parts.size() > mostParts) reopen();
  for (std::size_t begin = 0, end; parts.size() > mostParts && begin < parts.size(); begin = end) {
    end = endOfRun(parts, begin);
    std::vector<VirtualPart> run(parts.begin() + static_cast<std::ptrdiff_t>(begin),
                                 parts.begin() + static_cast<std::ptrdiff_t>(end));
    std::vector<std::uint64_t> whole = shape, corner(shape.size(), 0);
    corner[0] = run.front().first[0];
    whole[0] = run.back().first[0] + run.back().extent[0] - corner[0];
    for (VirtualPart& part : run) part.first[0] -= corner[0];
    const std::string own = fmt::format("/runs{}/{}", name, runs.size());
    showParts(own, type, whole, run);
    reopen();
    runs.push_back({".", own, whole, corner, whole});
  }
  showParts(name, type, shape, runs.empty() ? parts : runs);
}

void Hdf5File::sequence(const std::string& name, std::uint64_t count) {
  const Silence silence;
  const Handle space = vectorSpace(count), links = parentsMade(), creation = withoutTimes();
  const Handle data(H5Dcreate2(file_, name.c_str(), H5T_STD_I64LE, space, links, creation, H5P_DEFAULT), H5Dclose);
  checked<hid_t>(data, name + " in");
  const Array numbers{name, "", "", 1, std::vector<std::uint64_t>{}, std::make_shared<Sequence>(count)};
  writePieces<std::uint64_t>(data, numbers, {count}, name);
}

void Hdf5File::equalBytes(const std::string& name, std::uint8_t value, std::uint64_t count) {
  const Silence silence;
  const Handle space = vectorSpace(count), links = parentsMade(), creation = withoutTimes();
  H5Pset_fill_value(creation, H5T_NATIVE_UINT8, &value);
  const Handle data(H5Dcreate2(file_, name.c_str(), H5T_STD_U8LE, space, links, creation, H5P_DEFAULT), H5Dclose);
  checked<hid_t>(data, name + " in");
}

void Hdf5File::writeAttribute(const std::string& object, const char* name, Id space, Id type, const void* data) {
  const Silence silence;
  const Handle made(H5Acreate_by_name(file_, object.c_str(), name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                    H5Aclose);
  const std::string what = fmt::format("attribute {} of {} in", name, object);
  checked<hid_t>(made, what);
  checked(H5Awrite(made, type, data), what);
}

void Hdf5File::attribute(const std::string& object, const char* name, double value) {
  if (isDrafted(object, name, value)) return;
  writeAttribute(object, name, scalarSpace(), H5T_NATIVE_DOUBLE, &value);
}

void Hdf5File::attribute(const std::string& object, const char* name, int value) {
  if (isDrafted(object, name, value)) return;
  writeAttribute(object, name, scalarSpace(), H5T_NATIVE_INT, &value);
}

void Hdf5File::attribute(const std::string& object, const char* name, std::uint64_t value) {
  if (isDrafted(object, name, value)) return;
  writeAttribute(object, name, scalarSpace(), H5T_NATIVE_UINT64, &value);
}

void Hdf5File::attribute(const std::string& object, const char* name, const std::string& value) {
  if (isDrafted(object + " " + name + " " + value)) return;
  const char* text = value.c_str();
  writeAttribute(object, name, scalarSpace(), stringType(), &text);
}

void Hdf5File::attribute(const std::string& object, const char* name, const Vec3& value) {
  if (isDrafted(fmt::format("{} {} {} {} {}", object, name, value[0], value[1], value[2]))) return;
  writeAttribute(object, name, vectorSpace(3), H5T_NATIVE_DOUBLE, value.data());
}

void Hdf5File::attribute(const std::string& object, const char* name, const Index3& value) {
  if (isDrafted(fmt::format("{} {} {} {} {}", object, name, value[0], value[1], value[2]))) return;
  writeAttribute(object, name, vectorSpace(3), H5T_NATIVE_INT, value.at.data());
}

void Hdf5File::attribute(const std::string& object, const char* name, const std::vector<double>& value) {
  writeAttribute(object, name, vectorSpace(value.size()), H5T_NATIVE_DOUBLE, value.data());
}

void Hdf5File::attribute(const std::string& object, const char* name, const std::vector<int>& value) {
  writeAttribute(object, name, vectorSpace(value.size()), H5T_NATIVE_INT, value.data());
}

void Hdf5File::fixedText(const std::string& object, const char* name, const std::string& value) {
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, value.size());
  writeAttribute(object, name, scalarSpace(), type, value.data());
}

void Hdf5File::close() {
  const Silence silence;
  checked(H5Fclose(std::exchange(file_, -1)), "the file");
}

}  // namespace tushar::output
