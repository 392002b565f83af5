#pragma once

#include <hdf5.h>

#include <cstdint>
#include <mutex>
#include <string>
#include <type_traits>
#include <vector>

namespace tushar::output {

static_assert(std::is_same_v<hid_t, std::int64_t>);

/// Closes an HDF5 id at the end of its scope.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// As long as it exists, HDF5 prints no errors, and no other thread can call HDF5, which is not thread-safe.
class Silence {
 public:
  Silence() : alone_(mutex_) {
    H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Silence() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  static inline std::recursive_mutex mutex_;
  std::lock_guard<std::recursive_mutex> alone_;
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

/// The innermost message of HDF5's error stack.
std::string hdf5Reason();

inline hid_t memoryType(double) { return H5T_NATIVE_DOUBLE; }
inline hid_t memoryType(std::uint64_t) { return H5T_NATIVE_UINT64; }
inline hid_t memoryType(std::int32_t) { return H5T_NATIVE_INT32; }

inline hid_t fileType(double, bool asFloat) { return asFloat ? H5T_IEEE_F32LE : H5T_IEEE_F64LE; }
inline hid_t fileType(std::uint64_t, bool) { return H5T_STD_U64LE; }
inline hid_t fileType(std::int32_t, bool) { return H5T_STD_I32LE; }

/// Sets the compression of the chunks of a dataset; returns false if HDF5 refuses it.
inline bool setPacking(hid_t creation, const std::vector<hsize_t>& chunk, int level) {
  return H5Pset_chunk(creation, static_cast<int>(chunk.size()), chunk.data()) >= 0 && H5Pset_shuffle(creation) >= 0 &&
         H5Pset_deflate(creation, static_cast<unsigned>(level)) >= 0;
}

/// The HDF5 type of a text of any length.
inline Handle stringType() {
  const hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, H5T_VARIABLE);
  H5Tset_cset(type, H5T_CSET_UTF8);
  return {type, H5Tclose};
}

}  // namespace tushar::output
