#include "core/simulation/collect.hpp"

namespace tushar::simulation {

namespace {
constexpr int tag = 3;
}

void sendPatches(const mpi::Communicator& ranks, mpi::Bytes bytes) {
  mpi::Outbox outbox(ranks);
  outbox.send(0, tag, std::move(bytes));
  outbox.wait();
}

mpi::Bytes receivePatches(const mpi::Communicator& ranks, int from) { return ranks.receive(from, tag); }

}  // namespace tushar::simulation
