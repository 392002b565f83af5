#include "core/output/shared_hdf5.hpp"

#include <chrono>
#include <cstring>
#include <deque>
#include <exception>
#include <mutex>
#include <optional>
#include <utility>
#include <variant>

#include "core/base/mpi_together.hpp"
#include "core/output/archive_hdf5_chunks.hpp"

namespace tushar::output {

namespace {

bool isNarrowed(const Storage& how, const Array& array) {
  return how.doubleAsFloat && std::holds_alternative<std::vector<double>>(array.values);
}

/// Measures the time [s] from its construction to its destruction, and adds it to a number.
class Stopwatch {
 public:
  explicit Stopwatch(double& seconds) : seconds_(seconds) {}
  ~Stopwatch() { seconds_ += std::chrono::duration<double>(Clock::now() - started_).count(); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  double& seconds_;
  Clock::time_point started_ = Clock::now();
};

/// A file that rank 0 has created and whose values are written later.
struct Begun {
  std::shared_ptr<Hdf5File> file;
  std::vector<std::uint64_t> rooms;  ///< the offset of each dataset that has a source
};

/// Whether a file is so small that an image of it may be kept in memory.
bool isSmall(const Storage& how, const std::vector<Dataset>& datasets) {
  constexpr std::uint64_t most = std::uint64_t{1} << 20;
  std::uint64_t bytes = 0;
  for (const Dataset& dataset : datasets) bytes += bytesOf(dataset.array);
  return bytes <= most && how.compression == 0 && !how.doubleAsFloat;
}

/// Writes the header, and makes the datasets without their values; returns the offset of each dataset.
std::vector<std::uint64_t> roomsIn(Hdf5File& file, const std::function<void(Hdf5File&)>& header,
                                   const std::vector<Dataset>& datasets) {
  header(file);
  std::vector<std::uint64_t> rooms;
  for (const Dataset& dataset : datasets) rooms.push_back(file.room(dataset.name, dataset.array, dataset.shape));
  return rooms;
}

/// Makes a small file by copying an image of a file of the same form. HDF5 makes the first file of each form, from
/// which the image is taken. Returns false if the form has no image.
bool beginFromImage(Begun& begun, const std::filesystem::path& path, const Storage& how,
                    const std::function<void(Hdf5File&)>& header, const std::vector<Dataset>& datasets) {
  static HeadImages images;
  static std::mutex mutex;
  const std::lock_guard alone(mutex);
  HeadDraft draft(HeadDraft::Use::collects);
  Hdf5File collector(draft);
  roomsIn(collector, header, datasets);
  draft.share(how.describes ? "described" : "");
  if (!images.find(draft.form())) {
    HeadDraft marked(HeadDraft::Use::marks);
    Hdf5File file(path, false, 0, how.describes, &marked);
    std::vector<std::uint64_t> rooms = roomsIn(file, header, datasets);
    file.close();
    images.keep(draft.form(), HeadImage::of(path, marked.values(), std::move(rooms)));
  }
  const std::optional<HeadImage>& kept = *images.find(draft.form());
  if (!kept) return false;
  HeadImage image = *kept;
  for (std::size_t k = 0; k < draft.values().size(); ++k) image.set(k, draft.values()[k]);
  for (std::size_t k = 0; k < datasets.size(); ++k) {
    if (datasets[k].array.source)
      begun.rooms.push_back(image.rooms[k]);
    else
      std::visit(
          [&](const auto& values) {
            if (!values.empty())
              std::memcpy(image.bytes.data() + image.rooms[k], values.data(), values.size() * sizeof(values[0]));
          },
          datasets[k].array.values);
  }
  image.write(path);
  return true;
}

void begin(Begun& begun, const std::filesystem::path& path, const Storage& how,
           const std::function<void(Hdf5File&)>& header, const std::vector<Dataset>& datasets) {
  if (isSmall(how, datasets) && beginFromImage(begun, path, how, header, datasets)) return;
  begun.file = std::make_shared<Hdf5File>(path, how.doubleAsFloat, how.compression, how.describes);
  header(*begun.file);
  for (const Dataset& dataset : datasets) {
    if (dataset.array.source)
      begun.rooms.push_back(begun.file->room(dataset.name, dataset.array, dataset.shape));
    else
      begun.file->dataset(dataset.name, dataset.array, dataset.shape);
  }
  if (how.compression == 0) begun.file->close();
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

}  // namespace

/// Compresses datasets. Each writer packs one chunk at a time, and rank 0 writes the chunks to the file in order:
/// immediately if it is the only writer, otherwise when all chunks of a round are packed.
class FileInFlight::Chunks {
 public:
  /// The file must be open on rank 0.
  Chunks(const Writers& writers, Behind& behind, const Storage& how, std::shared_ptr<Hdf5File> file)
      : writers_(writers),
        behind_(behind),
        how_(how),
        file_(std::move(file)),
        outbox_(writers.ranks()),
        use_(std::make_shared<PackingUse>()),
        packer_(std::make_shared<std::optional<ChunkPacker>>()) {
    if (writers.mine() >= 0) behind_.put({}, [packer = packer_, level = how.compression] { packer->emplace(level); });
  }

  void add(const Dataset& dataset) {
    const Extents shape = fullShape(dataset.shape, dataset.array);
    const output::Chunks chunks(shape);
    if (chunks.count() == 0) return;
    if (writers_.mine() >= 0)
      behind_.put({}, [packer = packer_, values = dataset.array.values, shape,
                       asFloat = isNarrowed(how_, dataset.array)] { (*packer)->begin(values, shape, asFloat); });
    const auto most = static_cast<std::size_t>(writers_.count());
    Pieces pieces(writers_);
    for (std::size_t first = 0; first < chunks.count(); first += most) {
      if (rounds_.size() * largestChunk > behind_.most()) placeNext();
      addRound(dataset, chunks, first, pieces);
    }
  }

