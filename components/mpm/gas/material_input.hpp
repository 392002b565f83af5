#pragma once

#include "components/mpm/gas/material.hpp"
#include "core/input/schema.hpp"

namespace tushar::mpm::gas {

/// A tag `geom_object`, as given in the scene.
struct GasObjectSection {
  Location where;
  std::shared_ptr<const input::GeometryPiece> shape;
  Index3 res{{1, 1, 1}};
  std::optional<input::Expression> density, pressure, temperature;
  input::VectorExpression velocity;
  Placement placement = Placement::midpoint;
  int seed = 0;
};

enum class GasType { ideal, stiffened };

/// A tag `constitutive_model`, as given in the scene.
struct GasModelSection {
  Location where;
  GasType type = GasType::ideal;
  double gamma = 1.4, pInfinity = 0;
  double specificHeat = 717.5;
};

/// A tag `material`, as given in the scene.
struct GasSection {
  std::string name;
  std::optional<double> density;
  GasModelSection model;
  std::optional<Relaxation> relaxation;
  std::vector<GasObjectSection> objects;
  double thermalConductivity = 0, specificHeat = 0;
};

struct GasList {
  std::vector<GasSection> materials;
};

/// The section `MaterialProperties`.
struct GasProperties {
  GasList mpm;
};

/// The schema of `MaterialProperties` in scenes with gases.
const input::Schema<GasProperties>& gasProperties();

/// Constructs the gas of a material. `isAlone`: it does not exchange volume with other gases.
Gas makeGas(const GasSection& material, bool isAlone);

}  // namespace tushar::mpm::gas
