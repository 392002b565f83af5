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
      : settings_(settings), cells_(cells), bound_(level, diffusivityAtStart) {}

  /// The cells of a box whose gas is so thin that its diffusivities may be bounded.
  std::vector<Index<D>> thinCells(const Box& box) const {
    std::vector<Index<D>> thin;
    forEach<D>(box, [&](const Index<D>& cell) {
      if (isThin(cell)) thin.push_back(cell);
    });
    return thin;
  }
  /// The coefficients at a face between two cells.
  euler::Diffusion between(const Index<D>& cell, const Index<D>& next) const {
    const euler::Diffusion one = in(cell), other = in(next);
    return {std::min(one.viscosity, other.viscosity), std::min(one.conductivity, other.conductivity)};
  }

 private:
  bool isThin(const Index<D>& cell) const {
    return !cells_.isEmpty(cell) && uniform().greatest(gas(), density(cell)) > bound_.always();
  }
  const euler::Gas& gas() const { return settings_.gas.gas; }
  const euler::Diffusion& uniform() const { return settings_.diffusion.alone.uniform; }
  double density(const Index<D>& cell) const { return cells_.held.density[cell] / cells_.free[cell]; }
  euler::Diffusion in(const Index<D>& cell) const {
    if (!isThin(cell)) return uniform();
    const euler::State<D> w = cells_.primitive(gas(), cell);
    const double rho = w[euler::kDensity], c = std::sqrt(gas().soundSpeedSquared(rho, w[euler::kPressure<D>]));
    const double most = rho * bound_.at(c);
    return {std::min(uniform().viscosity, 0.75 * most), std::min(uniform().conductivity, gas().specificHeat * most)};
  }

  const Settings& settings_;
  const GasInCells<D>& cells_;
  DiffusivityBound bound_;
};

/// Finds the largest diffusivity of the gas on a patch [m²/s].
template <int D>
void measureDiffusivity(const Patch& patch, const Settings& settings, const GasInCells<D>& cells, Maximum& greatest) {
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    if (cells.isEmpty(cell)) return;
    const euler::DiffusingCell<D> one = diffusingAt<D>(patch.level(), settings, cells, cell);
    const double heat = one.how.conductivity > 0 ? one.how.conductivity / one.specificHeat : 0;
    greatest.add(std::max(4.0 / 3 * one.how.viscosity, heat) / one.density);
  });
}

}  // namespace tushar::mpmice
