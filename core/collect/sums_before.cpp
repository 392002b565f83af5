#include "core/collect/sums_before.hpp"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <queue>

#include "core/base/error.hpp"
#include "core/base/mpi_together.hpp"

namespace tushar::collect {

namespace {

constexpr std::uint64_t samplesOfRank = 64;

/// The smallest key of each section except the first.
std::vector<std::uint64_t> cutsOf(const mpi::Communicator& ranks, std::span<const std::uint64_t> keys) {
  const std::size_t sections = ranks.size();
  const auto all = static_cast<std::uint64_t>(ranks.sum(static_cast<long>(keys.size())));
  const std::uint64_t every = std::max<std::uint64_t>(1, all / (samplesOfRank * sections));
  std::vector<std::uint64_t> mine;
  for (std::size_t k = every / 2; k < keys.size(); k += every) mine.push_back(keys[k]);
  std::vector<std::uint64_t> samples = mpi::allOf(ranks, mine);
  std::sort(samples.begin(), samples.end());
  std::vector<std::uint64_t> cuts;
  for (std::size_t section = 1; section < sections && !samples.empty(); ++section)
    cuts.push_back(samples[section * samples.size() / sections]);
  return cuts;
}

/// The part of a section on one rank: keys, then weights if there are any; after the merge, the sums.
struct Part {
  int from = 0;
  std::vector<std::uint64_t> words{};
  std::size_t count = 0;  ///< number of keys
};

mpi::Bytes bytesOf(std::span<const std::uint64_t> first, std::span<const std::uint64_t> second) {
  mpi::Bytes bytes;
  bytes.reserve((first.size() + second.size()) * sizeof(std::uint64_t));
  mpi::append(bytes, first.data(), first.size_bytes());
  mpi::append(bytes, second.data(), second.size_bytes());
  return bytes;
}

std::vector<std::uint64_t> wordsOf(const mpi::Bytes& bytes) {
  std::vector<std::uint64_t> words(bytes.size() / sizeof(std::uint64_t));
  std::memcpy(words.data(), bytes.data(), words.size() * sizeof(std::uint64_t));
  return words;
}

/// The sum of all weights of a section, and whether keys repeat there.
struct Merged {
  std::uint64_t sum = 0;
  bool repeats = false;
};

/// Replaces each key of a section by the sum of the weights of all smaller keys.
Merged merge(std::vector<Part>& parts, bool isWeighted) {
  struct Next {
    std::uint64_t key;
    std::size_t part, place;
    bool operator>(const Next& other) const { return key > other.key; }
  };
  std::priority_queue<Next, std::vector<Next>, std::greater<>> next;
  for (std::size_t k = 0; k < parts.size(); ++k)
    if (parts[k].count > 0) next.push({parts[k].words.front(), k, 0});
  std::uint64_t sum = 0;
  bool repeats = false;
  while (!next.empty()) {
    const Next least = next.top();
    next.pop();
    repeats |= !next.empty() && next.top().key == least.key;
    Part& part = parts[least.part];
    const std::size_t after = least.place + 1;
    part.words[least.place] = sum;
    sum += isWeighted ? part.words[part.count + least.place] : 1;
    if (after < part.count) next.push({part.words[after], least.part, after});
  }
  return {sum, repeats};
}

/// The keys and weights of this rank, divided into sections.
class Sections {
 public:
  Sections(const mpi::Communicator& ranks, std::span<const std::uint64_t> keys, std::span<const std::uint64_t> weights)
      : ranks_(ranks), keys_(keys), weights_(weights), outbox_(ranks), starts_{0} {
    for (const std::uint64_t cut : cutsOf(ranks, keys))
      starts_.push_back(static_cast<std::size_t>(std::lower_bound(keys.begin(), keys.end(), cut) - keys.begin()));
    starts_.resize(static_cast<std::size_t>(ranks.size()) + 1, keys.size());
  }

  std::vector<std::uint64_t> sums() {
    std::vector<Part> parts = gathered();
    const bool isWeighted = ranks_.any(!weights_.empty());
    for (Part& part : parts) part.count = part.words.size() / (isWeighted ? 2 : 1);
    const Merged merged = merge(parts, isWeighted);
    if (ranks_.any(merged.repeats)) throw TaskError(repeatedIds);
    return handedBack(parts, mpi::sumBefore(ranks_, merged.sum));
  }

 private:
  std::size_t sizeOf(std::size_t rank) const { return starts_[rank + 1] - starts_[rank]; }
  template <class Values>
  Values of(Values values, std::size_t rank) const {
    return values.empty() ? values : values.subspan(starts_[rank], sizeOf(rank));
  }

  /// The parts of this rank's section, received from all ranks.
  std::vector<Part> gathered() {
    std::vector<Part> parts;
    std::vector<mpi::Letter> letters;
    for (int rank = 0; rank < ranks_.size(); ++rank) {
      const std::size_t place = rank;
      if (sizeOf(place) == 0) continue;
      mpi::Bytes bytes = bytesOf(of(keys_, place), of(weights_, place));
      if (rank == ranks_.rank())
        parts.push_back({rank, wordsOf(bytes)});
      else
        letters.push_back({rank, std::move(bytes)});
    }
    mpi::exchange(ranks_, outbox_, std::move(letters), [&](int from, const mpi::Bytes& bytes) {
      parts.push_back({from, wordsOf(bytes)});
    });
    return parts;
  }

  std::vector<std::uint64_t> handedBack(const std::vector<Part>& parts, std::uint64_t before) {
    std::vector<std::uint64_t> sums(keys_.size());
    const auto take = [&](int from, std::span<const std::uint64_t> words) {
      std::copy(words.begin(), words.end(), sums.begin() + static_cast<std::ptrdiff_t>(starts_[from]));
    };
    std::vector<mpi::Letter> letters;
    for (const Part& part : parts) {
      std::vector<std::uint64_t> words(part.words.begin(),
                                       part.words.begin() + static_cast<std::ptrdiff_t>(part.count));
      for (std::uint64_t& word : words) word += before;
      if (part.from == ranks_.rank())
        take(part.from, words);
      else
        letters.push_back({part.from, bytesOf(words, {})});
    }
    mpi::exchange(ranks_, outbox_, std::move(letters),
                  [&](int from, const mpi::Bytes& bytes) { take(from, wordsOf(bytes)); });
    return sums;
  }

  const mpi::Communicator& ranks_;
  std::span<const std::uint64_t> keys_, weights_;
  mpi::Outbox outbox_;
  std::vector<std::size_t> starts_;  ///< start of each rank's section among the keys; the last element is the end
};

}  // namespace

std::vector<std::uint64_t> sumsBefore(const mpi::Communicator& ranks, std::span<const std::uint64_t> keys,
                                      std::span<const std::uint64_t> weights) {
  assert(weights.empty() || weights.size() == keys.size());
  if (!ranks.isAlone()) return Sections(ranks, keys, weights).sums();
  std::vector<std::uint64_t> sums(keys.size());
  std::uint64_t sum = 0;
  for (std::size_t k = 0; k < keys.size(); ++k) {
    sums[k] = sum;
    sum += weights.empty() ? 1 : weights[k];
  }
  return sums;
}

}  // namespace tushar::collect
