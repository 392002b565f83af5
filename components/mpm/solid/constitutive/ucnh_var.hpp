#pragma once

#include <span>

#include "components/mpm/particles/drawn.hpp"
#include "components/mpm/solid/by_color.hpp"
#include "components/mpm/solid/constitutive/ucnh.hpp"

namespace tushar::mpm::solid {

/// UCNH with constants for each particle: as functions of p.color, or with a random yield stress in [Y - range, Y +
/// range].
struct UcnhVar {
  using Common = NeoHookPlastic<false>;
  struct State {
    double plasticStrain;     ///< alpha [1]
    Tensor bElBar;            ///< J^(-2/3) F_e F_eᵀ [1]
    double bulkModulus;       ///< bulk modulus K [Pa]
    double shearModulus;      ///< shear modulus G [Pa]
    double yieldStress;       ///< yield stress Y [Pa]
    double hardeningModulus;  ///< hardening modulus H [Pa]
  };
  using Capabilities =
      CapabilityList<capability::IgnoresTemperature, capability::BulkSpeed, capability::InitialWaveSpeed,
                     capability::InitialVolumeRatio, capability::StateByParticle>;
  static constexpr std::array<StateVariable, 6> stateVariables{
      {Common::stateVariables[0],
       Common::stateVariables[1],
       {"p.bulkModulus", "Pa", "bulk modulus of the particle"},
       {"p.shearModulus", "Pa", "shear modulus of the particle"},
       {"p.yieldStress", "Pa", "yield stress of the particle, without hardening"},
       {"p.hardeningModulus", "Pa", "growth of the particle's yield stress with its plastic strain"}}};
  static constexpr std::string_view name = "UCNHVar";
  static constexpr bool strainEnergyIsRate = false;
  static constexpr std::size_t mostEntries = 32;

  /// The constants of particles of one color.
  struct Entry {
    double color = 0, bulkModulus = 0, shearModulus = 0, yieldStress = 0, hardeningModulus = 0;
  };

  bool isPlastic = false;
  std::array<Entry, mostEntries> entries{};  ///< entries in order of increasing color
  std::size_t count = 0;                     ///< number of entries
  double initialPlasticStrain = 0;           ///< initial plastic strain [1]
  double startVolumeRatio = 1;               ///< initial det F
  double yieldRange = 0;                     ///< largest deviation of the yield stress [Pa]
  int yieldSeed = 0;

  static const input::Schema<UcnhVar>& schema() {
    static const input::Schema<UcnhVar> schema = makeSchema();
    return schema;
  }
  /// The given model with a random yield stress for each particle.
  template <class Model>
  static UcnhVar spread(const Model& model) {
    UcnhVar result;
    result.isPlastic = true;
    result.entries[0] = {0, model.bulkModulus, model.shearModulus, *model.yieldStress, *model.hardeningModulus};
    result.count = 1;
    result.initialPlasticStrain = model.initialPlasticStrain;
    result.startVolumeRatio = model.initialVolumeRatio();
    result.yieldRange = model.yieldRange;
    result.yieldSeed = model.yieldSeed;
    return result;
  }
  std::span<const Entry> table() const { return {entries.data(), count}; }

