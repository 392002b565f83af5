#pragma once

#include <deque>
#include <string>
#include <vector>

#include "core/collect/particle_order.hpp"
#include "core/data/warehouse.hpp"
#include "core/output/archive_hdf5_input.hpp"
#include "core/output/checkpoint_manifest.hpp"
#include "core/output/shared_hdf5.hpp"

namespace tushar::collect {

/// The names of the variables of a state: those that belong to no material, and those of each of these materials.
struct StateNames {
  std::vector<std::string> labels, materials;
};

/// The old values of the variables, exact to the last bit, in an order that does not depend on the layout: nodes and
/// cells with x fastest, particles by (cell, id). Variables without values are left out. The values are not copied;
/// they are valid until the state changes.
///
///     /particles/<material>/perCell    number of particles of each cell
///     /particles/<material>/<label>    shape: particles × components along the axes in use
///     /cells/[<material>/]<label>, /nodes/…    shape: z × y × x × components
///     /reductions/<label>              the reducer's bytes, eight to a number
class StoredState {
 public:
  /// Collective over all ranks.
  StoredState(data::Warehouse& warehouse, const StateNames& names);
  /// The datasets for output::writeTogether.
  const std::vector<output::Dataset>& datasets() const { return datasets_; }

 private:
  std::deque<ParticleOrder> orders_;
  std::vector<output::Dataset> datasets_;
};

/// Loads a stored state as the old values, on any patches; each rank reads only what its own patches need. `checks`
/// verifies the bytes that the ranks read, and then the rest of the file. Collective. Throws DamageError, and
/// InputError if a variable of `required` is missing in the file, or is stored there in another form or with another
/// number of values.
void readState(const output::Hdf5Input& file, data::Warehouse& warehouse, const StateNames& names,
               const std::vector<std::string>& required, output::CheckedParts& checks);

}  // namespace tushar::collect
