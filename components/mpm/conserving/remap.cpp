#include "components/mpm/conserving/redistribute.hpp"

namespace tushar::mpm::conserving {

namespace {

/// Sums over the parts of particles in a cell; offsets are from the middle of the cell.
template <int D>
struct CellSums {
  double mass = 0, internal = 0, kinetic = 0;
  Vec<D> momentum = Vec<D>::Zero();
  Vec<D> offset = Vec<D>::Zero();      ///< m dx
  Vec<D> square = Vec<D>::Zero();      ///< m (dx² + l²/12), l the length of the part
  Tensor<D> moment = Tensor<D>::Zero();  ///< column d: m (u dx_d + B_d l_d²/12)
  Modes<D> modes = Modes<D>::Zero();   ///< m u_a
};

/// Van Leer's limited slope along an axis over the value itself, 1/m; 0 at the rim of the grid.
template <int D>
double relativeSlope(const Level& level, CellView<const double> values, const Index<D>& cell, int d) {
  const Index<D> below = cell - Index<D>::unit(d), above = cell + Index<D>::unit(d);
  if (!values.box().contains(below) || !values.box().contains(above) || !(values[cell] > 0)) return 0;
  const double rise = values[above] - values[cell], fall = values[cell] - values[below];
  return rise * fall > 0 ? 2 * rise * fall * level.inverseSpacing(d) / ((rise + fall) * values[cell]) : 0.0;
}

/// Relative slopes of a cell variable, such that a box of these edges keeps at least a fifth of the mean everywhere.
template <int D>
Vec<D> relativeSlopes(const Level& level, CellView<const double> values, const Index<D>& cell, const Vec<D>& edges) {
  Vec<D> slopes;
  for (int d = 0; d < D; ++d) slopes[d] = relativeSlope<D>(level, values, cell, d);
  const double swing = 0.5 * slopes.cwiseAbs().dot(edges);
  return swing > 0.8 ? Vec<D>(0.8 / swing * slopes) : slopes;
}

/// The part of a particle in a cell.
template <int D>
struct Part {
  Index<D> cell;
  Vec<D> x, edges;       ///< centre and edge lengths
  double mass, internal;  ///< shares of the particle's, then kg and J
};

template <int D>
class Parts {
 public:
  /// Cuts a box at the faces of cells.
  Parts(const Level& level, const Footprint<D>& footprint, const Vec<D>& centre, const Vec<D>& density,
        const Vec<D>& energy) {
    const Box everywhere{Index3::filled(std::numeric_limits<int>::min() / 2),
                         Index3::filled(std::numeric_limits<int>::max() / 2)};
    footprint.forEachCell(everywhere, [&](const Index<D>& cell, double share) {
      Part<D>& part = parts_[static_cast<std::size_t>(count_++)];
      part.cell = cell;
      for (int d = 0; d < D; ++d) {
        const auto& span = footprint.along[static_cast<std::size_t>(d)];
        const double lower = std::max(span.lower, level.nodePosition(d, cell[d]));
        const double upper = std::min(span.upper, level.nodePosition(d, cell[d] + 1));
        part.x[d] = 0.5 * (lower + upper);
        part.edges[d] = upper - lower;
      }
      part.mass = share * (1 + density.dot(part.x - centre));
      part.internal = share * (1 + energy.dot(part.x - centre));
    });
  }
  Part<D>* begin() { return parts_.data(); }
  Part<D>* end() { return parts_.data() + count_; }

  /// Makes the shares of mass and internal energy sum to what the particle has.
  void scaleTo(double mass, double internal) {
    double sumOfMass = 0, sumOfInternal = 0;
    for (const Part<D>& part : *this) {
      sumOfMass += part.mass;
      sumOfInternal += part.internal;
    }
    for (Part<D>& part : *this) {
      part.mass *= mass / sumOfMass;
      part.internal *= internal / sumOfInternal;
    }
  }
  const Part<D>* begin() const { return parts_.data(); }
  const Part<D>* end() const { return parts_.data() + count_; }

