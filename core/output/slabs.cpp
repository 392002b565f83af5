#include "core/output/slabs.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <optional>

#include "core/base/mpi_together.hpp"
#include "core/output/pieces.hpp"
#include "core/output/shared_file.hpp"

namespace tushar::output {

static_assert(std::endian::native == std::endian::little, "files have the bytes of memory");

namespace {

/// Makes 4 bytes of each 8 of real numbers, where they stand.
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

/// Writes one array, all writers a piece of it at a time.
class SlabWriter {
 public:
  SlabWriter(const Writers& writers, SharedFile* file, Pieces& pieces, const Slab& slab)
      : writers_(writers),
        file_(file),
        pieces_(pieces),
        slab_(slab),
        entry_bytes_(entryBytes(*slab.array) / (slab.asFloat ? 2 : 1)),
        all_{slab.offset, slab.offset + slab.array->entries() * entry_bytes_},
        most_(mostOfPiece(writers)) {}

  void run() {
    std::uint64_t longest = 0;
    for (int writer = 0; writer < writers_.count(); ++writer)
      longest = std::max(longest, slabOf(all_, writer, writers_.count()).size());
    for (std::uint64_t done = 0; done < longest; done += most_) writePieces(done);
  }

 private:
  /// The bytes of a writer's slab of which so many are done that are next.
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
    std::span<std::byte> entries = pieces_.bring(*slab_.array, of);
    if (entries.empty()) return;
    if (slab_.asFloat) entries = narrowed(entries);
    const ByteRange bytes = next(writers_.mine(), done);
    const std::uint64_t start = slab_.offset + of[writers_.mine()].first * entry_bytes_;
    file_->write(bytes.first, entries.data() + (bytes.first - start), bytes.size(), slab_.name);
  }

  const Writers& writers_;
  SharedFile* file_;
  Pieces& pieces_;
  const Slab& slab_;
  std::uint64_t entry_bytes_;  ///< in the file
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

void writeSlabs(const Writers& writers, const std::filesystem::path& file, const std::vector<Slab>& slabs) {
  std::optional<SharedFile> mine;
  if (writers.mine() >= 0) mine.emplace(file);
  Pieces pieces(writers);
  for (const Slab& slab : slabs) SlabWriter(writers, mine ? &*mine : nullptr, pieces, slab).run();
  mpi::together(writers.ranks(), [&] {
    if (mine) mine->close();
  });
}

}  // namespace tushar::output
