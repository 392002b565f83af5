#include "core/output/shared_hdf5.hpp"

#include <cstring>
#include <exception>
#include <optional>
#include <variant>

#include "core/base/mpi_together.hpp"
#include "core/output/archive_hdf5_chunks.hpp"
#include "core/output/slabs.hpp"

namespace tushar::output {

namespace {

bool isNarrowed(const Storage& how, const Array& array) {
  return how.doubleAsFloat && std::holds_alternative<std::vector<double>>(array.values);
}

/// Compresses datasets: each writer one chunk at a time; the first rank, which has the file, writes the chunks in their
/// order.
class ChunkWriter {
 public:
  ChunkWriter(const Writers& writers, const Storage& how, Hdf5File* file)
      : writers_(writers), how_(how), file_(file), pieces_(writers), outbox_(writers.ranks()) {
    if (writers.mine() >= 0) attempt([&] { packer_.emplace(how.compression); });
  }

  void run(const Dataset& dataset) {
    const Extents shape = fullShape(dataset.shape, dataset.array);
    const Chunks chunks(shape);
    if (chunks.count() == 0) return;
    if (packer_) attempt([&] { packer_->begin(dataset.array, shape, isNarrowed(how_, dataset.array)); });
    const std::size_t most = writers_.count();
    for (std::size_t first = 0; first < chunks.count(); first += most) writeRound(dataset, chunks, first);
  }

  /// Throws what has failed on this rank.
  void check() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  /// Does something unless this rank has failed, and keeps what it throws: the others wait for this rank.
  template <class Action>
  void attempt(Action&& action) {
    if (failure_) return;
    try {
      action();
    } catch (...) {
      failure_ = std::current_exception();
    }
  }

  void writeRound(const Dataset& dataset, const Chunks& chunks, std::size_t first) {
    std::vector<Piece> of(writers_.count());
    for (std::size_t k = 0; k < of.size() && first + k < chunks.count(); ++k)
      of[k] = chunks.entries(first + k, dataset.array.components);
    const std::span<const std::byte> entries = pieces_.bring(dataset.array, of);
    PackedChunk mine;
    if (!entries.empty()) attempt([&] { mine = packer_->pack(entries); });
    for (PackedChunk& chunk : gathered(std::move(mine))) {
      if (!chunk.bytes.empty())
        attempt([&] { file_->chunk(dataset.name, chunks.corner(first), chunk.skipped, chunk.bytes); });
      ++first;
    }
  }

  /// The chunks of all writers, on the first rank.
  std::vector<PackedChunk> gathered(PackedChunk mine) {
    std::vector<PackedChunk> all(file_ ? static_cast<std::size_t>(writers_.count()) : 0);
    std::vector<mpi::Letter> letters;
    if (file_) {
      all.front() = std::move(mine);
    } else if (!mine.bytes.empty()) {
      mpi::append(mine.bytes, &mine.skipped, sizeof(mine.skipped));
      letters.push_back({0, std::move(mine.bytes)});
    }
    mpi::exchange(writers_.ranks(), outbox_, std::move(letters), [&](int from, const mpi::Bytes& bytes) {
      std::size_t writer = 0;
      while (writers_.rankOf(static_cast<int>(writer)) != from) ++writer;
      const std::size_t size = bytes.size() - sizeof(mine.skipped);
      std::memcpy(&all[writer].skipped, bytes.data() + size, sizeof(mine.skipped));
      all[writer].bytes.assign(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
    });
    return all;
  }

  const Writers& writers_;
  const Storage& how_;
  Hdf5File* file_;
  Pieces pieces_;
  mpi::Outbox outbox_;
  std::optional<ChunkPacker> packer_;
  std::exception_ptr failure_;
};

/// A file whose values come later, on the first rank.
struct Begun {
  std::optional<Hdf5File> file;
  std::vector<std::uint64_t> rooms;  ///< where those of each dataset with a source go
};

void begin(Begun& begun, const std::filesystem::path& path, const Storage& how,
           const std::function<void(Hdf5File&)>& header, const std::vector<Dataset>& datasets) {
  Hdf5File& file = begun.file.emplace(path, how.doubleAsFloat, how.compression);
  header(file);
  for (const Dataset& dataset : datasets) {
    if (dataset.array.source)
      begun.rooms.push_back(file.room(dataset.name, dataset.array, dataset.shape));
    else
      file.dataset(dataset.name, dataset.array, dataset.shape);
  }
  if (how.compression == 0) file.close();
}

std::vector<Slab> slabsOf(const Writers& writers, const Storage& how, const std::vector<Dataset>& datasets,
                          const std::vector<std::uint64_t>& roomsOfFirst) {
  const std::vector<std::uint64_t> rooms = mpi::allOf(writers.ranks(), roomsOfFirst);
  std::vector<Slab> slabs;
  for (const Dataset& dataset : datasets)
    if (dataset.array.source)
      slabs.push_back({dataset.name, &dataset.array, rooms[slabs.size()], isNarrowed(how, dataset.array)});
  return slabs;
}

void writeChunks(const Writers& writers, const Storage& how, Hdf5File* file, const std::vector<Dataset>& datasets) {
  ChunkWriter chunks(writers, how, file);
  for (const Dataset& dataset : datasets)
    if (dataset.array.source) chunks.run(dataset);
  mpi::together(writers.ranks(), [&] {
    chunks.check();
    if (file) file->close();
  });
}

}  // namespace

void writeTogether(const Writers& writers, const std::filesystem::path& file, const Storage& how,
                   const std::function<void(Hdf5File&)>& header, const std::vector<Dataset>& datasets) {
  Begun begun;
  writers.ranks().onFirst([&] { begin(begun, file, how, header, datasets); });
  if (how.compression > 0) return writeChunks(writers, how, begun.file ? &*begun.file : nullptr, datasets);
  writeSlabs(writers, file, slabsOf(writers, how, datasets, begun.rooms));
}

}  // namespace tushar::output
