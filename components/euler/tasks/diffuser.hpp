#pragma once

#include <limits>
#include <numeric>
#include <optional>

#include "components/euler/boundary.hpp"
#include "components/euler/tasks/diffusive_flux.hpp"
#include "components/euler/varying_diffusion.hpp"

namespace tushar::euler {

/// Strain rate sqrt(2 S : S) [1/s], where S is the symmetric part of the velocity gradient; `slope(k, d)` returns
/// dv_k/dx_d.
template <int D, class Slope>
double strainOf(Slope&& slope) {
  double gradient[D][D];
  for (int k = 0; k < D; ++k)
    for (int d = 0; d < D; ++d) gradient[k][d] = slope(k, d);
  double sum = 0;
  for (int k = 0; k < D; ++k)
    for (int d = 0; d < D; ++d) {
      const double s = 0.5 * (gradient[k][d] + gradient[d][k]);
      sum += s * s;
    }
  return std::sqrt(2 * sum);
}

/// The rates at which flow and diffusion cross a cell [1/s].
struct Crossing {
  double byFlow = 0, byDiffusion = 0;
};

/// The diffusing quantities of a cell, and its coefficients.
template <int D>
struct DiffusingCell {
  State<D> w{};                                                      ///< T (in place of the density) and v
  Diffusion how;                                                     ///< viscosity and conductivity without eddies
  double density = 0;                                                ///< density [kg/m³]
  double specificHeat = 0;                                           ///< specific heat c_v [J/(kg K)]
  double soundSpeed = 0;                                             ///< speed of sound [m/s]
  double mostDiffusivity = std::numeric_limits<double>::infinity();  ///< its diffusivities are at most this [m²/s]
};

/// Whether a Diffuser respects the largest diffusivities of cells.
enum class Diffusivities { asGiven, bounded };

/// Computes the diffusive fluxes of blocks of cells with variable viscosity and conductivity. The coefficients at a
/// face are the means of those of the cells on both sides or, if diffusivities are bounded, at most those of the cell
/// with the smaller bound. The subgrid model adds rho (C Delta)² sqrt(2 S : S) to the viscosity, where S is the
/// symmetric part of grad v at the face, and Delta the cube root of a cell's volume. Source: J. Smagorinsky, Mon.
/// Weather Rev. 91 (1963) 99.
template <int D>
class Diffuser {
 public:
  /// Allocates space for the blocks of a patch; the rules at the sides must outlive this object.
  Diffuser(const Level& level, const Box& cells, const GhostRules<D>& rules, double eddies,
           Diffusivities diffusivities = Diffusivities::asGiven)
      : level_(level),
        rules_(rules),
        eddies_(eddies * eddies * std::pow(level.cellVolume(), 2.0 / 3)),
        w_(largestBlock<D>(cells).grown(1, D).size()),
        coefficients_(w_),
        flux_(w_) {
    if (diffusivities == Diffusivities::bounded) most_.emplace(w_);
    for (auto& sides : mirrors_)
      for (SideRules<D>& mirror : sides) {
        mirror.mirrored = true;
        mirror.factor.fill(1);
        mirror.value.fill(0);
      }
  }

