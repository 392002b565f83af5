#include "components/mpm/gas/conserving/create_boxes.hpp"

#include "components/mpm/gas/conserving/diagnose.hpp"
#include "components/mpm/gas/tasks/create_particles.hpp"

namespace tushar::mpm::gas::conserving {

namespace {

bool isUniform(const GasObject& object) {
  return object.density.isConstant() && object.pressure.isConstant() && object.velocity.isConstant();
}

const GasObject& objectAt(const Gas& gas, const Vec3& point) {
  for (const GasObject& object : gas.objects)
    if (object.shape->owns(point)) return object;
  return gas.objects.front();
}

/// Integrals of the state of a body over a box.
template <int D>
struct BoxContents {
  double mass = 0, energy = 0;
  Vec<D> momentum = Vec<D>::Zero();
  Modes<D> moments = Modes<D>::Zero();  ///< moments of the momentum: column a - 1 contains momentum times phi_a

  BoxContents& operator+=(const BoxContents& other) {
    mass += other.mass;
    energy += other.energy;
    momentum += other.momentum;
    moments += other.moments;
    return *this;
  }
};

/// The integrands at `offset` from `x`, times a volume [m³].
template <int D>
BoxContents<D> contentsAt(const Level& level, const Gas& gas, const GasObject& object, const Vec<D>& x,
                          const Vec<D>& offset, double volume) {
  const Vec3 point = level.expandPoint<D>(x + offset);
  const double rho = object.density(point), p = object.pressure(point);
  const Vec<D> u = level.reduce<D>(object.velocity(point));
  refuseImpossible(object, point, rho, p, object.velocity(point));
  BoxContents<D> held;
  held.mass = volume * rho;
  held.momentum = held.mass * u;
  held.energy = held.mass * (gas.internalEnergy(rho, p) + 0.5 * u.squaredNorm());
  const auto products = productsOver(offset);
  for (std::size_t a = 1; a < products.size(); ++a)
    held.moments.col(static_cast<int>(a) - 1) = held.mass * products[a] * u;
  return held;
}

/// Sum of `held(offset, volume)` over the Gauss-Legendre points of a box, 3 per axis; bitwise equal for a mirrored box.
template <int D, class Held>
BoxContents<D> sumOverPoints(const Vec<D>& edges, double volume, const Held& held, Vec<D> offset = Vec<D>::Zero(),
                             int axis = 0) {
  if (axis == D) return held(offset, volume);
  const auto along = [&](double at, double weight) {
    offset[axis] = 0.5 * edges[axis] * at;
    return sumOverPoints<D>(edges, volume * weight, held, offset, axis + 1);
  };
  BoxContents<D> sum = along(-std::sqrt(0.6), 5.0 / 18);
  sum += along(std::sqrt(0.6), 5.0 / 18);
  sum += along(0, 8.0 / 18);
  return sum;
}

/// Integrates the state of a body over the box with centre `x`.
template <int D>
BoxContents<D> integrate(const Level& level, const Gas& gas, const GasObject& object, const Vec<D>& x,
                         const Vec<D>& edges) {
  return sumOverPoints<D>(edges, edges.prod() * crossSection<D>(level), [&](const Vec<D>& offset, double volume) {
    return contentsAt<D>(level, gas, object, x, offset, volume);
  });
}

/// Throws InputError if a stiffened gas does not fill the grid, because nothing would then balance the pressure p +
/// p_inf that it exerts: if a side of the grid is free or, with only one gas, if `boxes` leave a part of the patch
/// empty.
template <int D>
void refuseLooseness(const Patch& patch, const Gas& gas, const std::vector<Vec<D>>& boxes) {
  if (gas.pInfinity == 0) return;
  const Level& level = patch.level();
  const auto fail = [&](const std::string& why) {
    throw InputError({{gas.where, "MaterialProperties/MPM/material/constitutive_model", why}});
  };
  for (int d = 0; d < D; ++d)
    for (const int side : {0, 1})
      if (!level.isPeriodic(d) && !level.isSymmetry(d, side))
        fail("type: a stiffened_gas needs a grid whose sides are symmetry planes or periodic");
  if (gas.carried > 0) return;
  double all = static_cast<double>(patch.cells().size()), filled = 0;
  for (int d = 0; d < D; ++d) all *= level.spacing(d);
  for (const Vec<D>& box : boxes) filled += box.prod();
  if (!(filled > (1 - 1e-9) * all))
    fail(fmt::format("type: a stiffened_gas must fill the grid, and {:.3g} % of patch {} is empty",
                     100 - 100 * filled / all, patch.id()));
}

}  // namespace

template <int D>
void createBoxes(const Patch& patch, const Gas& gas, ParticleMaker& maker, const NewBoxes<D>& boxes) {
  const Level& level = patch.level();
  std::vector<double> density;
  createParticles<D>(patch, gas, maker, boxes.x, boxes.velocity, density, boxes.internalEnergy);
  for (std::size_t k = 0; k < boxes.x.size(); ++k) {
    const GasObject& object = objectAt(gas, level.expandPoint<D>(boxes.x[k]));
    Vec<D> edges, inertia;
    for (int d = 0; d < D; ++d) {
      edges[d] = level.spacing(d) / object.particlesPerCell[level.axis(d)];
      inertia[d] = edges[d] * edges[d] / 12;
    }
    boxes.edges.push_back(edges);
    boxes.mass.push_back(density[k] * edges.prod() * crossSection<D>(level));
    boxes.modes.push_back(Modes<D>::Zero());
    boxes.affineEnergy.push_back(0);
    if (isUniform(object)) continue;
    const BoxContents<D> held = integrate<D>(level, gas, object, boxes.x[k], edges);
    boxes.mass[k] = held.mass;
    boxes.velocity[k] = held.momentum / held.mass;
    const auto products = productsOver(inertia);
    Modes<D>& modes = boxes.modes[k];
    for (std::size_t a = 1; a < products.size(); ++a)
      modes.col(static_cast<int>(a) - 1) = held.moments.col(static_cast<int>(a) - 1) / (held.mass * products[a]);
    boxes.affineEnergy[k] = modalEnergy<D>(modes, inertia);
    boxes.internalEnergy[k] = held.energy / held.mass - 0.5 * boxes.velocity[k].squaredNorm() - boxes.affineEnergy[k];
  }
  refuseLooseness<D>(patch, gas, boxes.edges);
}

template void createBoxes<1>(const Patch&, const Gas&, ParticleMaker&, const NewBoxes<1>&);
template void createBoxes<2>(const Patch&, const Gas&, ParticleMaker&, const NewBoxes<2>&);
template void createBoxes<3>(const Patch&, const Gas&, ParticleMaker&, const NewBoxes<3>&);

}  // namespace tushar::mpm::gas::conserving
