#include "core/base/mpi.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <exception>
#include <thread>

#include "core/base/launcher.hpp"
#include "core/base/mpi_native.hpp"

namespace tushar::mpi {

namespace {

// MPI counts in int. Messages are therefore sent in words of 8 bytes, so that a message may have up to 16 GB.
constexpr std::size_t wordBytes = sizeof(std::uint64_t);

/// Pads a message to whole words, and appends its length in bytes.
Bytes sealed(Bytes bytes) {
  const std::uint64_t length = bytes.size();
  bytes.resize((bytes.size() + wordBytes - 1) / wordBytes * wordBytes + wordBytes);
  std::memcpy(bytes.data() + bytes.size() - wordBytes, &length, wordBytes);
  return bytes;
}

Bytes opened(Bytes words) {
  std::uint64_t length = 0;
  std::memcpy(&length, words.data() + words.size() - wordBytes, wordBytes);
  words.resize(length);
  return words;
}

int wordsOf(const Bytes& words) { return static_cast<int>(words.size() / wordBytes); }

/// The merge function for the MPI operation below; a global variable, because MPI cannot pass it as an argument.
const std::function<void(const std::byte*, std::byte*)>* merging = nullptr;

/// MPI requires inout = in ∘ inout, in the order of the ranks.
void mergeValues(void* in, void* inout, int*, MPI_Datatype* type) {
  int bytes = 0;
  MPI_Type_size(*type, &bytes);
  auto* first = static_cast<std::byte*>(in);
  auto* second = static_cast<std::byte*>(inout);
  std::vector<std::byte> result(first, first + bytes);
  (*merging)(second, result.data());
  std::copy(result.begin(), result.end(), second);
}

Communicator copyOf(MPI_Comm all) {
  MPI_Comm ranks = MPI_COMM_NULL;
  MPI_Comm_dup(all, &ranks);
  return Communicator(std::make_shared<const Communicator::Native>(ranks));
}

}  // namespace

std::string libraryVersion() {
  std::array<char, MPI_MAX_LIBRARY_VERSION_STRING> text{};
  int length = 0;
  MPI_Get_library_version(text.data(), &length);
  const std::string all(text.data(), static_cast<std::size_t>(length));
  return all.substr(0, all.find_first_of(",\n"));  // Open MPI then says who packaged it, and when
}

Communicator::Communicator(std::shared_ptr<const Native> native) : native_(std::move(native)) {
  MPI_Comm_rank(native_->ranks, &rank_);
  MPI_Comm_size(native_->ranks, &size_);
}

const Communicator& Communicator::alone() {
  static const Communicator one;
  return one;
}

bool Communicator::any(bool mine) const { return max(mine ? 1 : 0) > 0; }

double Communicator::max(double mine) const {
  max(std::span(&mine, 1));
  return mine;
}

void Communicator::max(std::span<double> mine) const {
  if (isAlone()) return;
  MPI_Allreduce(MPI_IN_PLACE, mine.data(), static_cast<int>(mine.size()), MPI_DOUBLE, MPI_MAX, native_->ranks);
}

long Communicator::sum(long mine) const {
  if (isAlone()) return mine;
  MPI_Allreduce(MPI_IN_PLACE, &mine, 1, MPI_LONG, MPI_SUM, native_->ranks);
  return mine;
}

void Communicator::sum(std::span<double> mine) const {
  if (isAlone()) return;
  MPI_Allreduce(MPI_IN_PLACE, mine.data(), static_cast<int>(mine.size()), MPI_DOUBLE, MPI_SUM, native_->ranks);
}

void Communicator::merge(std::span<std::byte> value,
                         const std::function<void(const std::byte* from, std::byte* into)>& merge) const {
  if (isAlone() || value.empty()) return;
  MPI_Datatype type = MPI_DATATYPE_NULL;
  MPI_Op operation = MPI_OP_NULL;
  MPI_Type_contiguous(static_cast<int>(value.size()), MPI_BYTE, &type);
  MPI_Type_commit(&type);
  MPI_Op_create(mergeValues, 0, &operation);
  merging = &merge;
  Bytes merged(value.size());
  MPI_Reduce(value.data(), merged.data(), 1, type, operation, 0, native_->ranks);
  MPI_Bcast(merged.data(), 1, type, 0, native_->ranks);
  MPI_Op_free(&operation);
  MPI_Type_free(&type);
  std::copy(merged.begin(), merged.end(), value.begin());
}

Bytes Communicator::broadcast(Bytes bytes, int from) const {
  if (isAlone()) return bytes;
  std::uint64_t length = bytes.size();
  MPI_Bcast(&length, 1, MPI_UINT64_T, from, native_->ranks);
  bytes.resize((length + wordBytes - 1) / wordBytes * wordBytes);
  MPI_Bcast(bytes.data(), wordsOf(bytes), MPI_UINT64_T, from, native_->ranks);
  bytes.resize(length);
  return bytes;
}

std::string Communicator::broadcast(const std::string& text, int from) const {
  Bytes bytes;
  append(bytes, text.data(), text.size());
  bytes = broadcast(std::move(bytes), from);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::vector<std::string> Communicator::gather(const std::string& mine) const {
  std::vector<std::string> all;
  for (int rank = 0; rank < size_; ++rank) all.push_back(broadcast(mine, rank));
  return all;
}

void Communicator::onFirst(const std::function<void()>& action) const {
  std::exception_ptr thrown;
  if (isFirst()) {
    try {
      action();
    } catch (...) {
      thrown = std::current_exception();
    }
  }
  const bool failed = broadcast(thrown != nullptr);
  if (thrown) std::rethrow_exception(thrown);
  if (failed) throw FailedElsewhere();
}

Bytes Communicator::receive(int from, Tag tag) const {
  MPI_Message message = MPI_MESSAGE_NULL;
  MPI_Status status;
  MPI_Mprobe(from, static_cast<int>(tag), native_->ranks, &message, &status);
  int words = 0;
  MPI_Get_count(&status, MPI_UINT64_T, &words);
  Bytes bytes(static_cast<std::size_t>(words) * wordBytes);
  MPI_Mrecv(bytes.data(), words, MPI_UINT64_T, &message, MPI_STATUS_IGNORE);
  return opened(std::move(bytes));
}

Communicator Communicator::split(int colour) const {
  if (isAlone()) return {};
  MPI_Comm part = MPI_COMM_NULL;
  MPI_Comm_split(native_->ranks, colour, rank_, &part);
  return Communicator(std::make_shared<const Native>(part));
}

struct Outbox::Sent {
  Bytes bytes;
  MPI_Request request = MPI_REQUEST_NULL;
};

Outbox::Outbox(const Communicator& ranks) : ranks_(&ranks) {}

void Outbox::send(int to, Tag tag, Bytes bytes) {
  Sent& sent = sent_.emplace_back();
  sent.bytes = sealed(std::move(bytes));
  MPI_Isend(sent.bytes.data(), wordsOf(sent.bytes), MPI_UINT64_T, to, static_cast<int>(tag), ranks_->native()->ranks,
            &sent.request);
}

void Outbox::wait() {
  for (Sent& sent : sent_) {
    MPI_Wait(&sent.request, MPI_STATUS_IGNORE);
    spare_.push_back(std::move(sent.bytes));
  }
  sent_.clear();
}

Bytes Outbox::buffer() {
  if (spare_.empty()) return {};
  Bytes bytes = std::move(spare_.back());
  spare_.pop_back();
  bytes.clear();
  return bytes;
}

std::list<Outbox::Sent>& Outbox::abandoned() {
  static std::list<Sent> sent;
  return sent;
}

Outbox::~Outbox() {
  if (sent_.empty()) return;
  abandoned().splice(abandoned().end(), sent_);
  int isFinalized = 0;
  MPI_Finalized(&isFinalized);
  if (isFinalized) return;
  abandoned().remove_if([](Sent& sent) {
    int isGone = 0;
    MPI_Test(&sent.request, &isGone, MPI_STATUS_IGNORE);
    return isGone != 0;
  });
}

Session::Session() {
  if (launchedRanks() <= 1) return;
  int provided = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
  if (provided < MPI_THREAD_FUNNELED) {
    MPI_Finalize();
    if (launchedRank() > 0) throw FailedElsewhere();
    throw std::runtime_error("this MPI library does not support threads within a process, which sus needs");
  }
  is_open_ = true;
  ranks_ = copyOf(MPI_COMM_WORLD);
  meeting_ = copyOf(MPI_COMM_WORLD);
}

Session::~Session() {
  if (!is_open_) return;
  ranks_ = meeting_ = Communicator();
  MPI_Finalize();
}

bool Session::speaks(bool isKnown, int& exitCode) {
  if (ranks_.isAlone()) return true;
  constexpr std::chrono::milliseconds patience(2000), pause(1), turn(200);
  constexpr long codes = 256;
  const int place = isKnown ? meeting_.rank() : meeting_.size();
  const long mine = place * codes + exitCode;
  long first = mine;
  int done = 0;
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Iallreduce(&mine, &first, 1, MPI_LONG, MPI_MIN, meeting_.native()->ranks, &request);
  const auto end = std::chrono::steady_clock::now() + patience;
  while (!done && std::chrono::steady_clock::now() < end) {
    MPI_Test(&request, &done, MPI_STATUS_IGNORE);
    std::this_thread::sleep_for(pause);
  }
  is_agreed_ = done != 0;
  if (!is_agreed_) {
    // Ranks wait their turn, so that the first aborts the others before they report; at most `patience` in total.
    std::this_thread::sleep_for(std::min(turn, patience / meeting_.size()) * place);
    return isKnown;
  }
  exitCode = static_cast<int>(first % codes);
  return first / codes == meeting_.rank();
}

void Session::abort(int exitCode) {
  MPI_Abort(MPI_COMM_WORLD, exitCode);
  std::abort();
}

}  // namespace tushar::mpi