  double initialVolumeRatio() const { return startVolumeRatio; }
  State initialState() const { return initialState({0, table().front().color}); }
  State initialState(const Birth& birth) const {
    const auto of = [&](double Entry::*constant) { return valueByColor(table(), birth.color, constant); };
    const double shift =
        yieldRange > 0 ? (2 * drawn(Drawing::yieldStress, yieldSeed, birth.id, 0) - 1) * yieldRange : 0;
    return {initialPlasticStrain,
            identityTensor,
            of(&Entry::bulkModulus),
            of(&Entry::shearModulus),
            of(&Entry::yieldStress) + shift,
            of(&Entry::hardeningModulus)};
  }
  Matrix3 updateStress(const Deformation& d, const Matrix3& oldStress, State& state) const {
    Common::State common{state.plasticStrain, state.bElBar};
    const Matrix3 stress = modelOf(state).updateStress(d, oldStress, common);
    state.plasticStrain = common.plasticStrain;
    state.bElBar = common.bElBar;
    return stress;
  }
  /// Wave speed of the stiffest particles [m/s].
  double initialWaveSpeed(double initialDensity) const {
    double modulus = 0;
    for (const Entry& entry : table()) modulus = std::max(modulus, entry.bulkModulus + 4.0 / 3.0 * entry.shearModulus);
    return std::sqrt(modulus / initialDensity);
  }
  double waveSpeed(double initialDensity, const Deformation& d, const Matrix3& stress, const State& state) const {
    return modelOf(state).waveSpeed(initialDensity, d, stress, commonOf(state));
  }
  double bulkSpeed(double initialDensity, const Deformation& d, const Matrix3& stress, const State& state) const {
    return modelOf(state).bulkSpeed(initialDensity, d, stress, commonOf(state));
  }
  double strainEnergyDensity(const Deformation& d, const Matrix3& oldStress, const Matrix3& stress,
                             const State& state) const {
    return modelOf(state).strainEnergyDensity(d, oldStress, stress, commonOf(state));
  }

 private:
  struct Table {
    std::vector<Entry> entries;
  };

  static Common::State commonOf(const State& state) { return {state.plasticStrain, state.bElBar}; }
  Common modelOf(const State& state) const {
    Common model;
    model.bulkModulus = state.bulkModulus;
    model.shearModulus = state.shearModulus;
    model.isPlastic = isPlastic;
    model.yieldStress = state.yieldStress;
    model.hardeningModulus = state.hardeningModulus;
    return model;
  }

  static const input::Schema<Table>& tableSchema() {
    static const input::Schema<Entry> entry =
        input::Schema<Entry>("entry", "The constants of particles of one color.")
            .required("color", &Entry::color, "1", "p.color of the particles")
            .required("bulk_modulus", &Entry::bulkModulus, "Pa", "K", input::positive())
            .required("shear_modulus", &Entry::shearModulus, "Pa", "G", input::positive())
            .required("yield_stress", &Entry::yieldStress, "Pa", "yield stress in uniaxial tension", input::positive())
            .required("hardening_modulus", &Entry::hardeningModulus, "Pa",
                      "growth of the yield stress with the plastic strain", input::nonNegative());
    static const input::Schema<Table> schema =
        input::Schema<Table>("variable_properties", "Constants as a function of p.color, linear between the entries.")
            .list("entry", &Table::entries, entry, "constants for one color, in order of increasing color", 1);
    return schema;
  }
  static void readTable(UcnhVar& read, const input::Element& element, input::Diagnostics& diagnostics) {
    const auto given = element.child("variable_properties");
    if (!given)
      return diagnostics.error(element, "missing tag <variable_properties> (constants as a function of p.color)");
    const Table table = tableSchema().read(*given, diagnostics);
    if (table.entries.size() > mostEntries || !growsInColor(table.entries))
      return diagnostics.error(*given, "takes at most 32 entries, in order of increasing <color>");
    std::copy(table.entries.begin(), table.entries.end(), read.entries.begin());
    read.count = table.entries.size();
  }
  static input::Schema<UcnhVar> makeSchema() {
    input::Schema<UcnhVar> tags(name, "UCNH with constants that depend on the color of the particle.");
    tags.value("usePlasticity", &UcnhVar::isPlastic, false, "1", "whether the material yields")
        .custom("variable_properties", readTable, {"variable_properties"}, "constants as a function of p.color",
                [](std::ostream& out, int indent) { tableSchema().describeContents(out, indent); })
        .forms({input::sectionForm(
            {"variable_properties"},
            [] {
              return std::vector<input::Alternative>{{&tableSchema(), {}}};
            },
            1)})
        .ignored("useModifiedEOS", "only the fluid coupling of Uintah uses it")
        .ignored("initial_pressure", "belongs to useInitialStress");
    refuseSwitch(tags, "useInitialStress", "bodies start without stress");
    return tags;
  }
};
static_assert(ConstitutiveModel<UcnhVar>);

}  // namespace tushar::mpm::solid
