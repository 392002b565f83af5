#pragma once

#include <cstddef>
#include <cstring>
#include <functional>
#include <list>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "core/base/merge.hpp"

namespace tushar::mpi {

using Bytes = std::vector<std::byte>;

/// The kind of a message: a rank that waits for one kind does not receive messages of another.
enum class Tag : int { ghosts, migrants, patches, output, planes };

/// Appends `length` bytes, which start at `from`.
inline void append(Bytes& bytes, const void* from, std::size_t length) {
  const auto* first = static_cast<const std::byte*>(from);
  bytes.insert(bytes.end(), first, first + length);
}

/// Name and version of the MPI library; MPI need not be initialised.
std::string libraryVersion();

/// Exception thrown on a rank because another rank has failed; the rank that has failed reports the cause.
class FailedElsewhere : public std::runtime_error {
 public:
  FailedElsewhere() : std::runtime_error("another rank has failed") {}
};

/// The ranks that run a simulation together, as seen from one of them.
///
/// All functions except `receive` are collective: every rank calls them, in the same order. On a single rank they
/// return immediately and do not use MPI.
class Communicator {
 public:
  struct Native;

  /// A communicator of a single rank.
  Communicator() = default;
  static const Communicator& alone();
  /// See mpi_native.hpp.
  explicit Communicator(std::shared_ptr<const Native> native);

  int rank() const { return rank_; }
  int size() const { return size_; }
  bool isFirst() const { return rank_ == 0; }
  bool isAlone() const { return size_ == 1; }

  bool any(bool mine) const;
  double max(double mine) const;
  /// Replaces each number by its maximum over all ranks.
  void max(std::span<double> mine) const;
  long sum(long mine) const;
  /// Replaces each number by its sum over all ranks; sums of whole numbers are bitwise equal on all ranks.
  void sum(std::span<double> mine) const;
  /// Merges the values of all ranks with `merge(from, into)`, in a tree that depends only on the number of ranks. The
  /// result is bitwise equal on all ranks.
  void merge(std::span<std::byte> value,
             const std::function<void(const std::byte* from, std::byte* into)>& merge) const;
  /// Merges a value by its own function `merge`.
  template <class T>
  void merge(T& value) const {
    merge(std::as_writable_bytes(std::span(&value, 1)), mergeInMemory<T>);
  }
  /// Sends the bytes of rank `from` to all ranks; returns them on every rank.
  Bytes broadcast(Bytes bytes, int from = 0) const;
  /// Sends the value of rank `from` to all ranks; the value must not contain pointers.
  template <class T>
  T broadcast(T value, int from = 0) const {
    static_assert(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>,
                  "a value that contains pointers is meaningless on another rank");
    Bytes bytes(sizeof(T));
    std::memcpy(bytes.data(), &value, sizeof(T));
    bytes = broadcast(std::move(bytes), from);
    std::memcpy(&value, bytes.data(), sizeof(T));
    return value;
  }
  std::string broadcast(const std::string& text, int from = 0) const;
  /// Returns the texts of all ranks, ordered by rank, on every rank. Slow: meant for errors.
  std::vector<std::string> gather(const std::string& mine) const;
  /// Runs a function on rank 0 only. If it throws, rank 0 throws its exception, and the other ranks throw
  /// FailedElsewhere.
  void onFirst(const std::function<void()>& action) const;

  /// Waits for the next message of rank `from` with this tag.
  Bytes receive(int from, Tag tag) const;

  /// Returns a communicator of the ranks that pass the same `colour`.
  Communicator split(int colour) const;
  /// MPI's communicator; null for a single rank.
  const Native* native() const { return native_.get(); }

 private:
  std::shared_ptr<const Native> native_;
  int rank_ = 0, size_ = 1;
};

/// Sends messages, and keeps their bytes until they have been sent.
class Outbox {
 public:
  explicit Outbox(const Communicator& ranks);
  Outbox(const Outbox&) = delete;
  Outbox& operator=(const Outbox&) = delete;
  /// Keeps the memory of messages that have not been sent completely, because MPI may still read it.
  ~Outbox();

  /// Starts sending a message, and returns immediately.
  void send(int to, Tag tag, Bytes bytes);
  /// Waits until all messages are sent; later messages reuse their memory.
  void wait();
  /// Returns an empty buffer, which reuses the memory of an earlier message if possible.
  Bytes buffer();

 private:
  struct Sent;
  /// Messages not yet sent when their outbox was destroyed.
  static std::list<Sent>& abandoned();

  const Communicator* ranks_;
  std::list<Sent> sent_;
  std::vector<Bytes> spare_;
};

/// Initialises and finalises MPI for a program; MPI is used only if a launcher (mpirun, srun) started several
/// processes.
class Session {
 public:
  /// Throws std::runtime_error if the MPI library does not support threads, and FailedElsewhere on all ranks except 0.
  Session();
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  const Communicator& ranks() const { return ranks_; }

  /// Returns whether this rank must print its error message. Must be called by each rank that cannot continue;
  /// `isKnown`: whether the rank has an error message of its own. If all ranks call this within two seconds, the
  /// program can end without `abort`: only the first rank with a message gets true, and all ranks get its exit code.
  /// Otherwise, each rank with a message gets true, and must print it and stop the others by `abort`. In this case, the
  /// ranks return one after the other, so that usually only one reports.
  bool speaks(bool isKnown, int& exitCode);
  /// Whether all ranks have called `speaks`.
  bool isAgreed() const { return is_agreed_; }
  /// Ends the program on all ranks immediately.
  [[noreturn]] void abort(int exitCode);

 private:
  Communicator ranks_, meeting_;
  bool is_open_ = false, is_agreed_ = true;
};

}  // namespace tushar::mpi
