#pragma once

#include "components/mpm/solid/implicit/shapes.hpp"
#include "core/core.hpp"

namespace tushar::mpm::solid::implicit {

/// The Material Point Method with implicit time steps, like Uintah's impm: Guilkey & Weiss, Int. J. Numer. Meth. Engng
/// 57 (2003) 1323. The displacement of the nodes in a step solves a non-linear system (see ImplicitSystem).
template <int D>
class ImplicitMpm : public Solids {
 public:
  /// `shapes` must outlive this object.
  ImplicitMpm(Problem problem, const ImplicitShapes<D>& shapes, ImplicitMethod how);

  std::string whyOneLevel() const override { return "implicit steps solve one system over the whole grid"; }
  void scheduleInitialize(TaskList& tasks) const override;
  void scheduleComputeStableTimeStep(TaskList& tasks) const override;
  void scheduleTimeAdvance(TaskList& tasks) const override;
  void scheduleDiagnostics(TaskList& tasks) const override;
  bool mayRepeatStep() const override { return true; }

 private:
  void scheduleStartingAcceleration(TaskList& tasks) const;
  void scheduleMovement(TaskList& tasks) const;
  void scheduleVelocity(TaskList& tasks) const;
  void scheduleHeat(TaskList& tasks) const;

  bool isHeatedByLoads() const { return how_.conductsHeat && problem_.start.loads.hasHeat(); }
  ImplicitSetup<D> setup() const { return {&problem_, shapes_, how_, state_size_}; }

  const ImplicitShapes<D>* shapes_;
  ImplicitMethod how_;
  bool heats_;          ///< whether the work of a step changes the temperature of some material
  bool is_damageable_;  ///< whether some material accumulates damage
};

}  // namespace tushar::mpm::solid::implicit
