#pragma once

#include "components/mpm/gas/conserving/labels.hpp"
#include "components/mpm/gas/conserving/rows.hpp"
#include "components/mpm/gas/conserving/scheme.hpp"
#include "components/mpm/gas/conserving/two_slabs.hpp"
#include "components/mpm/gas/material.hpp"
#include "components/mpm/gas/mirror_symmetry.hpp"
#include "components/mpm/gas/symmetry_planes.hpp"

namespace tushar::mpm::gas::conserving {

/// The gradients of the shape functions of the nodes of a cell, at its centre [1/m].
template <int D>
std::array<Vec<D>, Linear<D>::nodes> centreGradients(const Level& level) {
  std::array<Vec<D>, Linear<D>::nodes> gradients;
  for (int k = 0; k < Linear<D>::nodes; ++k) gradients[static_cast<std::size_t>(k)] = centreGradient<D>(level, k);
  return gradients;
}

/// The gradient at the centres of cells of a vector field, from TwoSlabs of its values at nodes; the lowest nodes of
/// the cells are those of `cells`.
template <int D, class Slabs>
[[gnu::always_inline]] inline LanesTensor<D> gradientIn(const std::array<Vec<D>, Linear<D>::nodes>& gradients,
                                                        const RowPart<D>& cells, Slabs& slabs) {
  slabs.moveTo(cells.first[D - 1] + 1);
  return sumOverCorners<D>([&](int k) __attribute__((always_inline)) {
    const LanesVec<D> v = matrixOf<D, 1>(slabs.at(cells + Linear<D>::node({}, k)));
    LanesTensor<D> share;
    for (int d = 0; d < D; ++d) share.col(d) = gradients[static_cast<std::size_t>(k)][d] * v;
    return share;
  });
}

/// Computes dv_j/dx_k at the centre of each cell from the velocities of its nodes [1/s].
template <int D>
void computeVelocityGradient(const Patch& patch, const Gas&, NodeView<const Vec<D>> velocity,
                             CellView<Tensor<D>> gradient) {
  const auto gradients = centreGradients<D>(patch.level());
  auto slabs = twoSlabs<D, 1>(
      patch.nodes(), [&](const RowPart<D>& nodes) __attribute__((always_inline)) { return load(velocity, nodes); });
  forEachRowPart<D>(patch.cells(),
                    [&](const RowPart<D>& cells) { store(gradientIn<D>(gradients, cells, slabs), gradient, cells); });
}

/// Pressure, artificial viscosity and shock sensor of cells; one cell per lane.
struct CellState {
  Lanes pressure = 0, viscosity = 0, shock = 1;
};

/// The compression of cells and of their neighbours along the axes. The velocity difference across a cell along an axis
/// d is dv_d/dx_d times the smallest cell width h; Delta is the sum of these differences over the axes [m/s].
struct Compression {
  Lanes difference = 0;  ///< Delta of the cell
  Lanes smooth = 0;      ///< J_0: Delta minus van Leer's harmonic means with the differences of neighbours
  Lanes nearby = 0;      ///< largest -Delta of the neighbours
};

/// The artificial viscosity q under compression, Delta < 0:  rho |Delta| (C_q |Delta| + C_l c).
CellState shockViscosity(Lanes pressure, Lanes density, Lanes soundSpeed, Lanes difference, const Viscosity& viscosity);

/// The artificial viscosity q = rho |J| (C_q |J| + C_l c) where the gas is compressed, with J = Delta at shocks and J =
/// J_0 where the flow is smooth; s = min(1, 10 max(0, -Delta / c - .05)) blends the two. Where the gas expands next to
/// a compressed cell, q is negative, at least -0.4 p: this removes the overshoot behind a shock.
CellState smoothViscosity(Lanes pressure, Lanes density, Lanes soundSpeed, const Compression& compression,
                          const Viscosity& viscosity);

/// Computes p = (gamma - 1) IE_c / V_c, q by shockViscosity (apic) or smoothViscosity (affineFlip), and the sensor of
/// shocks. A cell at the rim of the grid counts as its own neighbour beyond the rim.
template <int D, class Scheme>
void computePressure(const Patch& patch, const Gas& gas, const Viscosity& viscosity, CellView<const double> mass,
                     CellView<const double> internalEnergy, CellView<const Tensor<D>> gradient,
                     CellView<double> pressure, CellView<double> artificial, CellView<double> shock);

/// Computes the stress on the faces of a cell [Pa]. apic: p + q. affineFlip: P cof(I + dt/2 grad v), which refers to
/// the positions of the faces half a step later. P = p clamp(1 - gamma dt div v / 2, .3, 2) + q is the pressure at that
/// time.
template <int D, class Scheme>
void computeStress(const Patch& patch, const Gas& gas, CellView<const double> pressure,
                   CellView<const double> artificial, CellView<const Tensor<D>> gradient, double dt,
                   CellView<Tensor<D>> stress);

/// The product of a stress and the gradient of a shape function, of one cell or of one per lane.
template <int D, class Stress>
[[gnu::always_inline]] inline auto timesGradient(const Stress& stress, const Vec<D>& gradient) {
  Eigen::Matrix<typename Stress::Scalar, D, 1, Eigen::DontAlign> force = gradient[0] * stress.col(0);
  for (int d = 1; d < D; ++d) force += gradient[d] * stress.col(d);
  return force;
}

/// Computes a_i = sum over the cells c around node i of V_c T_c grad S_i / m_i; a_i is 0 at nodes without mass, and has
/// no component normal to symmetry planes. Cells outside `stress.box()` have no stress.
template <int D>
void computeAcceleration(const Patch& patch, const Gas&, CellView<const Tensor<D>> stress, NodeView<const double> mass,
                         NodeView<Vec<D>> acceleration) {
  const double volume = patch.level().cellVolume();
  const auto gradients = centreGradients<D>(patch.level());
  auto slabs = twoSlabs<D, D>(
      stress.box(), [&](const RowPart<D>& cells) __attribute__((always_inline)) { return load(stress, cells); });
  const auto inside = [&](const RowPart<D>& nodes) {
    slabs.moveTo(nodes.first[D - 1]);
    const LanesVec<D> force = sumOverCorners<D>([&](int k) __attribute__((always_inline)) {
      const LanesTensor<D> there = matrixOf<D, D>(slabs.at(nodes + (Index<D>{} - Linear<D>::node({}, k))));
      return timesGradient<D>(there, gradients[static_cast<std::size_t>(k)]);
    });
    const Lanes m = load(mass, nodes), perMass = volume / m;
    LanesVec<D> a;
    for (int d = 0; d < D; ++d) a[d] = select(m > 0, perMass * force[d], 0);
    store(a, acceleration, nodes);
  };
  const auto atRim = [&](const Index<D>& node) {
    const Vec<D> force = sumOverCorners<D>([&](int k) __attribute__((always_inline))->Vec<D> {
      const Index<D> cell = node - (Linear<D>::node(node, k) - node);
      if (!stress.box().contains(cell)) return Vec<D>::Zero();
      return timesGradient<D>(stress[cell], gradients[static_cast<std::size_t>(k)]);
    });
    acceleration[node] = mass[node] > 0 ? Vec<D>(volume / mass[node] * force) : Vec<D>::Zero();
  };
  forEachNodeOf<D>(patch.nodes(), stress.box(), inside, atRim);
  stopAtSymmetryPlanes<D>(patch, acceleration);
}

/// Computes beta_i, the largest shock sensor of the cells around a node.
template <int D>
void computeRelaxation(const Patch& patch, const Gas&, CellView<const double> shock, NodeView<double> relaxation) {
  const auto inside = [&](const RowPart<D>& nodes) {
    Lanes greatest = 0;
    for (int k = 0; k < Linear<D>::nodes; ++k)
      greatest = max(greatest, load(shock, nodes + (Index<D>{} - Linear<D>::node({}, k))));
    store(greatest, relaxation, nodes);
  };
  forEachNodeOf<D>(patch.nodes(), shock.box(), inside, [&](const Index<D>& node) {
    double greatest = 0;
    for (int k = 0; k < Linear<D>::nodes; ++k) {
      const Index<D> cell = node - (Linear<D>::node(node, k) - node);
      if (shock.box().contains(cell)) greatest = std::max(greatest, shock[cell]);
    }
    relaxation[node] = greatest;
  });
}

/// Computes -dt V_c T_c : grad(v + dt a / 2) [J], the work of the forces of computeAcceleration on the gas in a cell.
template <int D>
double workOnCell(const Level& level, const Tensor<D>& stress, const NodeView<const Vec<D>>& velocity,
                  const NodeView<const Vec<D>>& acceleration, double dt, const Index<D>& cell) {
  const double power = sumOverCorners<D>([&](int k) __attribute__((always_inline))->double {
    const Index<D> node = Linear<D>::node(cell, k);
    return (velocity[node] + 0.5 * dt * acceleration[node]).dot(stress * centreGradient<D>(level, k));
  });
  return -dt * level.cellVolume() * power;
}

/// Computes f_c = -dt V_c T_c : grad(v + dt a / 2) / IE_c, the work of the forces of computeAcceleration.
template <int D>
void computeWork(const Patch& patch, const Gas&, CellView<const Tensor<D>> stress,
                 CellView<const double> internalEnergy, NodeView<const Vec<D>> velocity,
                 NodeView<const Vec<D>> acceleration, double dt, CellView<double> work) {
  const auto gradients = centreGradients<D>(patch.level());
  const double scale = -dt * patch.level().cellVolume();
  auto slabs = twoSlabs<D, 1>(
      patch.nodes(), [&](const RowPart<D>& nodes) __attribute__((always_inline)) {
        return LanesVec<D>(load(velocity, nodes) + (0.5 * dt) * load(acceleration, nodes));
      });
  forEachRowPart<D>(patch.cells(), [&](const RowPart<D>& cells) {
    const LanesTensor<D> gradient = gradientIn<D>(gradients, cells, slabs);
    const LanesTensor<D> t = load(stress, cells);
    Lanes power = 0;
    for (int d = 0; d < D; ++d) power += t.col(d).dot(gradient.col(d));
    const Lanes energy = load(internalEnergy, cells);
    store(select(energy > 0, scale * power / energy, 0), work, cells);
  });
}

}  // namespace tushar::mpm::gas::conserving