 private:
  static constexpr int perAxis = Footprint<D>::most + (D > 1);
  std::array<Part<D>, D == 1 ? perAxis : D == 2 ? perAxis * perAxis : perAxis * perAxis * perAxis> parts_;
  int count_ = 0;
};

/// Sends the parts of a particle to their cells.
template <int D, class Send>
void cut(const Level& level, const Index<D>& cell, const Boxes<D>& boxes, int p, CellView<const double> mass,
         CellView<const double> energy, Send&& send) {
  const Vec<D> centre = boxes.x[p];
  const Footprint<D> footprint(level, cell, centre, boxes.edges[p]);
  Parts<D> parts(level, footprint, centre, relativeSlopes<D>(level, mass, cell, boxes.edges[p]),
                 relativeSlopes<D>(level, energy, cell, boxes.edges[p]));
  const double m = boxes.mass[p], e = boxes.internalEnergy[p];
  parts.scaleTo(m, m * e);
  Vec<D> centroid = Vec<D>::Zero();
  for (const Part<D>& part : parts) centroid += part.mass / m * part.x;
  Tensor<D> gradient;
  for (int d = 0; d < D; ++d) gradient.col(d) = boxes.modes[p].col(gradientColumn(d));
  double kinetic = 0;
  for (const Part<D>& part : parts) kinetic += 0.5 * part.mass / m * (gradient * (part.x - centroid)).squaredNorm();
  const double most = boxes.affineEnergy[p] + 0.5 * e;
  if (kinetic > most) {
    gradient *= std::sqrt(most / kinetic);
    kinetic = most;
  }
  const double surplus = boxes.affineEnergy[p] - kinetic;
  for (Part<D>& part : parts) {
    part.internal *= 1 + std::min(surplus, 0.0) / e;
    send(part, Vec<D>(boxes.velocity[p] + gradient * (part.x - centroid)), gradient, boxes.modes[p],
         std::max(surplus, 0.0));
  }
}

template <int D>
void addTo(CellSums<D>& sums, const Vec<D>& middle, const Part<D>& part, const Vec<D>& u, const Tensor<D>& gradient,
           const Modes<D>& modes, double surplus) {
  const double m = part.mass;
  const Vec<D> dx = part.x - middle;
  sums.mass += m;
  sums.internal += part.internal;
  sums.kinetic += m * (0.5 * u.squaredNorm() + surplus);
  sums.momentum += m * u;
  sums.offset += m * dx;
  sums.modes += m * modes;
  for (int d = 0; d < D; ++d) {
    const double spread = part.edges[d] * part.edges[d] / 12;
    sums.square[d] += m * (dx[d] * dx[d] + spread);
    sums.moment.col(d) += m * (u * dx[d] + gradient.col(d) * spread);
  }
}

template <int D>
void makeParticle(const Level& level, const Index<D>& cell, const Vec<D>& middle, const CellSums<D>& sums,
                  NewBoxes<D>& fresh) {
  Vec<D> edges, inertia;
  const double inverse = 1 / sums.mass;
  const Vec<D> v = inverse * sums.momentum;
  Modes<D> modes = inverse * sums.modes;
  for (int d = 0; d < D; ++d) {
    const double offset = inverse * sums.offset[d];
    edges[d] = level.spacing(d);
    inertia[d] = 0.25 * edges[d] * edges[d];
    modes.col(gradientColumn(d)) =
        (inverse * sums.moment.col(d) - offset * v) / (inverse * sums.square[d] - offset * offset);
  }
  const double within = std::max(0.0, inverse * sums.kinetic - 0.5 * v.squaredNorm());
  const double affine = std::min(within, modalEnergy<D>(modes, inertia));
  fresh.maker.add(cell, level.cellNumber(cell) << 16);
  fresh.x.push_back(middle);
  fresh.edges.push_back(edges);
  fresh.mass.push_back(sums.mass);
  fresh.velocity.push_back(v);
  fresh.modes.push_back(modes);
  fresh.internalEnergy.push_back(inverse * sums.internal + (within - affine));
  fresh.affineEnergy.push_back(affine);
}

}  // namespace

template <int D>
void remap(const Patch& patch, const Boxes<D>& boxes, CellView<const double> mass, CellView<const double> energy,
           NewBoxes<D> fresh) {
  const Level& level = patch.level();
  std::vector<CellSums<D>> sums(patch.cells().size());
  const auto place = [&](const Index<D>& cell) {
    Index3 wide;
    for (int d = 0; d < D; ++d) wide[d] = cell[d];
    return patch.cells().offset(wide);
  };
  forEach<D>(boxes.x.cells(), [&](const Index<D>& cell) {
    for (const int p : boxes.x.in(cell))
      cut<D>(level, cell, boxes, p, mass, energy,
             [&](const Part<D>& part, const Vec<D>& u, const Tensor<D>& gradient, const Modes<D>& modes, double surplus) {
               if (patch.cells().contains(part.cell))
                 addTo(sums[place(part.cell)], level.cellCentre<D>(part.cell), part, u, gradient, modes, surplus);
             });
  });
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    const CellSums<D>& all = sums[place(cell)];
    if (all.mass > 0) makeParticle<D>(level, cell, level.cellCentre<D>(cell), all, fresh);
  });
}

template void remap<1>(const Patch&, const Boxes<1>&, CellView<const double>, CellView<const double>, NewBoxes<1>);
template void remap<2>(const Patch&, const Boxes<2>&, CellView<const double>, CellView<const double>, NewBoxes<2>);
template void remap<3>(const Patch&, const Boxes<3>&, CellView<const double>, CellView<const double>, NewBoxes<3>);

}  // namespace tushar::mpm::conserving
