#include "core/output/archive_hdf5_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "core/base/error.hpp"
#include "core/output/archive_hdf5_handles.hpp"

namespace tushar::output {

namespace {

herr_t collect(hid_t, const char* name, const H5L_info_t*, void* names) {
  static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  return 0;
}

/// An empty array with the type of the values in the file.
Array::Values valuesLike(hid_t type) {
  if (H5Tget_class(type) == H5T_FLOAT) return std::vector<double>{};
  if (H5Tget_size(type) == sizeof(std::uint64_t)) return std::vector<std::uint64_t>{};
  return std::vector<std::int32_t>{};
}

template <class Number>
Number typeOfNumber(const std::vector<Number>&) {
  return {};
}

/// Takes ownership of a text allocated by HDF5.
std::string taken(char* characters) {
  const std::string text = characters ? characters : "";
  H5free_memory(characters);
  return text;
}

}  // namespace

/// Returns `result`, which a function of HDF5 has returned. Throws FileError if it reports a failure.
template <class Result>
Result Hdf5Input::checked(Result result, const std::string& what) const {
  if (result >= 0) return result;
  throw FileError(fmt::format("cannot read {} '{}': {}", what, path_.string(), hdf5Reason()));
}

/// An open dataset, its type, and its number of values (the product of its extents).
struct Hdf5Input::Dataset {
  Handle data, space, type;
  std::size_t numbers;

  Dataset(const Hdf5Input& file, const std::string& name)
      : data(file.checked(H5Dopen2(file.file_, name.c_str(), H5P_DEFAULT), name + " of"), H5Dclose),
        space(H5Dget_space(data), H5Sclose),
        type(H5Dget_type(data), H5Tclose),
        numbers(static_cast<std::size_t>(file.checked(H5Sget_simple_extent_npoints(space), name + " of"))) {}
};

Hdf5Input::Hdf5Input(std::filesystem::path path) : path_(std::move(path)) {
  const Silence silence;
  file_ = checked(H5Fopen(path_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), "the file");
}

Hdf5Input::~Hdf5Input() {
  const Silence silence;
  H5Fclose(file_);
}

bool Hdf5Input::has(const std::string& name) const {
  const Silence silence;
  for (std::size_t slash = name.find('/', 1); slash != std::string::npos; slash = name.find('/', slash + 1))
    if (H5Lexists(file_, name.substr(0, slash).c_str(), H5P_DEFAULT) <= 0) return false;
  return H5Lexists(file_, name.c_str(), H5P_DEFAULT) > 0;
}

bool Hdf5Input::isGroup(const std::string& name) const {
  const Silence silence;
  H5G_stat_t found;
  checked(H5Gget_objinfo(file_, name.c_str(), 1, &found), name + " of");
  return found.type == H5G_GROUP;
}

/// Uses a function with the same interface in all versions of HDF5 since 1.6.
std::uint64_t Hdf5Input::placeOf(const std::string& name) const {
  const Silence silence;
  H5G_stat_t found;
  checked(H5Gget_objinfo(file_, name.c_str(), 1, &found), name + " of");
  return (std::uint64_t{found.objno[1]} << 32U) + found.objno[0];
}

std::vector<std::string> Hdf5Input::names(const std::string& group) const {
  std::vector<std::string> all;
  if (!has(group)) return all;
  const Silence silence;
  const Handle open(H5Gopen2(file_, group.c_str(), H5P_DEFAULT), H5Gclose);
  checked<hid_t>(open, group + " of");
  checked(H5Literate(open, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &all), group + " of");
  return all;
}

Array::Values Hdf5Input::dataset(const std::string& name) const {
  const Silence silence;
  const Dataset from(*this, name);
  Array::Values read = valuesLike(from.type);
  std::visit(
      [&](auto& values) {
        using Number = typename std::decay_t<decltype(values)>::value_type;
        values.resize(from.numbers);
        checked(H5Dread(from.data, memoryType(Number{}), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), name + " of");
      },
      read);
  return read;
}

Hdf5Input::Placed Hdf5Input::placed(const std::string& name) const {
  const Silence silence;
  const Dataset from(*this, name);
  Placed placed{valuesLike(from.type), from.numbers};
  const hid_t native = std::visit([](const auto& values) { return memoryType(typeOfNumber(values)); }, placed.type);
  const haddr_t offset = H5Dget_offset(from.data);
  const bool isNative = checked(H5Tequal(from.type, native), name + " of") > 0;
  if (offset != HADDR_UNDEF && isNative) placed.offset = static_cast<std::int64_t>(offset);
  return placed;
}

std::string Hdf5Input::text(const std::string& name) const {
  const Silence silence;
  const Handle data(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
  checked<hid_t>(data, name + " of");
  char* characters = nullptr;
  checked(H5Dread(data, stringType(), H5S_ALL, H5S_ALL, H5P_DEFAULT, &characters), name + " of");
  return taken(characters);
}

void Hdf5Input::readAttribute(const std::string& object, const char* name, Id type, std::size_t numbers,
                              void* data) const {
  const Silence silence;
  const std::string what = fmt::format("attribute {} of {} of", name, object);
  const Handle open(H5Aopen_by_name(file_, object.c_str(), name, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  checked<hid_t>(open, what);
  const Handle space(H5Aget_space(open), H5Sclose);
  if (H5Sget_simple_extent_npoints(space) != static_cast<hssize_t>(numbers))
    throw FileError(fmt::format("cannot read {} '{}': it has the wrong number of components", what, path_.string()));
  checked(H5Aread(open, type, data), what);
}

double Hdf5Input::real(const std::string& object, const char* name) const {
  double value = 0;
  readAttribute(object, name, H5T_NATIVE_DOUBLE, 1, &value);
  return value;
}

int Hdf5Input::integer(const std::string& object, const char* name) const {
  int value = 0;
  readAttribute(object, name, H5T_NATIVE_INT, 1, &value);
  return value;
}

std::uint64_t Hdf5Input::count(const std::string& object, const char* name) const {
  std::uint64_t value = 0;
  readAttribute(object, name, H5T_NATIVE_UINT64, 1, &value);
  return value;
}

std::string Hdf5Input::text(const std::string& object, const char* name) const {
  char* characters = nullptr;
  readAttribute(object, name, stringType(), 1, &characters);
  return taken(characters);
}

Vec3 Hdf5Input::vector(const std::string& object, const char* name) const {
  Vec3 value;
  readAttribute(object, name, H5T_NATIVE_DOUBLE, 3, value.data());
  return value;
}

Index3 Hdf5Input::index(const std::string& object, const char* name) const {
  Index3 value;
  readAttribute(object, name, H5T_NATIVE_INT, 3, value.at.data());
  return value;
}

}  // namespace tushar::output
