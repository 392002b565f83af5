#include "components/mpm/gas/paper/mass_projection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "components/mpm/gas/paper/gas_mpm.hpp"
#include "core/simulation/plain_module.hpp"

namespace tushar::mpm::gas::paper {

namespace {

/// Number of layers of ghost cells: the cell across a face, and the next one, whose particles determine the density in
/// the former.
constexpr int reach = 2;

/// Simpson's rule with the values at both ends and in the middle: exact for cubics.
double simpson(double width, double first, double middle, double last) {
  return width / 6 * (first + 4 * middle + last);
}

/// The particles of a cell sorted by position, measured from cell `from`; empty for a cell outside the grid.
std::vector<PlacedDensity> particlesOf(int cell, int from, const Level& level, ParticleView<const Vec<1>> x,
                                       ParticleView<const double> density) {
  std::vector<PlacedDensity> particles;
  if (!x.cells().contains(Index<1>{{cell}})) return particles;
  for (const int p : x.in(Index<1>{{cell}}))
    particles.push_back({(x[p][0] - level.nodePosition(0, from)) * level.inverseSpacing(0), density[p]});
  std::stable_sort(particles.begin(), particles.end(),
                   [](const PlacedDensity& a, const PlacedDensity& b) { return a.place < b.place; });
  return particles;
}

/// The density on a face of a cell, interpolated between a particle in the cell and one beyond the face; if there is
/// none beyond, the density of the particle in the cell.
double densityAt(double face, const std::optional<PlacedDensity>& beyond, const PlacedDensity& within) {
  if (!beyond || beyond->place == within.place) return within.density;
  const double part = (face - within.place) / (beyond->place - within.place);
  return within.density + part * (beyond->density - within.density);
}

/// The contribution of a cell to its nodes; none if the cell contains no particles.
std::optional<CellProjection> projectionOf(int cell, const Level& level, ParticleView<const Vec<1>> x,
                                           ParticleView<const double> density) {
  const std::vector<PlacedDensity> here = particlesOf(cell, cell, level, x, density);
  if (here.empty()) return {};
  const std::vector<PlacedDensity> below = particlesOf(cell - 1, cell, level, x, density);
  const std::vector<PlacedDensity> above = particlesOf(cell + 1, cell, level, x, density);
  const auto lastBelow = below.empty() ? std::nullopt : std::optional(below.back());
  const auto firstAbove = above.empty() ? std::nullopt : std::optional(above.front());
  std::vector<PlacedDensity> line{{0, densityAt(0, lastBelow, here.front())}};
  line.insert(line.end(), here.begin(), here.end());
  line.push_back({1, densityAt(1, firstAbove, here.back())});
  return projectCell(here, line);
}

class MassProjection : public simulation::Analysis {
 public:
  /// The materials must outlive the module.
  explicit MassProjection(const std::vector<Gas>& materials) : materials_(&materials) {}

  void schedule(TaskList& tasks) const override {
    tasks.perMaterial("mpm::measureMassProjection", measureMassProjection, *materials_, requiresOld(p::x<1>, reach),
                      requiresOld(p::density, reach), computes(g::massProjectionError),
                      computes(g::massProjectionBound), computes(massProjectionError), computes(massProjectionRatio));
  }
  void setTime(double, double) override {}
  std::vector<simulation::MeasuredError> errors() const override {
    return {{"mass_projection", "node", &massProjectionError, {"max"}},
            {"mass_projection_over_bound", "node", &massProjectionRatio, {"max"}}};
  }

