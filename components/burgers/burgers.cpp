#include "components/burgers/burgers.hpp"

#include "core/base/limiters.hpp"
#include "core/input/schema.hpp"
#include "core/simulation/by_dimension.hpp"

namespace tushar::burgers {

namespace {

constexpr int kReach = 2;  ///< number of cells on each side that affect the fluxes of a cell

double noSlope(double, double) { return 0; }

/// The value of u in a cell that may be outside the grid along axis `d`: there, it is the inflow or outflow value.
template <int D>
double valueAt(const Patch& patch, const BoundarySides<double>& sides, CellView<const double> u, Index<D> cell, int d) {
  if (patch.cellsWithin(kReach).contains(cell)) return u[cell];
  const int side = cell[d] < 0 ? 0 : 1;
  if (const auto& given = sides(d, side, cell)) return given->value;
  cell[d] = std::clamp(cell[d], 0, patch.level().cells().upper[d] - 1);
  return u[cell];
}

/// Flux between the second and the third of four cells in a row.
double faceFlux(const std::array<double, 4>& u, Slope slope, double viscosityOverSpacing) {
  const double left = u[1] + 0.5 * slope(u[1] - u[0], u[2] - u[1]);
  const double right = u[2] - 0.5 * slope(u[2] - u[1], u[3] - u[2]);
  return godunovFlux(left, right) - viscosityOverSpacing * (u[2] - u[1]);
}

/// The flux along the axis through a face of a cell; side 0 is the lower face.
template <int D>
double fluxThrough(const Patch& patch, const Settings& settings, const BoundarySides<double>& sides,
                   CellView<const double> u, const Index<D>& cell, int d, int side) {
  std::array<double, 4> row;
  for (int k = 0; k < 4; ++k) {
    Index<D> at = cell;
    at[d] += k + side - kReach;
    row[k] = valueAt<D>(patch, sides, u, at, d);
  }
  return faceFlux(row, slopeOf(settings.limiter), settings.viscosity * patch.level().inverseSpacing(d));
}

/// Adds half of the fluxes through the rim of the level to the stored ones; each of the two stages contributes one
/// half.
template <int D>
void keepHalf(const Patch& patch, const Settings& settings, const BoundarySides<double>& sides,
              CellView<const double> u, RimFlux<double> flux) {
  flux.forEachFace<D>([&](const Index<D>& cell, int d, int side, double& through) {
    through += 0.5 * fluxThrough<D>(patch, settings, sides, u, cell, d, side);
  });
}

/// Computes L(u) in a cell.
template <int D>
double rateOfChange(const Patch& patch, const Settings& settings, Slope slope, const BoundarySides<double>& sides,
                    CellView<const double> u, const Index<D>& cell) {
  double rate = 0;
  for (int d = 0; d < D; ++d) {
    const double perSpacing = patch.level().inverseSpacing(d);
    std::array<double, 5> row;
    for (int k = -kReach; k <= kReach; ++k) {
      Index<D> at = cell;
      at[d] += k;
      row[k + kReach] = valueAt<D>(patch, sides, u, at, d);
    }
    const double in = faceFlux({row[0], row[1], row[2], row[3]}, slope, settings.viscosity * perSpacing);
    const double out = faceFlux({row[1], row[2], row[3], row[4]}, slope, settings.viscosity * perSpacing);
    rate -= (out - in) * perSpacing;
  }
  return rate;
}

}  // namespace

Slope slopeOf(int limiter) { return std::array<Slope, 4>{noSlope, Minmod::slope, VanLeer::slope, Mc::slope}[limiter]; }

double godunovFlux(double left, double right) {
  const double rightGoing = std::max(left, 0.0), leftGoing = std::min(right, 0.0);
  return 0.5 * std::max(rightGoing * rightGoing, leftGoing * leftGoing);
}

template <int D>
void Burgers<D>::scheduleInitialize(TaskList& tasks) const {
  tasks.perPatch("burgers::initialize", initialize<D>, with(settings_), computes(c::u));
}

template <int D>
void Burgers<D>::scheduleComputeStableTimeStep(TaskList& tasks) const {
  tasks.perPatch("burgers::computeStableTimeStep", computeStableTimeStep<D>, with(settings_), requiresOld(c::u),
                 computes(delT));
}

template <int D>
void Burgers<D>::scheduleTimeAdvance(TaskList& tasks) const {
  tasks.perPatch("burgers::predict", predict<D>, with(settings_), requiresOld(c::u, kReach), requiresOld(delT),
                 computes(c::predicted), keepsFlux(c::u));
  tasks.perPatch("burgers::correct", correct<D>, with(settings_), requiresOld(c::u), requiresNew(c::predicted, kReach),
                 requiresOld(delT), computes(c::u), keepsFlux(c::u));
}

template <int D>
void Burgers<D>::scheduleDiagnostics(TaskList& tasks) const {
  tasks.perPatch("burgers::sumTotals", sumTotals<D>, requiresOld(c::u), computes(totalMomentum), computes(totalEnergy));
}

template <int D>
void initialize(const Patch& patch, const Settings& settings, CellView<double> u) {
  const Level& level = patch.level();
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    const Vec3 middle = level.expandPoint<D>(level.cellCentre<D>(cell));
    u[cell] = settings.velocity(middle);
    if (!std::isfinite(u[cell]))
      throw NumericalError(fmt::format("c.u is {} at ({:g}, {:g}, {:g})", u[cell], middle[0], middle[1], middle[2]),
                           "another formula for <velocity>");
  });
}

