#pragma once

#include <map>
#include <vector>

#include "core/base/mpi.hpp"
#include "core/data/warehouse.hpp"

namespace tushar::tasks {

/// A particle variable that is kept during a relocation, and the generation of its values before it.
struct Carried {
  int variable;
  data::Generation from;
};

/// A particle that migrates to another rank.
struct MigratingParticle {
  ParticleId id;
  Index3 cell;       ///< index of its new cell
  int patch, place;  ///< its previous patch, and its index there
};

/// Migrates particles between ranks with all their values, in one message to each neighbour.
///
/// A particle may go to any cell of the grid. Ranks usually expect messages from their neighbours only. If any particle
/// goes farther, about which all ranks agree first, they expect a message from every rank.
class ParticleMigration {
 public:
  /// Ranks with patches within this number of cells are neighbours; few particles travel farther in a step.
  static constexpr int neighbourhood = 2;

  explicit ParticleMigration(data::Warehouse& warehouse) : warehouse_(&warehouse), outbox_(warehouse.ranks()) {}

  /// Forgets the neighbours. Must be called when the distribution of patches, and hence the set of neighbours, has
  /// changed.
  void forgetLayout();
  /// Starts a relocation, with no migrating particles yet.
  void start();
  void add(int rank, const MigratingParticle& particle) { leaving_[rank].push_back(particle); }
  /// Whether a particle migrates to a rank that is not a neighbour.
  bool goesFar();

  /// Exchanges migrating particles and all their carried values with all ranks or, if `goFar` is false, only with the
  /// neighbours.
  void run(const std::vector<Carried>& carried, bool goFar);
  /// The particles that have arrived on this rank.
  const std::vector<MigratingParticle>& arrived() const { return arrived_; }
  /// The values of a carried variable for the particles that have arrived, one after the other.
  const std::byte* values(std::size_t carried) const { return values_[carried].data(); }

 private:
  const std::vector<int>& neighbours();
  mpi::Bytes packed(const std::vector<MigratingParticle>& particles, const std::vector<Carried>& carried);
  void unpack(const mpi::Bytes& message, const std::vector<Carried>& carried);

  data::Warehouse* warehouse_;
  mpi::Outbox outbox_;
  bool has_neighbours_ = false;
  std::vector<int> neighbours_;
  std::map<int, std::vector<MigratingParticle>> leaving_;  ///< particles that leave, by destination rank
  std::vector<MigratingParticle> arrived_;
  std::vector<mpi::Bytes> values_;  ///< values of the particles that have arrived, for each carried variable
};

}  // namespace tushar::tasks
