#include "core/output/archive_hdf5_handles.hpp"

namespace tushar::output {

namespace {

herr_t keepFirst(unsigned, const H5E_error2_t* error, void* kept) {
  auto& text = *static_cast<std::string*>(kept);
  if (text.empty() && error->desc) text = error->desc;
  return 0;
}

}  // namespace

std::string hdf5Reason() {
  std::string text;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keepFirst, &text);
  return text.empty() ? "HDF5 reports no reason" : text;
}

}  // namespace tushar::output