template <int D>
void computeStableTimeStep(const Patch& patch, const Settings& settings, CellView<const double> u, Minimum& dt) {
  double across = 0, spread = 0;
  for (int d = 0; d < D; ++d) {
    const double perSpacing = patch.level().inverseSpacing(d);
    across += perSpacing;
    spread += 2 * settings.viscosity * perSpacing * perSpacing;
  }
  forEach<D>(patch.cells(),
             [&](const Index<D>& cell) { dt.add(settings.cfl / (std::abs(u[cell]) * across + spread), "CFL"); });
}

template <int D>
void predict(const Patch& patch, const Settings& settings, CellView<const double> u, double dt,
             CellView<double> predicted, RimFlux<double> flux) {
  const Slope slope = slopeOf(settings.limiter);
  const BoundarySides<double> sides = patch.level().sides(boundary::velocity);
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    predicted[cell] = u[cell] + dt * rateOfChange<D>(patch, settings, slope, sides, u, cell);
  });
  keepHalf<D>(patch, settings, sides, u, flux);
}

template <int D>
void correct(const Patch& patch, const Settings& settings, CellView<const double> u, CellView<const double> predicted,
             double dt, CellView<double> newU, RimFlux<double> flux) {
  const Slope slope = slopeOf(settings.limiter);
  const BoundarySides<double> sides = patch.level().sides(boundary::velocity);
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    newU[cell] =
        0.5 * (u[cell] + predicted[cell] + dt * rateOfChange<D>(patch, settings, slope, sides, predicted, cell));
  });
  keepHalf<D>(patch, settings, sides, predicted, flux);
}

template <int D>
void sumTotals(const Patch& patch, CellView<const double> u, Sum& momentum, Sum& energy) {
  const double volume = patch.level().cellVolume();
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    momentum.add(volume * u[cell]);
    energy.add(volume * 0.5 * u[cell] * u[cell]);
  });
}

namespace {

const input::Schema<Settings>& schema() {
  static const input::Schema<Settings> schema =
      input::Schema<Settings>("Burgers", "Burgers' equation.")
          .allOurs()
          .value("viscosity", &Settings::viscosity, 0, "m^2/s", "nu", input::nonNegative())
          .choice("limiter", &Settings::limiter, {{"first_order", 0}, {"minmod", 1}, {"van_leer", 2}, {"mc", 3}}, 2,
                  "limiter of the slopes within cells; first_order has no slopes")
          .value("cfl", &Settings::cfl, 0.5, "1", "dt times the largest sum of |u| / h + 2 nu / h^2 over the axes",
                 input::positive(), input::atMost(1))
          .required("velocity", &Settings::velocity, "m/s", "u at the start");
  return schema;
}

}  // namespace

simulation::ComponentKind kind() {
  simulation::ComponentKind kind = simulation::kindWithSection<Burgers>(
      "burgers", "Burgers' equation, solved with finite volumes", schema(), {boundary::velocity, grid::symmetric});
  kind.takesLevels = true;
  kind.takesPartsOfSides = true;
  return kind;
}

template class Burgers<1>;
template class Burgers<2>;
template class Burgers<3>;

}  // namespace tushar::burgers
