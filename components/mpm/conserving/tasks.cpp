#include "components/mpm/conserving/tasks.hpp"

#include "components/mpm/tasks/create_particles.hpp"
#include "components/mpm/tasks/redistribute.hpp"

namespace tushar::mpm::conserving {

namespace {

double crossSection(const Level& level) { return level.cellVolume() / level.spacing(0); }

}  // namespace

void createParticles(const Patch& patch, const Gas& gas, ParticleMaker& maker, std::vector<Vec<1>>& x,
                     std::vector<double>& length, std::vector<double>& mass, std::vector<Vec<1>>& velocity,
                     std::vector<double>& gradient, std::vector<double>& internalEnergy,
                     std::vector<double>& affineEnergy) {
  const Level& level = patch.level();
  std::vector<double> density;
  mpm::createParticles<1>(patch, gas, maker, x, velocity, density, internalEnergy);
  std::vector<int> inCell(patch.cells().size(), 0);
  const auto cellOf = [&](const Vec<1>& at) {
    return static_cast<std::size_t>(level.cellAlong(0, at[0]) - patch.cells().lower[0]);
  };
  for (const Vec<1>& at : x) ++inCell[cellOf(at)];
  for (std::size_t k = 0; k < x.size(); ++k) {
    length.push_back(level.spacing(0) / inCell[cellOf(x[k])]);
    mass.push_back(density[k] * length[k] * crossSection(level));
    gradient.push_back(0);
    affineEnergy.push_back(0);
  }
}

void interpolateParticlesToGrid(const Patch& patch, const Gas&, ParticleView<const Vec<1>> x,
                                ParticleView<const double> length, ParticleView<const double> mass,
                                ParticleView<const Vec<1>> velocity, ParticleView<const double> gradient,
                                ParticleView<const double> internalEnergy, NodeView<double> nodeMass,
                                NodeView<Vec<1>> nodeVelocity, CellView<double> cellMass,
                                CellView<double> cellInternalEnergy) {
  const Level& level = patch.level();
  nodeMass.fill(0);
  nodeVelocity.fill(Vec<1>::Zero());
  cellMass.fill(0);
  cellInternalEnergy.fill(0);
  forEach<1>(x.cells(), [&](const Index<1>& cell) {
    for (const int p : x.in(cell)) {
      const Extent extent(level, cell[0], x[p][0], length[p]);
      for (int k = 0; k < extent.cells; ++k) {
        const Index<1> c{{extent.firstCell + k}};
        if (!cellMass.box().contains(c)) continue;
        const double part = extent.part[static_cast<std::size_t>(k)] * mass[p];
        cellMass[c] += part;
        cellInternalEnergy[c] += part * internalEnergy[p];
      }
      for (int k = 0; k <= extent.cells; ++k) {
        const Index<1> node{{extent.firstCell + k}};
        if (!nodeMass.box().contains(node)) continue;
        const double share = extent.weight[static_cast<std::size_t>(k)] * mass[p];
        nodeMass[node] += share;
        nodeVelocity[node][0] += share * (velocity[p][0] + gradient[p] * (level.nodePosition(0, node[0]) - x[p][0]));
      }
    }
  });
  forEach<1>(nodeMass.box(), [&](const Index<1>& node) {
    const bool wall = (node[0] == 0 && level.isSymmetry(0, 0)) ||
                      (node[0] == level.cells().upper[0] && level.isSymmetry(0, 1));
    nodeVelocity[node][0] = wall || !(nodeMass[node] > 0) ? 0.0 : nodeVelocity[node][0] / nodeMass[node];
  });
}

void computeStress(const Patch& patch, const Gas& gas, const Viscosity& viscosity, CellView<const double> mass,
                   CellView<const double> internalEnergy, NodeView<const Vec<1>> velocity, CellView<double> stress) {
  const double volume = patch.level().cellVolume();
  forEach<1>(patch.cells(), [&](const Index<1>& cell) {
    const double p = (gas.gamma - 1) * internalEnergy[cell] / volume, rho = mass[cell] / volume;
    const double dv = velocity[cell + Index<1>::unit(0)][0] - velocity[cell][0];
    double q = 0;
    if (dv < 0 && rho > 0)
      q = rho * -dv * (viscosity.quadratic * -dv + viscosity.linear * std::sqrt(gas.gamma * p / rho));
    stress[cell] = p + q;
  });
}

void computeAcceleration(const Patch& patch, const Gas&, CellView<const double> stress, NodeView<const double> mass,
                         NodeView<Vec<1>> acceleration) {
  const double area = crossSection(patch.level());
  const int last = patch.level().cells().upper[0];
  forEach<1>(patch.nodes(), [&](const Index<1>& node) {
    const bool wall = (node[0] == 0 && patch.level().isSymmetry(0, 0)) ||
                      (node[0] == last && patch.level().isSymmetry(0, 1));
    const double below = node[0] > 0 ? stress[node - Index<1>::unit(0)] : 0.0;
    const double above = node[0] < last ? stress[node] : 0.0;
    acceleration[node][0] = wall || !(mass[node] > 0) ? 0.0 : (below - above) * area / mass[node];
  });
}

namespace {

/// The dt > 0 at which dt (s + dt b) reaches `limit`, infinite if it never does.
double timeTo(double s, double b, double limit) {
  if (b == 0) return s > 0 ? limit / s : std::numeric_limits<double>::infinity();
  const double root = s * s + 4 * b * limit;
  if (root < 0) return std::numeric_limits<double>::infinity();
  const double dt = 2 * limit / (s + std::sqrt(root));
  return dt > 0 ? dt : std::numeric_limits<double>::infinity();
}

}  // namespace

void computeStableTimeStep(const Patch& patch, const Gas& gas, double cfl, ParticleView<const Vec<1>> velocity,
                           ParticleView<const double> internalEnergy, NodeView<const Vec<1>> nodeVelocity,
                           NodeView<const Vec<1>> acceleration, Minimum& dt) {
  mpm::computeStableTimeStep<1>(patch, gas, cfl, velocity, internalEnergy, dt);
  const double h = patch.level().spacing(0), g1 = gas.gamma - 1;
  forEach<1>(patch.cells(), [&](const Index<1>& cell) {
    const Index<1> next = cell + Index<1>::unit(0);
    const double dv = nodeVelocity[next][0] - nodeVelocity[cell][0], da = acceleration[next][0] - acceleration[cell][0];
    const double fastest = std::max(-dv, g1 * dv);
    if (fastest > 0) dt.add(0.4 * h / fastest);
    dt.add(std::min(timeTo(-dv, -da, 0.5 * h), timeTo(g1 * dv, g1 * da, 0.5 * h)));
  });
}

void updateParticles(const Patch& patch, const Gas&, ParticleView<const Vec<1>> x, ParticleView<const double> length,
                     ParticleView<const Vec<1>> velocity, ParticleView<const double> gradient,
                     ParticleView<const double> internalEnergy, ParticleView<const double> affineEnergy,
                     NodeView<const Vec<1>> nodeVelocity, NodeView<const Vec<1>> acceleration,
                     CellView<const double> stress, CellView<const double> cellInternalEnergy, double dt,
                     ParticleView<Vec<1>> newX, ParticleView<double> newLength, ParticleView<Vec<1>> newVelocity,
                     ParticleView<double> newGradient, ParticleView<double> newInternalEnergy,
                     ParticleView<double> newAffineEnergy) {
  const Level& level = patch.level();
  const double area = crossSection(level);
  const auto cellWork = [&](const Index<1>& cell, double opening) {
    return std::max(-0.8, -stress[cell] * area * opening * dt / cellInternalEnergy[cell]);
  };
  forEach<1>(patch.cells(), [&](const Index<1>& cell) {
    for (const int p : x.in(cell)) {
      const Extent extent(level, cell[0], x[p][0], length[p]);
      std::array<double, Extent::most + 1> star;
      double work = 0, slipEnergy = 0, inertia = 0, speed = 0, square = 0, lastHalf = 0;
      for (int k = 0; k <= extent.cells; ++k) {
        const auto at = static_cast<std::size_t>(k);
        const Index<1> node{{extent.firstCell + k}};
        const double v = nodeVelocity[node][0], a = acceleration[node][0], w = extent.weight[at];
        const double arm = level.nodePosition(0, node[0]) - x[p][0], slip = velocity[p][0] + gradient[p] * arm - v;
        const double half = v + 0.5 * dt * a;
        star[at] = v + dt * a;
        speed += w * star[at];
        square += w * star[at] * star[at];
        slipEnergy += 0.5 * w * slip * slip;
        inertia += w * arm * arm;
        if (k > 0) work += extent.part[at - 1] * cellWork(Index<1>{{node[0] - 1}}, half - lastHalf);
        lastHalf = half;
      }
      const double leftSpeed = extent.atLeft(star), rightSpeed = extent.atRight(star);
      const double left = extent.left + dt * leftSpeed, right = extent.right + dt * rightSpeed;
      newX[p][0] = 0.5 * (left + right);
      newLength[p] = right - left;
      newVelocity[p][0] = speed;
      newGradient[p] = (rightSpeed - leftSpeed) / (extent.right - extent.left);
      newInternalEnergy[p] = internalEnergy[p] * (1 + work) + slipEnergy + affineEnergy[p] -
                             0.5 * inertia * gradient[p] * gradient[p];
      newAffineEnergy[p] = std::max(0.0, 0.5 * (square - speed * speed));
    }
  });
}

void limitGradient(const Patch& patch, const Gas&, ParticleView<const double> length,
                   ParticleView<const double> internalEnergy, ParticleView<const double> affineEnergy,
                   ParticleView<double> gradient) {
  const double h = patch.level().spacing(0);
  for (int p = 0; p < length.owned(); ++p) {
    const double inertia = length[p] * length[p] / 12 + h * h / 4;
    const double energy = 0.5 * inertia * gradient[p] * gradient[p], most = affineEnergy[p] + 0.5 * internalEnergy[p];
    if (energy > most) gradient[p] *= std::sqrt(most / energy);
  }
}

void splitLong(const Patch& patch, const Gas&, ParticleMaker& maker, double longestInCells, ParticleView<const ParticleId> ids,
               ParticleView<const Vec<1>> x, ParticleView<const double> length, ParticleView<const double> mass,
               ParticleView<const Vec<1>> velocity, ParticleView<const double> gradient,
               ParticleView<const double> internalEnergy, ParticleView<const double> affineEnergy,
               std::vector<Vec<1>>& newX, std::vector<double>& newLength, std::vector<double>& newMass,
               std::vector<Vec<1>>& newVelocity, std::vector<double>& newGradient,
               std::vector<double>& newInternalEnergy, std::vector<double>& newAffineEnergy) {
  const Level& level = patch.level();
  const double longest = longestInCells * level.spacing(0);
  bool any = false;
  forEach<1>(x.cells(), [&](const Index<1>& cell) {
    for (const int p : x.in(cell)) any = any || length[p] > longest;
  });
  if (!any) return maker.keepAll();
  const auto add = [&](int p, ParticleId id, double share, double offset) {
    const Index<1> cell = level.cellOf<1>(Vec<1>(x[p][0] + offset));
    if (!patch.cells().contains(cell)) return;
    const double slip = offset * gradient[p];
    const double spare = share < 1 ? affineEnergy[p] - 0.5 * slip * slip : affineEnergy[p];
    maker.add(cell, id);
    newX.push_back(Vec<1>(x[p][0] + offset));
    newLength.push_back(share * length[p]);
    newMass.push_back(share * mass[p]);
    newVelocity.push_back(Vec<1>(velocity[p][0] + slip));
    newGradient.push_back(gradient[p]);
    newInternalEnergy.push_back(internalEnergy[p] + std::min(spare, 0.0));
    newAffineEnergy.push_back(std::max(spare, 0.0));
  };
  forEach<1>(x.cells(), [&](const Index<1>& cell) {
    for (const int p : x.in(cell)) {
      if (length[p] <= longest) {
        add(p, ids[p], 1, 0);
        continue;
      }
      add(p, ids[p], 0.5, -0.25 * length[p]);
      add(p, derivedId(ids[p], x[p][0]), 0.5, 0.25 * length[p]);
    }
  });
}

}  // namespace tushar::mpm::conserving
