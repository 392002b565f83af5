#pragma once

#include "components/mpmice/gas_diffusion.hpp"

namespace tushar::mpmice {

/// The bound on diffusivities in thin gas, such as the traces of gas behind a body that leaves a wall. Viscosity and
/// conductivity do not depend on the density, so that the diffusivity nu, about the speed of sound c times the mean
/// free path, grows without limit as the density falls. Where the mean free path exceeds a cell, fluxes no longer
/// follow from gradients: molecules carry at most about rho c times a difference. So diffusivities are at most c h,
/// where h is the smallest cell width, or ten times the largest one at the start of the run, if that is more. Source:
/// the free-molecular limit, S. Chapman & T. G. Cowling, The Mathematical Theory of Non-Uniform Gases (1970),
/// sections 5.2 and 6.2.
class DiffusivityBound {
 public:
  /// `atStart`: the largest diffusivity at the start of the run [m²/s].
  DiffusivityBound(const Level& level, double atStart)
      : width_(level.spacing(0)), always_(10 * std::max(0.0, atStart)) {
    for (int d = 1; d < level.dimension(); ++d) width_ = std::min(width_, level.spacing(d));
  }

  /// The diffusivity up to which gas diffuses whatever its speed of sound [m²/s].
  double always() const { return always_; }
  /// The largest diffusivity [m²/s] in a gas with a given speed of sound [m/s].
  double at(double soundSpeed) const { return std::max(soundSpeed * width_, always_); }

 private:
  double width_, always_;
};

/// Uniform viscosity and conductivity, bounded in thin gas.
template <int D>
class BoundedDiffusion {
 public:
  BoundedDiffusion(const Level& level, const Settings& settings, const GasInCells<D>& cells, double diffusivityAtStart)
      : gas_(settings.gas.gas),
        uniform_(settings.diffusion.alone.uniform),
        cells_(cells),
        bound_(level, diffusivityAtStart),
        thin_(uniform_.greatest(gas_, bound_.always())) {}

  /// The cells of a box whose gas is so thin that its diffusivities may be bounded.
  std::vector<Index<D>> thinCells(const Box& box) const {
    std::vector<Index<D>> thin;
    forEach<D>(box, [&](const Index<D>& cell) {
      if (isThin(cell)) thin.push_back(cell);
    });
    return thin;
  }
  /// The coefficients at a face between two cells.
  euler::Diffusion between(const Index<D>& cell, const Index<D>& next) const { return in(cell).least(in(next)); }

 private:
  bool isThin(const Index<D>& cell) const {
    return cells_.held.density[cell] < thin_ * cells_.free[cell] && !cells_.isEmpty(cell);
  }
  euler::Diffusion in(const Index<D>& cell) const {
    if (!isThin(cell)) return uniform_;
    const euler::State<D> w = cells_.primitive(gas_, cell);
    const double rho = w[euler::kDensity], c = std::sqrt(gas_.soundSpeedSquared(rho, w[euler::kPressure<D>]));
    return uniform_.least(euler::Diffusion::ofDiffusivity(bound_.at(c), gas_.specificHeat, rho));
  }

  const euler::Gas& gas_;
  const euler::Diffusion& uniform_;
  const GasInCells<D>& cells_;
  DiffusivityBound bound_;
  double thin_;  ///< density below which diffusivities, which rise as it falls, may be bounded [kg/m³]
};

/// Finds the largest diffusivity of the gas on a patch [m²/s].
template <int D>
void measureDiffusivity(const Patch& patch, const Settings& settings, const GasInCells<D>& cells, Maximum& greatest) {
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    if (cells.isEmpty(cell)) return;
    const euler::DiffusingCell<D> one = diffusingAt<D>(patch.level(), settings, cells, cell);
    greatest.add(one.how.greatest(one.specificHeat, one.density));
  });
}

}  // namespace tushar::mpmice