 private:
  const std::vector<Gas>* materials_;
};

/// The reason why the module cannot be used in this run; empty if it can.
std::string misfit(const GasMpm<1>* mpm, const Level& level) {
  if (level.dimension() > 1)
    return fmt::format("works only in one dimension, like its theorem, but this grid has {}; remove the module",
                       level.dimension());
  if (!mpm) return "measures the <gas_dynamics> of the component mpm, which this scene does not run; remove the module";
  if (mpm->method().volumeModel != VolumeModel::cellShare)
    return "measures particles that share their cell's volume, but volume_model is tracked; use cell_share";
  return {};
}

std::unique_ptr<simulation::Analysis> makeModule(const Component& component, const Level& level) {
  const auto* mpm = dynamic_cast<const GasMpm<1>*>(&component);
  if (const std::string why = misfit(mpm, level); !why.empty()) throw std::invalid_argument(why);
  return std::make_unique<MassProjection>(mpm->materials());
}

}  // namespace

double discrepancy(const std::vector<PlacedDensity>& particles) {
  const auto count = static_cast<double>(particles.size());
  double sum = 0;
  for (std::size_t k = 0; k < particles.size(); ++k) {
    const double away = particles[k].place - (static_cast<double>(k) + 0.5) / count;
    sum += away * away;
  }
  return std::sqrt(1 / (12 * count * count) + sum / count);
}

CellProjection projectCell(const std::vector<PlacedDensity>& particles, const std::vector<PlacedDensity>& line) {
  const double scatter = discrepancy(particles);
  CellProjection cell;
  for (const std::size_t node : {0, 1}) {
    const double slope = node == 0 ? -1 : 1;  // of S_i, times h
    const auto shape = [&](double place) { return Linear<1>::weights(Vec<1>(place))[node]; };
    double integral = 0, square = 0, sum = 0;
    for (std::size_t k = 1; k < line.size(); ++k) {
      const PlacedDensity &a = line[k - 1], &b = line[k];
      const double width = b.place - a.place;
      if (!(width > 0)) continue;
      const double steepness = (b.density - a.density) / width;
      const auto value = [&](double place) { return (a.density + steepness * (place - a.place)) * shape(place); };
      const auto gradient = [&](double place) {
        return steepness * shape(place) + slope * (a.density + steepness * (place - a.place));
      };
      const double middle = 0.5 * (a.place + b.place);
      integral += simpson(width, value(a.place), value(middle), value(b.place));
      square +=
          simpson(width, std::pow(gradient(a.place), 2), std::pow(gradient(middle), 2), std::pow(gradient(b.place), 2));
    }
    for (const PlacedDensity& particle : particles) sum += particle.density * shape(particle.place);
    cell.error[node] = integral - sum / static_cast<double>(particles.size());
    cell.bound[node] = scatter * std::sqrt(square);
  }
  return cell;
}

void measureMassProjection(const Patch& patch, const Gas&, ParticleView<const Vec<1>> x,
                           ParticleView<const double> density, NodeView<double> error, NodeView<double> bound,
                           Maximum& greatestError, Maximum& greatestRatio) {
  const Level& level = patch.level();
  const Box seen = patch.cellsWithin(1);
  std::vector<std::optional<CellProjection>> cells;
  cells.reserve(seen.size());
  forEach<1>(seen, [&](const Index<1>& cell) { cells.push_back(projectionOf(cell[0], level, x, density)); });
  error.fill(0.0);
  bound.fill(0.0);
  forEach<1>(patch.nodes(), [&](const Index<1>& node) {
    double e = 0, b = 0;
    for (const int side : {0, 1}) {  // the node is the upper one of the cell below it, and the lower one of that above
      const Index<1> cell{{node[0] - 1 + side}};
      if (!seen.contains(cell)) continue;
      const auto& projection = cells[cell[0] - seen.lower[0]];
      if (!projection) return;
      e += projection->error[1 - side];
      b += projection->bound[1 - side];
    }
    error[node] = e * level.cellVolume();
    bound[node] = b * level.cellVolume();
    greatestError.add(std::abs(e));
    greatestRatio.add(std::abs(e) / b);
  });
}

simulation::AnalysisKind massProjectionKind() {
  return simulation::plainModule(
      "massProjection", "error of the nodal mass, compared with its bound",
      "Error of the nodal mass, compared with its bound, equations (19)-(23) of Tran, Kim & Berzins.", makeModule);
}

}  // namespace tushar::mpm::gas::paper
