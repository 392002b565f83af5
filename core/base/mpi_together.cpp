#include "core/base/mpi_together.hpp"

#include <exception>
#include <thread>

#include "core/base/mpi_native.hpp"

namespace tushar::mpi {

void together(const Communicator& ranks, const std::function<void()>& action) {
  std::exception_ptr thrown;
  try {
    action();
  } catch (...) {
    thrown = std::current_exception();
  }
  const bool failed = ranks.any(thrown != nullptr);
  if (thrown) std::rethrow_exception(thrown);
  if (failed) throw FailedElsewhere();
}

bool meet(const Communicator& ranks, std::chrono::milliseconds patience) {
  constexpr std::chrono::milliseconds pause(1);
  if (ranks.isAlone()) return true;
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Ibarrier(ranks.native()->ranks, &request);
  const auto end = std::chrono::steady_clock::now() + patience;
  int done = 0;
  for (MPI_Test(&request, &done, MPI_STATUS_IGNORE); !done && std::chrono::steady_clock::now() < end;) {
    std::this_thread::sleep_for(pause);
    MPI_Test(&request, &done, MPI_STATUS_IGNORE);
  }
  return done != 0;
}

int sumForMe(const Communicator& ranks, std::span<const int> of) {
  if (ranks.isAlone()) return of.front();
  int sum = 0;
  MPI_Reduce_scatter_block(of.data(), &sum, 1, MPI_INT, MPI_SUM, ranks.native()->ranks);
  return sum;
}

std::uint64_t sumBefore(const Communicator& ranks, std::uint64_t mine) {
  if (ranks.isAlone()) return 0;
  std::uint64_t sum = 0;
  MPI_Exscan(&mine, &sum, 1, MPI_UINT64_T, MPI_SUM, ranks.native()->ranks);
  return ranks.isFirst() ? 0 : sum;
}

std::vector<std::uint64_t> allOf(const Communicator& ranks, std::span<const std::uint64_t> mine) {
  if (ranks.isAlone()) return {mine.begin(), mine.end()};
  const int count = static_cast<int>(mine.size());
  std::vector<int> counts(ranks.size()), before(counts.size() + 1, 0);
  MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, ranks.native()->ranks);
  for (std::size_t rank = 0; rank < counts.size(); ++rank) before[rank + 1] = before[rank] + counts[rank];
  std::vector<std::uint64_t> all(before.back());
  MPI_Allgatherv(mine.data(), count, MPI_UINT64_T, all.data(), counts.data(), before.data(), MPI_UINT64_T,
                 ranks.native()->ranks);
  return all;
}

namespace {

/// A type of MPI for blocks of bytes, so that fewer than 2^31 blocks can have more bytes.
class Blocks {
 public:
  explicit Blocks(std::size_t bytes) {
    MPI_Type_contiguous(static_cast<int>(bytes), MPI_BYTE, &type_);
    MPI_Type_commit(&type_);
  }
  Blocks(const Blocks&) = delete;
  Blocks& operator=(const Blocks&) = delete;
  ~Blocks() { MPI_Type_free(&type_); }
  MPI_Datatype type() const { return type_; }

 private:
  MPI_Datatype type_ = MPI_DATATYPE_NULL;
};

}  // namespace

void complete(const Communicator& ranks, std::span<std::byte> items, std::span<const int> firsts) {
  if (ranks.isAlone() || items.empty()) return;
  std::vector<int> counts;
  for (int rank = 0; rank < ranks.size(); ++rank) counts.push_back(firsts[rank + 1] - firsts[rank]);
  const Blocks item(items.size() / static_cast<std::size_t>(firsts[ranks.size()]));
  MPI_Allgatherv(MPI_IN_PLACE, 0, MPI_DATATYPE_NULL, items.data(), counts.data(), firsts.data(), item.type(),
                 ranks.native()->ranks);
}

void pass(const Communicator& ranks, int to, std::span<const std::byte> sent, int from, std::span<std::byte> received) {
  const auto orNone = [](int rank) { return rank < 0 ? MPI_PROC_NULL : rank; };
  constexpr int tag = static_cast<int>(Tag::planes);
  MPI_Sendrecv(sent.data(), static_cast<int>(sent.size()), MPI_BYTE, orNone(to), tag, received.data(),
               static_cast<int>(received.size()), MPI_BYTE, orNone(from), tag, ranks.native()->ranks,
               MPI_STATUS_IGNORE);
}

std::vector<int> firstOfNodes(const Communicator& ranks) {
  if (ranks.isAlone()) return {0};
  MPI_Comm node = MPI_COMM_NULL;
  MPI_Comm_split_type(ranks.native()->ranks, MPI_COMM_TYPE_SHARED, ranks.rank(), MPI_INFO_NULL, &node);
  int place = 0;
  MPI_Comm_rank(node, &place);
  MPI_Comm_free(&node);
  const auto mine = static_cast<std::uint64_t>(ranks.rank());
  const std::vector<std::uint64_t> firsts = allOf(ranks, {&mine, place == 0 ? 1u : 0u});
  return {firsts.begin(), firsts.end()};
}

/// No rank sends messages of the next exchange before all ranks have begun that exchange, and a rank begins it only
/// after it has received all messages of this one.
void exchange(const Communicator& ranks, Outbox& outbox, std::vector<Letter> letters,
              const std::function<void(int, const Bytes&)>& take) {
  if (ranks.isAlone()) return;
  std::vector<int> counts(ranks.size(), 0);
  for (const Letter& letter : letters) ++counts[letter.rank];
  const int expected = sumForMe(ranks, counts);
  for (Letter& letter : letters) outbox.send(letter.rank, Tag::output, std::move(letter.bytes));
  for (int k = 0; k < expected; ++k) {
    MPI_Status status;
    MPI_Probe(MPI_ANY_SOURCE, static_cast<int>(Tag::output), ranks.native()->ranks, &status);
    take(status.MPI_SOURCE, ranks.receive(status.MPI_SOURCE, Tag::output));
  }
  outbox.wait();
}

}  // namespace tushar::mpi
