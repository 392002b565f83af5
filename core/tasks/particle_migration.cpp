#include "core/tasks/particle_migration.hpp"

#include <algorithm>

#include "core/tasks/ghost_plan.hpp"

namespace tushar::tasks {

void ParticleMigration::forgetLayout() {
  has_neighbours_ = false;
  leaving_.clear();
}

void ParticleMigration::start() {
  for (auto& particles : leaving_) particles.second.clear();
  arrived_.clear();
}

const std::vector<int>& ParticleMigration::neighbours() {
  if (!has_neighbours_) {
    const GhostPlan plan = planGhosts(warehouse_->grid(), {data::Centring::particle, neighbourhood});
    neighbours_.assign(plan.incoming.begin(), plan.incoming.end());
    has_neighbours_ = true;
  }
  return neighbours_;
}

bool ParticleMigration::goesFar() {
  return std::any_of(leaving_.begin(), leaving_.end(), [&](const auto& particles) {
    return !particles.second.empty() && !std::binary_search(neighbours().begin(), neighbours().end(), particles.first);
  });
}

mpi::Bytes ParticleMigration::packed(const std::vector<MigratingParticle>& particles,
                                     const std::vector<Carried>& carried) {
  mpi::Bytes message = outbox_.buffer();
  const std::uint64_t count = particles.size();
  mpi::append(message, &count, sizeof(count));
  mpi::append(message, particles.data(), particles.size() * sizeof(MigratingParticle));
  for (const Carried& variable : carried) {
    const std::size_t bytes = warehouse_->table()[variable.variable].label->bytes;
    for (const MigratingParticle& particle : particles)
      mpi::append(message,
                  warehouse_->variable(variable.from, variable.variable, particle.patch).values +
                      static_cast<std::size_t>(particle.place) * bytes,
                  bytes);
  }
  return message;
}

void ParticleMigration::unpack(const mpi::Bytes& message, const std::vector<Carried>& carried) {
  std::uint64_t count = 0;
  const std::byte* from = message.data();
  std::memcpy(&count, from, sizeof(count));
  from += sizeof(count);
  const std::size_t before = arrived_.size();
  arrived_.resize(before + count);
  std::memcpy(arrived_.data() + before, from, count * sizeof(MigratingParticle));
  from += count * sizeof(MigratingParticle);
  for (std::size_t k = 0; k < carried.size(); ++k) {
    const std::size_t length = count * warehouse_->table()[carried[k].variable].label->bytes;
    mpi::append(values_[k], from, length);
    from += length;
  }
}

void ParticleMigration::run(const std::vector<Carried>& carried, bool goFar) {
  values_.resize(std::max(values_.size(), carried.size()));
  for (mpi::Bytes& values : values_) values.clear();
  if (warehouse_->ranks().isAlone()) return;
  std::vector<int> peers = neighbours();
  if (goFar) {
    peers.clear();
    for (int rank = 0; rank < warehouse_->ranks().size(); ++rank)
      if (rank != warehouse_->ranks().rank()) peers.push_back(rank);
  }
  for (const int rank : peers) outbox_.send(rank, mpi::Tag::migrants, packed(leaving_[rank], carried));
  for (const int rank : peers) unpack(warehouse_->ranks().receive(rank, mpi::Tag::migrants), carried);
  outbox_.wait();
}

}  // namespace tushar::tasks
