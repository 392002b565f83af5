#pragma once

#include "components/mpm/gas/gas_method.hpp"
#include "components/mpm/gas/labels.hpp"
#include "components/mpm/gas/paper/method.hpp"
#include "components/mpm/shapes/linear.hpp"

namespace tushar::mpm::gas::paper {

/// The Material Point Method of Tran, Kim & Berzins for gas dynamics in D dimensions.
///
/// gas_mpm.cpp is the schedule: task by task with the numbers of the paper's equations. The bodies of the tasks are in
/// tasks/.
template <int D>
class GasMpm : public GasMethod<GasDynamics> {
 public:
  using GasMethod::GasMethod;

  void scheduleInitialize(TaskList& tasks) const override;
  void scheduleComputeStableTimeStep(TaskList& tasks) const override;
  void scheduleTimeAdvance(TaskList& tasks) const override;
  std::string advice() const override {
    return "a smaller <cfl>, more particles per cell (<res>), or <redistribute> in <gas_dynamics>";
  }
  void scheduleDiagnostics(TaskList& tasks) const override;
  void scheduleMeasureError(TaskList&, const reference::GasReference&, const reference::Clock&) const override;

 private:
  /// Number of layers of cells around a patch whose particles contribute to the nodes of the patch.
  static constexpr int reach = Linear<D>::reach;

  /// Whether particles keep their mass, so that mass and energy are conserved, instead of using (4)-(5).
  bool conserves() const { return method_.volumeModel == VolumeModel::tracked; }
  void scheduleInterpolateParticlesToGrid(TaskList& tasks) const;
  void scheduleComputeInternalForce(TaskList& tasks) const;
  void scheduleComputeAndIntegrateAcceleration(TaskList& tasks) const;
  void scheduleUpdateParticles(TaskList& tasks) const;
  void scheduleRedistribute(TaskList& tasks) const;
  void scheduleFilterDensity(TaskList& tasks) const;
  void scheduleComputePressure(TaskList& tasks) const;
  void scheduleShareCellVolume(TaskList& tasks) const;
};

extern template class GasMpm<1>;
extern template class GasMpm<2>;
extern template class GasMpm<3>;

}  // namespace tushar::mpm::gas::paper
