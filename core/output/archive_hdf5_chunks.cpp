#include "core/output/archive_hdf5_chunks.hpp"

#include <algorithm>
#include <cstring>
#include <functional>
#include <numeric>

#include "core/base/error.hpp"
#include "core/output/archive_hdf5_handles.hpp"

namespace tushar::output {

namespace {

void refuseUnless(bool done) {
  if (!done) throw FileError("cannot compress: " + hdf5Reason());
}

}  // namespace

PackingUse& PackingUse::operator+=(const PackingUse& other) {
  bytes += other.bytes;
  packed += other.packed;
  packing += other.packing;
  writing += other.writing;
  return *this;
}

Extents fullShape(const std::vector<std::uint64_t>& shape, const Array& array) {
  Extents full(shape.begin(), shape.end());
  if (array.components > 1) full.push_back(static_cast<unsigned long long>(array.components));
  return full;
}

unsigned long long numbersOf(const Extents& shape) {
  return std::accumulate(shape.begin(), shape.end(), 1ULL, std::multiplies<>());
}

Extents chunkOf(const Extents& shape) {
  Extents chunk(shape.size());
  unsigned long long room = 1 << 17;
  for (std::size_t k = shape.size(); k-- > 0;) {
    chunk[k] = std::clamp<unsigned long long>(room, 1, shape[k]);
    room /= chunk[k];
  }
  return chunk;
}

Chunks::Chunks(Extents shape) : shape_(std::move(shape)), along_(shape_.size()) {
  if (numbersOf(shape_) == 0) {
    count_ = 0;
    return;
  }
  chunk_ = chunkOf(shape_);
  for (std::size_t k = 0; k < shape_.size(); ++k) {
    along_[k] = (shape_[k] + chunk_[k] - 1) / chunk_[k];
    count_ *= along_[k];
  }
}

Extents Chunks::corner(std::size_t chunk) const {
  Extents first(shape_.size());
  for (std::size_t k = shape_.size(); k-- > 0; chunk /= along_[k]) first[k] = chunk % along_[k] * chunk_[k];
  return first;
}

Piece Chunks::entries(std::size_t chunk, int components) const {
  const Extents first = corner(chunk);
  unsigned long long before = 0, count = 1;
  for (std::size_t k = 0; k < shape_.size(); ++k) {
    before = before * shape_[k] + first[k];
    count *= std::min(chunk_[k], shape_[k] - first[k]);
  }
  const auto numbers = static_cast<unsigned long long>(components);
  return {before / numbers, count / numbers};
}

struct ChunkPacker::State {
  static constexpr std::size_t growth = std::size_t{4} << 20;

  hid_t file = -1, data = -1;
  int level = 0, made = 0;
  hid_t memory = -1;
  std::vector<std::byte> whole;  ///< the whole chunk, padded with zeros at the end of the dataset

  void closeData() {
    if (data >= 0) H5Dclose(data);
    data = -1;
  }
};

ChunkPacker::ChunkPacker(int compression) : state_(std::make_unique<State>()) {
  const Silence silence;
  state_->level = compression;
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  refuseUnless(H5Pset_fapl_core(access, State::growth, false) >= 0);
  state_->file = H5Fcreate("chunks", H5F_ACC_TRUNC, H5P_DEFAULT, access);
  refuseUnless(state_->file >= 0);
}

ChunkPacker::~ChunkPacker() {
  const Silence silence;
  state_->closeData();
  if (state_->file >= 0) H5Fclose(state_->file);
}

void ChunkPacker::begin(const Array::Values& type, const Extents& shape, bool asFloat) {
  const Silence silence;
  state_->closeData();
  const Extents chunk = chunkOf(shape);
  const Handle space(H5Screate_simple(static_cast<int>(chunk.size()), chunk.data(), nullptr), H5Sclose);
  const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  refuseUnless(setPacking(creation, chunk, state_->level));
  std::visit(
      [&](const auto& values) {
        using Number = typename std::decay_t<decltype(values)>::value_type;
        const std::string name = std::to_string(state_->made++);
        state_->memory = memoryType(Number{});
        state_->data = H5Dcreate2(state_->file, name.c_str(), fileType(Number{}, asFloat), space, H5P_DEFAULT, creation,
                                  H5P_DEFAULT);
        state_->whole.resize(numbersOf(chunk) * sizeof(Number));
      },
      type);
  refuseUnless(state_->data >= 0);
}

PackedChunk ChunkPacker::pack(std::span<const std::byte> entries) {
  const Silence silence;
  std::copy(entries.begin(), entries.end(), state_->whole.begin());
  std::fill(state_->whole.begin() + static_cast<std::ptrdiff_t>(entries.size()), state_->whole.end(), std::byte{0});
  refuseUnless(H5Dwrite(state_->data, state_->memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, state_->whole.data()) >= 0);
  refuseUnless(H5Dflush(state_->data) >= 0);
  const Extents first(
      static_cast<std::size_t>(H5Sget_simple_extent_ndims(Handle(H5Dget_space(state_->data), H5Sclose))), 0);
  hsize_t size = 0;
  refuseUnless(H5Dget_chunk_storage_size(state_->data, first.data(), &size) >= 0);
  PackedChunk packed;
  packed.bytes.resize(size);
  refuseUnless(H5Dread_chunk(state_->data, H5P_DEFAULT, first.data(), &packed.skipped, packed.bytes.data()) >= 0);
  return packed;
}

}  // namespace tushar::output