  PackingUse use() const {
    PackingUse all = *use_;
    return all += placing_;
  }

  void finish(const mpi::Communicator& ranks) {
    while (!rounds_.empty()) placeNext();
    mpi::together(ranks, [&] {
      behind_.wait();
      if (failure_) std::rethrow_exception(failure_);
      if (file_) file_->close();
    });
  }

 private:
  static constexpr std::size_t largestChunk = std::size_t{1} << 20;  ///< largest size of a chunk [bytes]

  /// One chunk of the same dataset for each writer.
  struct Round {
    std::string dataset;
    std::vector<Extents> corners;
    std::shared_ptr<PackedChunk> mine;
    long job;  ///< number of the job that packs the chunk
  };

  /// Packs the entries of a chunk; `share` is the ratio of the size of the numbers in the file to their size in memory.
  static PackedChunk packed(ChunkPacker& packer, std::span<const std::byte> entries, double share, PackingUse& use) {
    const Stopwatch watch(use.packing);
    PackedChunk chunk = packer.pack(entries);
    use.bytes += share * static_cast<double>(entries.size());
    use.packed += static_cast<double>(chunk.bytes.size());
    return chunk;
  }

  static void place(Hdf5File& file, const Round& round, std::size_t writer, const PackedChunk& chunk, PackingUse& use) {
    const Stopwatch watch(use.writing);
    file.chunk(round.dataset, round.corners[writer], chunk.skipped, chunk.bytes);
  }

  void addRound(const Dataset& dataset, const output::Chunks& chunks, std::size_t first, Pieces& pieces) {
    Round round{dataset.name, {}, std::make_shared<PackedChunk>(), 0};
    std::vector<Piece> of(static_cast<std::size_t>(writers_.count()));
    for (std::size_t k = 0; k < of.size() && first + k < chunks.count(); ++k) {
      of[k] = chunks.entries(first + k, dataset.array.components);
      round.corners.push_back(chunks.corner(first + k));
    }
    const std::size_t mine = writers_.mine() < 0 ? 0 : of[writers_.mine()].count * entryBytes(dataset.array);
    std::vector<std::byte> buffer;
    if (mine > 0) buffer = behind_.buffer(mine);
    const std::span<const std::byte> entries = pieces.bring(dataset.array, of, buffer);
    const bool isOnly = writers_.count() == 1;
    const double share = isNarrowed(how_, dataset.array) ? .5 : 1;
    if (mine > 0)
      round.job = behind_.put(std::move(buffer),
                              [packer = packer_, use = use_, file = isOnly ? file_ : nullptr, entries, round, share] {
                                *round.mine = packed(**packer, entries, share, *use);
                                if (file) place(*file, round, 0, *round.mine, *use);
                              });
    if (!isOnly) rounds_.push_back(std::move(round));
  }

  /// Sends the chunks of a round to rank 0, which writes them to the file.
  void placeNext() {
    const Round round = std::move(rounds_.front());
    rounds_.pop_front();
    behind_.waitFor(round.job);
    const std::vector<PackedChunk> chunks = gathered(std::move(*round.mine));
    try {
      for (std::size_t k = 0; k < chunks.size() && !failure_; ++k)
        if (!chunks[k].bytes.empty()) place(*file_, round, k, chunks[k], placing_);
    } catch (...) {
      failure_ = std::current_exception();  // the others wait for this rank
    }
  }

  /// Returns the chunks of all writers, on rank 0.
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
  Behind& behind_;
  Storage how_;
  std::shared_ptr<Hdf5File> file_;
  mpi::Outbox outbox_;
  std::shared_ptr<PackingUse> use_;  ///< time and size of compression, recorded by the jobs
  PackingUse placing_;               ///< time spent by this thread on writing chunks to the file
  std::shared_ptr<std::optional<ChunkPacker>> packer_;
  std::deque<Round> rounds_;  ///< rounds whose chunks are not yet in the file
  std::exception_ptr failure_;
};

FileInFlight::FileInFlight(const Writers& writers, Behind& behind, const std::filesystem::path& file,
                           const Storage& how, const std::function<void(Hdf5File&)>& header,
                           const std::vector<Dataset>& datasets) {
  Begun begun;
  writers.ranks().onFirst([&] { begin(begun, file, how, header, datasets); });
  if (how.compression == 0) {
    const std::vector<Slab> slabs = slabsOf(writers, how, datasets, begun.rooms);
    for (const Slab& slab : slabs) places_.push_back(rangeOf(slab));
    slabs_.emplace(writers, behind, file, slabs);
    return;
  }
  chunks_ = std::make_unique<Chunks>(writers, behind, how, std::move(begun.file));
  for (const Dataset& dataset : datasets)
    if (dataset.array.source) chunks_->add(dataset);
}

FileInFlight::~FileInFlight() = default;

PackingUse FileInFlight::packing() const { return chunks_ ? chunks_->use() : PackingUse{}; }

void FileInFlight::finish(const mpi::Communicator& ranks) { slabs_ ? slabs_->finish(ranks) : chunks_->finish(ranks); }

std::vector<ByteRange> writeTogether(const Writers& writers, const std::filesystem::path& file, const Storage& how,
                                     const std::function<void(Hdf5File&)>& header,
                                     const std::vector<Dataset>& datasets) {
  Behind atOnce;
  FileInFlight written(writers, atOnce, file, how, header, datasets);
  written.finish(writers.ranks());
  return written.places();
}

}  // namespace tushar::output
