#include "core/tasks/emigration.hpp"

#include <algorithm>

#include "core/tasks/ghost_plan.hpp"

namespace tushar::tasks {

void Emigration::forgetLayout() {
  knows_neighbours_ = false;
  leaving_.clear();
}

void Emigration::start() {
  for (auto& particles : leaving_) particles.second.clear();
  arrived_.clear();
}

const std::vector<int>& Emigration::neighbours() {
  if (!knows_neighbours_) {
    const GhostPlan plan = planGhosts(warehouse_->level(), false, neighbourhood);
    neighbours_.assign(plan.incoming.begin(), plan.incoming.end());
    knows_neighbours_ = true;
  }
  return neighbours_;
}

bool Emigration::goesFar() {
  return std::any_of(leaving_.begin(), leaving_.end(), [&](const auto& particles) {
    return !particles.second.empty() && !std::binary_search(neighbours().begin(), neighbours().end(), particles.first);
  });
}

mpi::Bytes Emigration::packed(const std::vector<Emigrant>& particles, const std::vector<Carried>& carried) {
  mpi::Bytes message = outbox_.buffer();
  const std::uint64_t count = particles.size();
  mpi::append(message, &count, sizeof(count));
  mpi::append(message, particles.data(), particles.size() * sizeof(Emigrant));
  for (const Carried& variable : carried) {
    const std::size_t bytes = warehouse_->table()[variable.variable].label->bytes;
    for (const Emigrant& particle : particles)
      mpi::append(message,
                  warehouse_->variable(variable.from, variable.variable, particle.patch).values +
                      static_cast<std::size_t>(particle.place) * bytes,
                  bytes);
  }
  return message;
}

void Emigration::unpack(const mpi::Bytes& message, const std::vector<Carried>& carried) {
  std::uint64_t count = 0;
  const std::byte* from = message.data();
  std::memcpy(&count, from, sizeof(count));
  from += sizeof(count);
  const std::size_t before = arrived_.size();
  arrived_.resize(before + count);
  std::memcpy(arrived_.data() + before, from, count * sizeof(Emigrant));
  from += count * sizeof(Emigrant);
  for (std::size_t k = 0; k < carried.size(); ++k) {
    const std::size_t length = count * warehouse_->table()[carried[k].variable].label->bytes;
    mpi::append(values_[k], from, length);
    from += length;
  }
}

void Emigration::run(const std::vector<Carried>& carried, bool goFar) {
  values_.resize(std::max(values_.size(), carried.size()));
  for (mpi::Bytes& values : values_) values.clear();
  if (warehouse_->ranks().isAlone()) return;
  std::vector<int> peers = neighbours();
  if (goFar) {
    peers.clear();
    for (int rank = 0; rank < warehouse_->ranks().size(); ++rank)
      if (rank != warehouse_->ranks().rank()) peers.push_back(rank);
  }
  for (const int rank : peers) outbox_.send(rank, mpi::Tag::emigrants, packed(leaving_[rank], carried));
  for (const int rank : peers) unpack(warehouse_->ranks().receive(rank, mpi::Tag::emigrants), carried);
  outbox_.wait();
}

}  // namespace tushar::tasks
