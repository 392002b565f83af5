#include "components/mpm/gas/paper/tasks/redistribute.hpp"

#include <cmath>

#include "components/mpm/particles/ids.hpp"

namespace tushar::mpm::gas::paper {

namespace {

double minmod(double a, double b) { return a * b <= 0 ? 0.0 : (std::abs(a) < std::abs(b) ? a : b); }

/// Sums over the pieces of a cell.
template <int D>
struct Totals {
  double mass = 0, volume = 0, internal = 0, kinetic = 0, divergence = 0;
  Vec<D> momentum = Vec<D>::Zero();

  explicit Totals(const std::vector<Piece<D>>& pieces) {
    for (const Piece<D>& piece : pieces) {
      mass += piece.mass;
      volume += piece.volume;
      internal += piece.mass * piece.internalEnergy;
      kinetic += 0.5 * piece.mass * piece.velocity.squaredNorm();
      momentum += piece.mass * piece.velocity;
      divergence += piece.mass * piece.divergence;
    }
  }
  double density() const { return mass / volume; }
  double pressure(const Gas& gas) const { return (gas.gamma - 1) * internal / volume; }
  Vec<D> velocity() const { return momentum / mass; }
};

/// The two pieces that are closest to each other; if there are several such pairs, the first in the order of the list.
template <int D>
std::pair<std::size_t, std::size_t> nearestPair(const std::vector<Piece<D>>& pieces) {
  std::pair<std::size_t, std::size_t> best{0, 1};
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t a = 0; a < pieces.size(); ++a)
    for (std::size_t b = a + 1; b < pieces.size(); ++b) {
      const double distance = (pieces[a].x - pieces[b].x).squaredNorm();
      if (!(distance < least)) continue;
      least = distance;
      best = {a, b};
    }
  return best;
}

template <int D>
Piece<D> joined(const Piece<D>& a, const Piece<D>& b) {
  Piece<D> both = a;
  both.id = std::min(a.id, b.id);
  both.mass = a.mass + b.mass;
  both.volume = a.volume + b.volume;
  both.x = (a.mass * a.x + b.mass * b.x) / both.mass;
  both.velocity = (a.mass * a.velocity + b.mass * b.velocity) / both.mass;
  const double lost = 0.5 * a.mass * b.mass / both.mass * (a.velocity - b.velocity).squaredNorm();
  both.internalEnergy = (a.mass * a.internalEnergy + b.mass * b.internalEnergy + lost) / both.mass;
  both.divergence = (a.mass * a.divergence + b.mass * b.divergence) / both.mass;
  return both;
}

/// Adds the cell's velocity slopes about the centre of mass, scaled down if they would increase the kinetic energy;
/// kinetic energy that is left over becomes heat.
template <int D>
void shearPieces(std::vector<Piece<D>>& pieces, const CellShape<D>& cell, const Totals<D>& before) {
  Vec<D> centre = Vec<D>::Zero();
  for (const Piece<D>& piece : pieces) centre += piece.mass / before.mass * piece.x;
  const auto gradient = [&](const Piece<D>& piece) {
    Vec<D> dv;
    for (int i = 0; i < D; ++i) dv[i] = cell.velocitySlope[i].dot(piece.x - centre);
    return dv;
  };
  double sheared = 0;
  for (const Piece<D>& piece : pieces) sheared += 0.5 * piece.mass * gradient(piece).squaredNorm();
  const double spare = std::max(0.0, before.kinetic - 0.5 * before.momentum.squaredNorm() / before.mass);
  const double scale = sheared > spare ? std::sqrt(spare / sheared) : 1.0;
  for (Piece<D>& piece : pieces) {
    piece.velocity = before.velocity() + scale * gradient(piece);
    piece.internalEnergy += (spare - scale * scale * sheared) / before.mass;
  }
}

}  // namespace

template <int D>
void split(std::vector<Piece<D>>& pieces, const CellShape<D>& cell, int minParticles) {
  int axis = 0;
  for (int d = 1; d < D; ++d)
    if (cell.spacing[d] > cell.spacing[axis]) axis = d;
  const double h = cell.spacing[axis], low = cell.lower[axis], high = low + h;
  for (std::size_t k = 0, count = pieces.size(); k < count && static_cast<int>(pieces.size()) < minParticles;
       ++k, count = pieces.size()) {
    if (!(pieces[k].volume > cell.volume / (2 * minParticles))) continue;
    const double offset = std::min(pieces[k].volume / cell.volume, 1.0) * h / 4;
    const double middle = std::clamp(pieces[k].x[axis], low + offset, high - offset * (1 + 1e-12));
    pieces[k].mass /= 2;
    pieces[k].volume /= 2;
    Piece<D> child = pieces[k];
    child.id = derivedId(pieces[k].id, pieces[k].x[axis], axis);
    pieces[k].x[axis] = middle - offset;
    child.x[axis] = middle + offset;
    pieces.push_back(child);
  }
}