  /// Loads the cells of `block` and their neighbours; `cellAt(cell)` returns the diffusing quantities of a cell.
  template <class CellAt>
  void hold(const Box& block, CellAt&& cellAt) {
    for (Rows<D>* rows : {&w_, &coefficients_, &flux_}) rows->hold(block.grown(1, D));
    if (most_) most_->hold(w_.box());
    forEach<D>(level_.clipCells(w_.box()), [&](const Index<D>& cell) {
      const DiffusingCell<D> one = cellAt(cell);
      State<D> coefficients{};
      coefficients[viscosity] = one.how.viscosity;
      coefficients[conductivity] = one.how.conductivity;
      coefficients[density] = one.density;
      store<D>(w_.at(cell), 0, one.w);
      store<D>(coefficients_.at(cell), 0, coefficients);
      if (most_) storeMost(cell, one);
    });
    fillBeyondGrid<D>(level_, rules_, w_);
    fillBeyondGrid<D>(level_, mirrors_, coefficients_);
    if (most_) fillBeyondGrid<D>(level_, mirrors_, *most_);
  }
  /// Computes the fluxes along an axis through the lower faces of the cells of `faces` [Pa and W/m²].
  Rows<D>& computeFluxes(const Box& faces, int axis) {
    const Spacing<D> spacing(level_, w_);
    forEach<D>(faces, [&](const Index<D>& face) {
      store<D>(flux_.at(face), 0, diffusiveFluxAt<D>(atFace(face, axis), w_.at(face), spacing, axis, 0));
    });
    return flux_;
  }
  /// T (in place of the density) and v of the cells.
  const Rows<D>& state() const { return w_; }
  /// Viscosity and conductivity at a face.
  Diffusion atFace(const Index<D>& face, int axis) const {
    return atFace(face, axis, [&] { return strain(face, axis); });
  }
  /// Viscosity and conductivity at a face, with eddies; `strain()` returns sqrt(2 S : S) at the face [1/s].
  template <class Strain>
  Diffusion atFace(const Index<D>& face, int axis, Strain&& strain) const {
    return between(face - Index<D>::unit(axis), face, strain);
  }
  /// The rates at which a cell is crossed: sum_d (|v_d| + k c) / h_d by the flow, and sum_d (nu_below + nu_above) /
  /// h_d² by diffusion. Here nu is the largest diffusivity at a face, and k = `soundSpeedKnob` the fraction of the
  /// speed of sound that is included.
  Crossing crossingOf(const Index<D>& cell, const DiffusingCell<D>& here, double soundSpeedKnob) const {
    Crossing rate;
    for (int d = 0; d < D; ++d) {
      const double perWidth = level_.inverseSpacing(d);
      rate.byFlow += (std::abs(here.w[kVelocity(d)]) + soundSpeedKnob * here.soundSpeed) * perWidth;
      rate.byDiffusion += diffusionAlong(cell, here, d);
    }
    return rate;
  }
  /// The rate (nu_below + nu_above) / h_d² at which diffusion crosses a cell along an axis [1/s]. At a face to a cell
  /// without gas, nu is that of the cell itself.
  double diffusionAlong(const Index<D>& cell, const DiffusingCell<D>& here, int axis) const {
    const auto at = [&](const Index<D>& face, const Index<D>& beyond) {
      const Index<D>& other = coefficients_.number(beyond, density) > 0 ? beyond : cell;
      return between(cell, other, [&] { return strain(face, axis); }).greatest(here.specificHeat, here.density);
    };
    const Index<D> below = cell - Index<D>::unit(axis), above = cell + Index<D>::unit(axis);
    const double perWidth = level_.inverseSpacing(axis);
    return (at(cell, below) + at(above, above)) * perWidth * perWidth;
  }

 private:
  /// Indices of a cell's coefficients.
  enum : std::size_t { viscosity, conductivity, density };

