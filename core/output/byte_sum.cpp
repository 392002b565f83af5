#include "core/output/byte_sum.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>

#include "core/base/error.hpp"

namespace tushar::output {

namespace {

__extension__ using Wide = unsigned __int128;

constexpr int bits = 61;
constexpr std::uint64_t prime = (std::uint64_t{1} << bits) - 1;
/// Base of the polynomial: a primitive root of the prime, chosen at random.
constexpr std::uint64_t base = 0x16c86fac93223801;
constexpr std::size_t wordBytes = sizeof(std::uint64_t);

/// Reduces a number modulo the prime; the result may still be slightly larger than the prime.
std::uint64_t reduced(Wide number) {
  const std::uint64_t sum = (static_cast<std::uint64_t>(number) & prime) + static_cast<std::uint64_t>(number >> bits);
  return sum >= prime ? sum - prime : sum;
}

std::uint64_t times(std::uint64_t a, std::uint64_t b) { return reduced(Wide{a} * b); }

std::uint64_t powerOf(std::uint64_t number, std::uint64_t exponent) {
  std::uint64_t power = 1;
  for (; exponent > 0; exponent >>= 1, number = times(number, number))
    if (exponent & 1) power = times(power, number);
  return power;
}

std::uint64_t wordAt(const std::byte* from, std::size_t number) {
  std::uint64_t word = 0;
  std::memcpy(&word, from + number * wordBytes, wordBytes);
  return word;
}

/// The sum of w_k r^k over words, starting with k = 0. Uses Horner's rule for four interleaved sums of every fourth
/// word, so that no sum waits for another.
std::uint64_t sumOfWords(const std::byte* words, std::size_t count) {
  constexpr std::size_t lanes = 4;
  static const std::uint64_t stride = powerOf(base, lanes);
  std::array<std::uint64_t, lanes> sums{};
  std::size_t next = count / lanes * lanes;
  for (std::size_t k = next; k < count; ++k) sums[k - next] = reduced(wordAt(words, k));
  for (; next > 0; next -= lanes)
    for (std::size_t lane = 0; lane < lanes; ++lane)
      sums[lane] = reduced(Wide{sums[lane]} * stride + wordAt(words, next - lanes + lane));
  std::uint64_t total = 0;
  for (std::size_t lane = lanes; lane-- > 0;) total = reduced(Wide{total} * base + sums[lane]);
  return total;
}

/// The parts of a sequence of ranges that lie between two bytes, counted along the sequence.
std::vector<ByteRange> between(std::span<const ByteRange> ranges, std::uint64_t first, std::uint64_t last) {
  std::vector<ByteRange> found;
  for (std::uint64_t before = 0; const ByteRange& range : ranges) {
    const auto placeOf = [&](std::uint64_t byte) {
      return range.first + std::clamp(byte, before, before + range.size()) - before;
    };
    if (placeOf(first) < placeOf(last)) found.push_back({placeOf(first), placeOf(last)});
    before += range.size();
  }
  return found;
}

}  // namespace

/// Computes r^number.
std::uint64_t ByteSum::power(std::uint64_t number) {
  if (number < last_) {
    last_ = 0;
    last_power_ = 1;
  }
  if (number - last_ != step_) {
    step_ = number - last_;
    step_power_ = powerOf(base, step_);
  }
  last_ = number;
  last_power_ = times(last_power_, step_power_);
  return last_power_;
}

/// Adds a part of a word; its other bytes are treated as 0.
void ByteSum::addWord(std::uint64_t number, std::span<const std::byte> bytes, std::uint64_t before) {
  if (bytes.empty()) return;
  std::array<std::byte, wordBytes> word{};
  std::copy(bytes.begin(), bytes.end(), word.begin() + static_cast<std::ptrdiff_t>(before));
  total_ = reduced(Wide{power(number)} * reduced(wordAt(word.data(), 0)) + total_) % prime;
}

void ByteSum::add(std::uint64_t at, std::span<const std::byte> bytes) {
  if (const std::uint64_t before = at % wordBytes; before > 0) {
    const std::size_t count = std::min<std::size_t>(wordBytes - before, bytes.size());
    addWord(at / wordBytes, bytes.first(count), before);
    at += count;
    bytes = bytes.subspan(count);
  }
  const std::size_t words = bytes.size() / wordBytes;
  if (words > 0) total_ = reduced(Wide{power(at / wordBytes)} * sumOfWords(bytes.data(), words) + total_) % prime;
  addWord(at / wordBytes + words, bytes.subspan(words * wordBytes), 0);
}

std::uint64_t sumOfFile(const std::filesystem::path& file, std::span<const ByteRange> ranges, const ShareOf& share) {
  std::uint64_t size = 0;
  for (const ByteRange& range : ranges) size += range.size();
  const auto cut = [&](int before) {
    return static_cast<std::uint64_t>(Wide{size} * static_cast<std::uint64_t>(before) /
                                      static_cast<std::uint64_t>(share.several));
  };
  std::ifstream in(file, std::ios::binary);
  std::vector<char> piece(std::min<std::uint64_t>(size, std::uint64_t{1} << 20));
  ByteSum sum;
  for (const ByteRange& range : between(ranges, cut(share.one), cut(share.one + 1))) {
    in.seekg(static_cast<std::streamoff>(range.first));
    for (std::uint64_t at = range.first, next; at < range.last; at += next) {
      next = std::min<std::uint64_t>(range.last - at, piece.size());
      if (!in.read(piece.data(), static_cast<std::streamsize>(next)))
        throw FileError(fmt::format("cannot read '{}'", file.string()));
      sum.add(at, std::as_bytes(std::span(piece.data(), next)));
    }
  }
  return sum.value();
}

std::vector<std::uint64_t> sumsOfRanks(const mpi::Communicator& ranks, std::span<const std::uint64_t> mine) {
  constexpr int half = 31;
  std::vector<double> parts;  // whole numbers, which stay exact for up to 2^22 ranks
  for (const std::uint64_t sum : mine) {
    parts.push_back(static_cast<double>(sum & ((std::uint64_t{1} << half) - 1)));
    parts.push_back(static_cast<double>(sum >> half));
  }
  ranks.sum(parts);
  std::vector<std::uint64_t> all;
  for (std::size_t k = 0; k < parts.size(); k += 2)
    all.push_back(static_cast<std::uint64_t>(
        ((Wide{static_cast<std::uint64_t>(parts[k + 1])} << half) + static_cast<std::uint64_t>(parts[k])) % prime));
  return all;
}

}  // namespace tushar::output
