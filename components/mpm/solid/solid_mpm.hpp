#pragma once

#include "components/mpm/solid/contact/contact.hpp"
#include "components/mpm/solid/material.hpp"
#include "components/mpm/solid/method.hpp"
#include "components/mpm/solid/shapes/tensor_shape.hpp"
#include "core/core.hpp"

namespace tushar::mpm::solid {

/// The Material Point Method for solids: Sulsky, Chen & Schreyer, Comput. Methods Appl. Mech. Engrg. 118 (1994) 179, step
/// by step as Uintah takes it, stress last.
///
/// solid_mpm.cpp is the schedule and reads as the method; the bodies of its tasks are in tasks/.
template <class Shape>
class SolidMpm : public Component {
 public:
  SolidMpm(Method method, std::vector<Material> materials, std::vector<Contact> contacts)
      : method_(method), materials_(std::move(materials)), contacts_(std::move(contacts)) {}

  const Method& method() const { return method_; }
  const std::vector<Material>& materials() const { return materials_; }

  void scheduleInitialize(TaskList& tasks) const override;
  void scheduleComputeStableTimeStep(TaskList& tasks) const override;
  void scheduleTimeAdvance(TaskList& tasks) const override;
  void scheduleDiagnostics(TaskList& tasks) const override;

 private:
  static constexpr int D = Shape::dimension;

  void scheduleInterpolateParticlesToGrid(TaskList& tasks) const;
  void scheduleComputeInternalForce(TaskList& tasks) const;
  void scheduleIntegrateAcceleration(TaskList& tasks) const;
  void scheduleUpdateParticles(TaskList& tasks) const;
  void scheduleComputeStressTensor(TaskList& tasks) const;

  Method method_;
  std::vector<Material> materials_;
  std::vector<Contact> contacts_;
};

}  // namespace tushar::mpm::solid