template <int D>
void merge(std::vector<Piece<D>>& pieces, int maxParticles) {
  while (static_cast<int>(pieces.size()) > std::max(maxParticles, 1)) {
    const auto [a, b] = nearestPair<D>(pieces);
    pieces[a] = joined<D>(pieces[a], pieces[b]);
    pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(b));
  }
}

template <int D>
void setSlopes(CellShape<D>& cell, const std::vector<Piece<D>>& here,
               const std::array<std::vector<Piece<D>>, 2 * D>& around, const Gas& gas) {
  if (here.empty()) return;
  const Totals<D> middle(here);
  for (int d = 0; d < D; ++d) {
    const auto &below = around[2 * d], &above = around[2 * d + 1];
    if (below.empty() || above.empty()) continue;
    const Totals<D> left(below), right(above);
    const auto slope = [&](double l, double m, double r) { return minmod(m - l, r - m) / cell.spacing[d]; };
    cell.densitySlope[d] = slope(left.density(), middle.density(), right.density()) / D;
    cell.pressureSlope[d] = slope(left.pressure(gas), middle.pressure(gas), right.pressure(gas)) / D;
    for (int i = 0; i < D; ++i)
      cell.velocitySlope[i][d] = slope(left.velocity()[i], middle.velocity()[i], right.velocity()[i]);
  }
}

template <int D>
void reseed(std::vector<Piece<D>>& pieces, const CellShape<D>& cell, const Gas& gas, int alongAxis) {
  if (pieces.empty()) return;
  const Totals<D> before(pieces);
  const ParticleId parent = pieces.front().id;
  const double place = pieces.front().x[0];
  const Vec<D> middle = cell.lower + 0.5 * cell.spacing;
  pieces.clear();
  Box places{{}, Index3::filled(1)};
  for (int d = 0; d < D; ++d) places.upper[d] = alongAxis;
  double internal = 0;
  forEach<D>(places, [&](const Index<D>& k) {
    Piece<D> piece;
    piece.id = derivedId(parent + pieces.size(), place, 0);
    for (int d = 0; d < D; ++d) piece.x[d] = cell.lower[d] + (k[d] + 0.5) / alongAxis * cell.spacing[d];
    piece.volume = before.volume / static_cast<double>(places.size());
    const double density = before.density() + cell.densitySlope.dot(piece.x - middle);
    piece.mass = density * piece.volume;
    piece.internalEnergy = gas.internalEnergy(density, before.pressure(gas) + cell.pressureSlope.dot(piece.x - middle));
    piece.divergence = before.divergence / before.mass;
    internal += piece.mass * piece.internalEnergy;
    pieces.push_back(piece);
  });
  for (Piece<D>& piece : pieces) piece.internalEnergy *= internal > 0 ? before.internal / internal : 1.0;
  shearPieces<D>(pieces, cell, before);
}

template <int D>
void redistributeCell(std::vector<Piece<D>>& pieces, const CellShape<D>& cell, const Gas& gas,
                      const Redistribution& how) {
  if (how.mode == Redistribution::Mode::reseed) {
    reseed<D>(pieces, cell, gas, how.seededAlongAxis(D));
    return;
  }
  split<D>(pieces, cell, how.minParticles);
  merge<D>(pieces, how.maxParticles);
}

template void split<1>(std::vector<Piece<1>>&, const CellShape<1>&, int);
template void merge<1>(std::vector<Piece<1>>&, int);
template void setSlopes<1>(CellShape<1>&, const std::vector<Piece<1>>&, const std::array<std::vector<Piece<1>>, 2>&,
                           const Gas&);
template void reseed<1>(std::vector<Piece<1>>&, const CellShape<1>&, const Gas&, int);
template void redistributeCell<1>(std::vector<Piece<1>>&, const CellShape<1>&, const Gas&, const Redistribution&);

template void split<2>(std::vector<Piece<2>>&, const CellShape<2>&, int);
template void merge<2>(std::vector<Piece<2>>&, int);
template void setSlopes<2>(CellShape<2>&, const std::vector<Piece<2>>&, const std::array<std::vector<Piece<2>>, 4>&,
                           const Gas&);
template void reseed<2>(std::vector<Piece<2>>&, const CellShape<2>&, const Gas&, int);
template void redistributeCell<2>(std::vector<Piece<2>>&, const CellShape<2>&, const Gas&, const Redistribution&);

template void split<3>(std::vector<Piece<3>>&, const CellShape<3>&, int);
template void merge<3>(std::vector<Piece<3>>&, int);
template void setSlopes<3>(CellShape<3>&, const std::vector<Piece<3>>&, const std::array<std::vector<Piece<3>>, 6>&,
                           const Gas&);
template void reseed<3>(std::vector<Piece<3>>&, const CellShape<3>&, const Gas&, int);
template void redistributeCell<3>(std::vector<Piece<3>>&, const CellShape<3>&, const Gas&, const Redistribution&);

}  // namespace tushar::mpm::gas::paper
