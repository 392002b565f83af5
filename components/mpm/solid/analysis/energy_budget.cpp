#include "components/mpm/solid/analysis/energy_budget.hpp"

#include <algorithm>
#include <stdexcept>

#include "components/mpm/solid/cohesive/zone_labels.hpp"
#include "components/mpm/solid/constitutive/comp_mooney_rivlin.hpp"
#include "components/mpm/solid/constitutive/comp_neo_hook.hpp"
#include "components/mpm/solid/explicit/solid_mpm.hpp"
#include "components/mpm/solid/explicit/tasks/measure_work.hpp"
#include "core/simulation/plain_module.hpp"

namespace tushar::mpm::solid {

namespace {

/// Whether all strain work is stored as a function of F; then StrainEnergy is exact, even for large strains in one
/// step.
bool storesAllStrain(const Problem& problem) {
  return !problem.start.solution &&
         std::all_of(problem.materials.begin(), problem.materials.end(), [](const Material& material) {
           const auto name = material.model->name();
           return !material.isDamageable() && (name == CompNeoHook::name || name == CompMooneyRivlin::name);
         });
}

class EnergyBudget : public simulation::Analysis {
 public:
  EnergyBudget(bool storesAllStrain, bool hasZones) : stores_all_strain_(storesAllStrain), has_zones_(hasZones) {}

  bool takesSeveralBoxes() const override { return true; }
  void schedule(TaskList&) const override {}
  void setTime(double, double) override {}
  std::vector<simulation::EnergyTerm> energies() const override {
    using enum simulation::EnergyTerm::Side;
    std::vector<simulation::EnergyTerm> terms{
        {"kinetic energy at the start", &total::work[works::start], came},
        {"work of loads and gravity", &total::work[works::external], came},
        {"work of faces of the grid", &total::work[works::boundary], came},
        {"work of contact", &total::work[works::contact], came},
        {"kinetic energy", &total::kineticEnergy, went},
        {"strain", stores_all_strain_ ? &total::strainEnergy : &total::work[works::strain], went},
        {"plastic flow", &total::work[works::plastic], went},
        {"viscosity and damping", &total::work[works::dissipated], went}};
    if (has_zones_) terms.push_back({"cohesive zones", &total::cohesiveWork, went});
    return terms;
  }

 private:
  bool stores_all_strain_, has_zones_;
};

std::unique_ptr<simulation::Analysis> makeModule(const Component& component, const Level&) {
  const auto* solids = dynamic_cast<const Solids*>(&component);
  if (!solids || !solids->measuresWork())
    throw std::invalid_argument(
        "the energy budget is available only for solids with explicit time steps; remove the module");
  const Problem& problem = solids->problem();
  return std::make_unique<EnergyBudget>(storesAllStrain(problem), !problem.zones.empty());
}

}  // namespace

simulation::AnalysisKind energyBudgetKind() {
  return simulation::plainModule("energyBudget", "sources and sinks of the energy of solids",
                                 "The energy budget of solids in the report.", makeModule);
}

}  // namespace tushar::mpm::solid
