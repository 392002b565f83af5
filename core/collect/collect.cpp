#include "core/collect/collect.hpp"

#include <cstring>

#include "core/collect/rows.hpp"

namespace tushar::collect {

using data::Generation;
using data::Variable;
using grid::Box;
using grid::Patch;

void sendPatches(const mpi::Communicator& ranks, mpi::Bytes bytes) {
  mpi::Outbox outbox(ranks);
  outbox.send(0, mpi::Tag::output, std::move(bytes));
  outbox.wait();
}

mpi::Bytes receivePatches(const mpi::Communicator& ranks, int from) { return ranks.receive(from, mpi::Tag::output); }

Parts collectParticles(data::Warehouse& warehouse, Generation generation, int variable) {
  const auto [label, material] = warehouse.table()[variable];
  const std::size_t bytes = label->bytes;
  const auto partOf = [&, which = material](const Patch& patch) {
    const int owned = warehouse.particles(Generation::old, which, patch.id()).owned();
    return Part{warehouse.variable(generation, variable, patch.id()).values, static_cast<std::size_t>(owned)};
  };
  Parts parts;
  parts.messages = collect(
      warehouse, [&](const Patch& patch) { parts.of.push_back(partOf(patch)); },
      [&](const Patch& patch, mpi::Bytes& message) {
        const Part part = partOf(patch);
        const std::uint64_t count = part.count;
        mpi::append(message, &count, sizeof(count));
        mpi::append(message, part.values, part.count * bytes);
      },
      [&](const Patch&, const std::byte* from) {
        std::uint64_t count = 0;
        std::memcpy(&count, from, sizeof(count));
        parts.of.push_back({from + sizeof(count), count});
        return sizeof(count) + count * bytes;
      });
  return parts;
}

Parts collectGrid(data::Warehouse& warehouse, Generation generation, int variable, const GridOrder& order) {
  const data::Label& label = *warehouse.table()[variable].label;
  const std::size_t bytes = label.bytes;
  const auto sentOf = [&](const Patch& patch) { return order.givenBy(ownBox(patch, label)); };
  Parts parts;
  parts.messages = collect(
      warehouse,
      [&](const Patch& patch) {
        const Variable own = warehouse.variable(generation, variable, patch.id());
        parts.of.push_back({own.values, 0, own.stored});
      },
      [&](const Patch& patch, mpi::Bytes& message) {
        const Variable own = warehouse.variable(generation, variable, patch.id());
        const Box sent = sentOf(patch);
        const auto length = static_cast<std::size_t>(sent.extent(0)) * bytes;
        forEachRow(sent, [&](const Index3& first) {
          mpi::append(message, own.values + own.stored.offset(first) * bytes, length);
        });
      },
      [&](const Patch& patch, const std::byte* from) {
        parts.of.push_back({from, 0, sentOf(patch)});
        return sentOf(patch).size() * bytes;
      });
  return parts;
}

}  // namespace tushar::collect
