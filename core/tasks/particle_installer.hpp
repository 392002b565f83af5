#pragma once

#include <functional>
#include <vector>

#include "core/data/warehouse.hpp"
#include "core/tasks/particle_maker.hpp"

namespace tushar::tasks {

/// Installs the new particles that a task has made on all patches of a rank as those of a material.
class ParticleInstaller {
 public:
  using Work = std::function<void(const grid::Patch&, ParticleMaker&)>;
  /// Calls a function for all patches, possibly for several patches in parallel.
  using OnPatches = std::function<void(const Work&)>;

  ParticleInstaller(data::Warehouse& warehouse, int material, const std::vector<ParticleMaker>& makers);

  /// Whether no patch has new particles, so that nothing need be installed after makeSets.
  bool keepsAll() const { return keeps_all_; }
  /// First step: installs the particle sets, which then have slots.
  void makeSets(const OnPatches& onPatches);
  /// Second step: installs the values of a created label, or discards those of a label that nothing reads.
  void write(int number, std::size_t access, bool isRead, const OnPatches& onPatches);
  void writeIds(const OnPatches& onPatches);

 private:
  /// Calls `writeOne(maker, values before, destination of its values)` for each patch with new particles; the other
  /// patches keep their values.
  template <class WriteOne>
  void writeEach(int number, const OnPatches& onPatches, const WriteOne& writeOne);
  std::size_t placeOf(const grid::Patch& patch) const {
    return static_cast<std::size_t>(patch.id() - warehouse_->grid().firstPatch());
  }

  /// The number of the variable with the ids of particles.
  int numberOfIds() const;

  data::Warehouse* warehouse_;
  int material_;
  bool keeps_all_;  ///< whether all patches keep their particles
};

}  // namespace tushar::tasks
