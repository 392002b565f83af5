#include "core/output/pieces.hpp"

#include <algorithm>
#include <cstring>

#include "core/base/mpi_together.hpp"

namespace tushar::output {

namespace {

/// Appends a number in as few bytes as possible, seven bits to a byte.
void appendShort(mpi::Bytes& bytes, std::uint32_t number) {
  for (; number >= 128; number >>= 7) bytes.push_back(static_cast<std::byte>(number | 128));
  bytes.push_back(static_cast<std::byte>(number));
}

std::uint32_t takeShort(const std::byte*& from) {
  std::uint32_t number = 0;
  for (int shift = 0;; shift += 7) {
    const auto next = std::to_integer<std::uint32_t>(*from++);
    number |= (next & 127) << shift;
    if (next < 128) return number;
  }
}

/// Packs the entries of a piece on this rank: the numbers of entries and of stretches, the bytes of the entries, and
/// for each stretch its length and the number of entries of other ranks before it. Empty if the rank has no entries.
mpi::Bytes packed(const Source& source, const Piece& piece, std::size_t bytes, mpi::Outbox& outbox) {
  const std::vector<Stretch> stretches = source.stretches(piece.first, piece.count);
  std::size_t count = 0;
  for (const Stretch& stretch : stretches) count += stretch.count;
  if (count == 0) return {};
  const std::uint64_t header[] = {count, stretches.size()};
  mpi::Bytes message = outbox.buffer();
  message.resize(sizeof(header) + count * bytes);
  std::memcpy(message.data(), header, sizeof(header));
  source.pack(piece.first, piece.count, message.data() + sizeof(header));
  std::uint32_t next = 0;
  for (const Stretch& stretch : stretches) {
    appendShort(message, stretch.first - next);
    appendShort(message, stretch.count);
    next = stretch.first + stretch.count;
  }
  return message;
}

void unpack(const mpi::Bytes& message, std::size_t bytes, std::byte* to) {
  std::uint64_t header[2];
  std::memcpy(header, message.data(), sizeof(header));
  const std::byte* values = message.data() + sizeof(header);
  const std::byte* lengths = values + header[0] * bytes;
  for (std::uint64_t k = 0; k < header[1]; ++k) {
    to += takeShort(lengths) * bytes;
    const std::size_t length = takeShort(lengths) * bytes;
    std::memcpy(to, values, length);
    to += length;
    values += length;
  }
}

void load(Array& array, const Writers& first, Pieces& pieces) {
  if (!array.source) return;
  std::vector<std::byte> buffer;
  const std::size_t bytes = entryBytes(array), most = std::max<std::size_t>(1, mostOfPiece(first) / bytes);
  const bool isMine = first.mine() == 0;
  std::visit(
      [&](auto& values) {
        if (isMine) values.resize(array.entries() * static_cast<std::size_t>(array.components));
        auto* to = reinterpret_cast<std::byte*>(values.data());
        for (Piece next; next.first < array.entries(); next.first += next.count) {
          next.count = std::min(most, array.entries() - next.first);
          const std::span<const std::byte> piece = pieces.bring(array, {&next, 1}, buffer);
          if (isMine) std::memcpy(to + next.first * bytes, piece.data(), piece.size());
        }
      },
      array.values);
  array.source.reset();
}

}  // namespace

std::size_t mostOfPiece(const Writers& writers) {
  constexpr std::size_t megabyte = 1 << 20, little = 32;
  if (writers.ranks().isAlone()) return megabyte;
  return std::clamp<std::size_t>(little / static_cast<std::size_t>(writers.count()), 1, 4) * megabyte;
}

std::size_t entryBytes(const Array& array) {
  const std::size_t number = std::visit([](const auto& values) { return sizeof(values[0]); }, array.values);
  return number * static_cast<std::size_t>(array.components);
}

std::uint64_t bytesOf(const Array& array) { return std::uint64_t{array.entries()} * entryBytes(array); }

std::span<std::byte> Pieces::bring(const Array& array, std::span<const Piece> of, std::vector<std::byte>& into) {
  const std::size_t bytes = entryBytes(array);
  const mpi::Communicator& ranks = writers_->ranks();
  const Piece mine = writers_->mine() < 0 ? Piece{} : of[writers_->mine()];
  if (into.size() < mine.count * bytes) into.resize(mine.count * bytes);
  if (mine.count > 0) array.source->read(mine.first, mine.count, into.data());
  std::vector<mpi::Letter> letters;
  for (int writer = 0; !ranks.isAlone() && writer < writers_->count(); ++writer) {
    const Piece& piece = of[writer];
    if (writer == writers_->mine() || piece.count == 0) continue;
    mpi::Bytes message = packed(*array.source, piece, bytes, outbox_);
    if (!message.empty()) letters.push_back({writers_->rankOf(writer), std::move(message)});
  }
  mpi::exchange(ranks, outbox_, std::move(letters),
                [&](int, const mpi::Bytes& message) { unpack(message, bytes, into.data()); });
  return {into.data(), mine.count * bytes};
}

void load(Snapshot& snapshot, const mpi::Communicator& ranks) {
  const Writers first(ranks, {0});
  Pieces pieces(first);
  for (ParticleBlock& block : snapshot.particles)
    for (Array& array : block.arrays) load(array, first, pieces);
  for (FieldBlock& field : snapshot.fields) load(field.array, first, pieces);
}

}  // namespace tushar::output