  /// The coefficients at the face between two cells, where the strain rate is `strain()` [1/s].
  template <class Strain>
  Diffusion between(const Index<D>& one, const Index<D>& other, Strain&& strain) const {
    const auto mean = [&](std::size_t k) {
      return 0.5 * (coefficients_.number(one, k) + coefficients_.number(other, k));
    };
    Diffusion here{mean(viscosity), mean(conductivity)};
    if (eddies_ > 0) here.viscosity += mean(density) * eddies_ * strain();
    return most_ ? here.least(mostAt(one)).least(mostAt(other)) : here;
  }
  /// Stores the largest viscosity and conductivity at the faces of a cell; infinite for a cell without gas.
  void storeMost(const Index<D>& at, const DiffusingCell<D>& cell) {
    State<D> most;
    most.fill(std::numeric_limits<double>::infinity());
    if (cell.density > 0) {
      const auto bound = Diffusion::ofDiffusivity(cell.mostDiffusivity, cell.specificHeat, cell.density);
      most[viscosity] = bound.viscosity;
      most[conductivity] = bound.conductivity;
    }
    store<D>(most_->at(at), 0, most);
  }
  Diffusion mostAt(const Index<D>& cell) const {
    return {most_->number(cell, viscosity), most_->number(cell, conductivity)};
  }
  /// Strain rate sqrt(2 S : S) at a face [1/s].
  double strain(const Index<D>& face, int axis) const {
    const Index<D> below = face - Index<D>::unit(axis);
    return strainOf<D>([&](int k, int d) {
      const auto v = [&](const Index<D>& cell) { return w_.number(cell, kVelocity(k)); };
      const Index<D> step = Index<D>::unit(d);
      const double rise = d == axis ? v(face) - v(below)
                                    : 0.25 * ((v(face + step) - v(face - step)) + (v(below + step) - v(below - step)));
      return rise * level_.inverseSpacing(d);
    });
  }

  const Level& level_;
  const GhostRules<D>& rules_;
  GhostRules<D> mirrors_;
  double eddies_;
  Rows<D> w_, coefficients_, flux_;
  std::optional<Rows<D>> most_;  ///< the largest coefficients at the faces of each cell, if diffusivities are bounded
};

/// Adds the diffusion during a step to the cells of a patch: addDiffusion for varying coefficients.
template <int D, class CellAt>
void diffuse(const Patch& patch, Diffuser<D>& diffuser, double dt, CellAt&& cellAt, CellView<Vec<D>> momentum,
             CellView<double> totalEnergy, const DiffusionRims<D>& rims) {
  forEachBlock<D>(patch.cells(), [&](const Box& block) {
    diffuser.hold(block, cellAt);
    for (int axis = 0; axis < D; ++axis) {
      Box faces = block;
      ++faces.upper[axis];
      Rows<D>& flux = diffuser.computeFluxes(faces, axis);
      keepDiffused<D>(rims, faces, axis, flux);
      addDiffused<D>(dt / patch.level().spacing(axis), block, axis, flux, momentum, totalEnergy);
    }
  });
}

/// The rate [1/s] at which diffusion crosses each cell of the patch along each axis, in the places of the velocities;
/// 0 in a cell without gas.
template <int D, class CellAt>
Rows<D> ratesOfDiffusion(const Patch& patch, Diffuser<D>& diffuser, CellAt&& cellAt) {
  Rows<D> rates(patch.cells().size());
  rates.hold(patch.cells());
  forEachBlock<D>(patch.cells(), [&](const Box& block) {
    diffuser.hold(block, cellAt);
    forEach<D>(block, [&](const Index<D>& cell) {
      const DiffusingCell<D> here = cellAt(cell);
      State<D> rate{};
      for (int d = 0; d < D && here.density > 0; ++d) rate[kVelocity(d)] = diffuser.diffusionAlong(cell, here, d);
      store<D>(rates.at(cell), 0, rate);
    });
  });
  return rates;
}

/// The largest rate [1/s] at which flow and diffusion together cross any cell of the patch.
template <int D, class CellAt>
double greatestDiffusionRate(const Patch& patch, Diffuser<D>& diffuser, double soundSpeedKnob, CellAt&& cellAt) {
  double greatest = 0;
  forEachBlock<D>(patch.cells(), [&](const Box& block) {
    diffuser.hold(block, cellAt);
    forEach<D>(block, [&](const Index<D>& cell) {
      const Crossing rate = diffuser.crossingOf(cell, cellAt(cell), soundSpeedKnob);
      greatest = std::max(greatest, rate.byFlow + rate.byDiffusion);
    });
  });
  return greatest;
}

}  // namespace tushar::euler
