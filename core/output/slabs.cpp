#include "core/output/slabs.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

#include "core/base/mpi_together.hpp"
#include "core/output/pieces.hpp"

namespace tushar::output {

static_assert(std::endian::native == std::endian::little, "files store numbers as in memory, in little-endian order");

namespace {

/// Converts real numbers from 8 to 4 bytes, in place.
std::span<std::byte> narrowed(std::span<std::byte> numbers) {
  const std::size_t count = numbers.size() / sizeof(double);
  for (std::size_t k = 0; k < count; ++k) {
    double number = 0;
    std::memcpy(&number, numbers.data() + k * sizeof(double), sizeof(double));
    const auto narrow = static_cast<float>(number);
    std::memcpy(numbers.data() + k * sizeof(float), &narrow, sizeof(float));
  }
  return numbers.first(count * sizeof(float));
}

std::uint64_t entryBytesInFile(const Slab& slab) { return entryBytes(*slab.array) / (slab.asFloat ? 2 : 1); }

/// Sends one array to the writers, one piece to each at a time.
class SlabWriter {
 public:
  SlabWriter(const Writers& writers, Behind& behind, std::shared_ptr<SharedFile> file, Pieces& pieces, const Slab& slab)
      : writers_(writers),
        behind_(behind),
        file_(std::move(file)),
        pieces_(pieces),
        slab_(slab),
        entry_bytes_(entryBytesInFile(slab)),
        all_(rangeOf(slab)),
        most_(mostOfPiece(writers)) {}

  void run() {
    std::uint64_t longest = 0;
    for (int writer = 0; writer < writers_.count(); ++writer)
      longest = std::max(longest, slabOf(all_, writer, writers_.count()).size());
    for (std::uint64_t done = 0; done < longest; done += most_) writePieces(done);
  }

 private:
  /// The next bytes of a writer's slab, after the first `done` bytes.
  ByteRange next(int writer, std::uint64_t done) const {
    const ByteRange slab = slabOf(all_, writer, writers_.count());
    const std::uint64_t first = std::min(slab.first + done, slab.last);
    return {first, std::min(first + most_, slab.last)};
  }

  /// The entries that have bytes in a range.
  Piece entriesOf(const ByteRange& bytes) const {
    if (bytes.size() == 0) return {};
    const std::uint64_t first = (bytes.first - slab_.offset) / entry_bytes_;
    return {first, (bytes.last - slab_.offset + entry_bytes_ - 1) / entry_bytes_ - first};
  }

  void writePieces(std::uint64_t done) {
    std::vector<Piece> of;
    for (int writer = 0; writer < writers_.count(); ++writer) of.push_back(entriesOf(next(writer, done)));
    const Piece mine = file_ ? of[writers_.mine()] : Piece{};
    std::vector<std::byte> buffer;
    if (mine.count > 0) buffer = behind_.buffer(mine.count * entryBytes(*slab_.array));
    const std::span<std::byte> entries = pieces_.bring(*slab_.array, of, buffer);
    if (entries.empty()) return;
    const ByteRange bytes = next(writers_.mine(), done);
    const std::uint64_t skipped = bytes.first - (slab_.offset + mine.first * entry_bytes_);
    behind_.put(std::move(buffer), [file = file_, entries, bytes, skipped, asFloat = slab_.asFloat, name = slab_.name] {
      const std::span<const std::byte> all = asFloat ? narrowed(entries) : entries;
      file->write(bytes.first, all.data() + skipped, bytes.size(), name);
    });
  }

  const Writers& writers_;
  Behind& behind_;
  std::shared_ptr<SharedFile> file_;
  Pieces& pieces_;
  const Slab& slab_;
  std::uint64_t entry_bytes_;  ///< size of an entry in the file [bytes]
  ByteRange all_;
  std::uint64_t most_;
};

}  // namespace

ByteRange slabOf(const ByteRange& all, int writer, int writers) {
  const std::uint64_t first = all.first / slabCut, count = (all.last + slabCut - 1) / slabCut - first;
  const auto cut = [&](int before) {
    const std::uint64_t place =
        first + count * static_cast<std::uint64_t>(before) / static_cast<std::uint64_t>(writers);
    return std::clamp(place * slabCut, all.first, all.last);
  };
  return {cut(writer), cut(writer + 1)};
}

ByteRange rangeOf(const Slab& slab) {
  return {slab.offset, slab.offset + slab.array->entries() * entryBytesInFile(slab)};
}

SlabsInFlight::SlabsInFlight(const Writers& writers, Behind& behind, const std::filesystem::path& file,
                             const std::vector<Slab>& slabs)
    : behind_(behind) {
  if (writers.mine() >= 0) file_ = std::make_shared<SharedFile>(file);
  Pieces pieces(writers);
  for (const Slab& slab : slabs) SlabWriter(writers, behind, file_, pieces, slab).run();
}

void SlabsInFlight::finish(const mpi::Communicator& ranks) {
  mpi::together(ranks, [&] {
    behind_.wait();
    if (file_) file_->close();
  });
}

}  // namespace tushar::output
