#pragma once

#include "components/euler/diffusion.hpp"
#include "components/euler/euler.hpp"
#include "components/ice/gas_input.hpp"
#include "core/simulation/catalogue.hpp"

namespace tushar::ice {

/// A compressible gas by the words of Uintah's ICE: the schedule of `euler`, and behind it viscosity, conduction of
/// heat and gravity where a scene has them.
template <int D>
class Ice : public euler::Euler<D> {
 public:
  explicit Ice(const GasScene& scene)
      : euler::Euler<D>(scene.gas),
        name_(scene.gas.name),
        gas_(scene.gas.gas),
        cfl_(scene.gas.cfl),
        diffusion_{scene.viscosity, scene.conductivity},
        gravity_(scene.gravity) {}

  void scheduleComputeStableTimeStep(TaskList& tasks) const override;
  void scheduleTimeAdvance(TaskList& tasks) const override;
  void scheduleDiagnostics(TaskList& tasks) const override;
  std::string advice() const override { return "a smaller CFD/cfl, or CFD/ICE/advection of type FirstOrder"; }
  std::vector<std::string> foreignLabels() const override;
  std::vector<std::pair<std::string, std::string>> otherNames() const override;
  std::vector<std::string> gasNames() const override { return {name_}; }

 private:
  std::string name_;
  euler::Gas gas_;
  double cfl_;
  euler::Diffusion diffusion_;
  Vec3 gravity_;
};

extern template class Ice<1>;
extern template class Ice<2>;
extern template class Ice<3>;

/// The entry of this component in the table of sus.
simulation::ComponentKind kind();

}  // namespace tushar::ice
