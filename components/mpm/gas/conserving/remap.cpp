#include "components/mpm/gas/conserving/box_sums.hpp"
#include "components/mpm/gas/conserving/grid_fields.hpp"
#include "components/mpm/gas/conserving/redistribute.hpp"
#include "components/mpm/particles/ids.hpp"

namespace tushar::mpm::gas::conserving {

namespace {

/// Sums over the parts of particles in each cell; offsets dx are measured from the middle of the cell.
template <int D>
struct CellSums {
  static constexpr std::size_t mass = 0, internal = 1, kinetic = 2;
  static constexpr std::size_t momentum = 3;
  static constexpr std::size_t offset = momentum + D;  ///< index of the first of D sums of m dx
  /// Index of the first of D sums of m (dx² + l²/12), where l is the length of the part.
  static constexpr std::size_t square = offset + D;
  /// Index of the first sum of m (u dx_d + B_d l_d²/12): D for each axis.
  static constexpr std::size_t moment = square + D;
  static constexpr std::size_t modes = moment + D * D;  ///< index of the first sum of m u_a: D for each mixed mode
  static constexpr std::size_t count = modes + D * ((1 << D) - 1 - D);

  using Fields = BoxSums<D, count, 0>;
};

/// Whether a mode depends on several axes.
constexpr bool isMixed(std::size_t a) { return (a & (a - 1)) != 0; }

/// Views of the cells' mass and internal energy.
template <int D>
using Contents = GridFields<D, 2>;

/// Van Leer's limited slopes of a cell variable, relative to its value [1/m]; 0 at the sides of the grid. They are
/// scaled so that the variable is at least a fifth of its mean everywhere in boxes with these edge lengths.
template <int D>
LanesVec<D> relativeSlopes(const Level& level, const Contents<D>& contents, std::size_t field, const Batch<D>& batch,
                           const LanesVec<D>& edges) {
  const Lanes value = contents.readRow(field, batch.start);
  LanesVec<D> slopes;
  for (int d = 0; d < D; ++d) {
    const Lanes rise = contents.readRow(field, batch.start + Index<D>::unit(d)) - value;
    const Lanes fall = value - contents.readRow(field, batch.start - Index<D>::unit(d));
    const Lanes slope = 2 * level.inverseSpacing(d) * (rise * fall) / ((rise + fall) * value);
    slopes[d] = batch.only(select(rise * fall > 0, slope, 0));
    if (level.isPeriodic(d)) continue;
    const Lanes cell = widen(batch.cell[d]);
    slopes[d] = select(cell > 0, select(cell < level.cells().upper[d] - 1, slopes[d], 0), 0);
  }
  Lanes swing = 0;
  for (int d = 0; d < D; ++d) swing += 0.5 * abs(slopes[d]) * edges[d];
  return select(swing > 0.8, 0.8 / swing, 1) * slopes;
}

/// The parts of the particles of a batch, each in one cell.
template <int D>
struct Part {
  LanesVec<D> x, edges;  ///< centre and edge lengths
  Lanes mass, internal;  ///< parts of the particle's mass and internal energy
};

/// The parts into which boxes are cut at the faces of cells.
template <int D>
class Parts {
 public:
  /// `density` and `energy` are the relative slopes with which mass and internal energy are divided among the parts.
  Parts(const Footprint<D>& footprint, const LanesVec<D>& centre, const LanesVec<D>& density,
        const LanesVec<D>& energy) {
    footprint.forEachPart([&](const Index<D>& k, const Lanes& share) {
      Part<D>& part = at(k);
      for (int d = 0; d < D; ++d) {
        const auto& span = footprint.along[d];
        part.x[d] = span.middle(k[d]);
        part.edges[d] = span.upperOf(k[d]) - span.lowerOf(k[d]);
      }
      part.mass = share * (1 + density.dot(part.x - centre));
      part.internal = share * (1 + energy.dot(part.x - centre));
    });
    const Lanes mass = sum(footprint, [](const Part<D>& part) { return part.mass; });
    const Lanes internal = sum(footprint, [](const Part<D>& part) { return part.internal; });
    footprint.forEachPart([&](const Index<D>& k, const Lanes&) {
      at(k).mass /= mass;
      at(k).internal /= internal;
    });
  }
  /// The part in cell k of the footprint.
  Part<D>& at(const Index<D>& k) { return parts_[Footprint<D>::number(k)]; }
  /// Sum of `value(part)` over the parts.
  template <class Value>
  Lanes sum(const Footprint<D>& footprint, Value&& value) {
    return footprint.sumOverParts([&](const Index<D>& k, const Lanes&) { return value(at(k)); });
  }

 private:
  std::array<Part<D>, Footprint<D>::places> parts_;
};

/// Adds a part to the sums of its cell; `add(field, term)` adds to one of them.
template <int D, class Add>
void bring(const Part<D>& part, const LanesVec<D>& dx, const LanesVec<D>& u, const LanesTensor<D>& gradient,
           const LanesModes<D>& modes, const Lanes& surplus, Add&& add) {
  using Sums = CellSums<D>;
  const auto put = [&](std::size_t field, const LanesVec<D>& values) {
    for (std::size_t d = 0; d < D; ++d) add(field + d, part.mass * values[static_cast<int>(d)]);
  };
  const LanesVec<D> spread = part.edges.cwiseAbs2() / 12;
  add(Sums::mass, part.mass);
  add(Sums::internal, part.internal);
  add(Sums::kinetic, part.mass * (0.5 * u.squaredNorm() + surplus));
  put(Sums::momentum, u);
  put(Sums::offset, dx);
  put(Sums::square, dx.cwiseAbs2() + spread);
  for (int d = 0; d < D; ++d)
    put(Sums::moment + static_cast<std::size_t>(d) * D, u * dx[d] + gradient.col(d) * spread[d]);
  std::size_t field = Sums::modes;
  for (std::size_t a = 1; a < std::size_t{1} << D; ++a) {
    if (!isMixed(a)) continue;
    put(field, modes.col(static_cast<int>(a) - 1));
    field += D;
  }
}

/// Cuts a batch of particles at the faces of cells, and adds the parts to the sums.
template <int D>
void cut(const Level& level, const CellsOf<D>& grid, const Batch<D>& batch, const OldBoxes<D>& boxes,
         const Contents<D>& contents, typename CellSums<D>::Fields& sums) {
  const LanesVec<D> centre = load(boxes.x, batch), edges = load(boxes.edges, batch), v = load(boxes.velocity, batch);
  const LanesModes<D> modes = load(boxes.modes, batch);
  const Lanes m = batch.only(load(boxes.mass, batch)), e = load(boxes.internalEnergy, batch),
              affine = load(boxes.affineEnergy, batch);
  const Footprint<D> footprint(grid, batch, centre, edges, Computes<SpanValues::weights>());
  Parts<D> parts(footprint, centre, relativeSlopes<D>(level, contents, 0, batch, edges),
                 relativeSlopes<D>(level, contents, 1, batch, edges));
  LanesVec<D> centroid;
  for (int d = 0; d < D; ++d)
    centroid[d] = parts.sum(footprint, [&](const Part<D>& part) { return part.mass * part.x[d]; });
  LanesTensor<D> gradient;
  for (int d = 0; d < D; ++d) gradient.col(d) = modes.col(gradientColumn(d));
  const Lanes kinetic = parts.sum(footprint, [&](const Part<D>& part) -> Lanes {
    return 0.5 * part.mass * (gradient * (part.x - centroid)).squaredNorm();
  });
  const Lanes most = affine + 0.5 * e;
  gradient *= select(kinetic > most, sqrt(most / kinetic), 1);
  const Lanes surplus = affine - min(kinetic, most), warm = m * e * (1 + min(surplus, 0) / e);
  const std::size_t first = sums.firstOf(footprint);
  footprint.forEachRowOfCells([&](Index<D> k, const Lanes&) {
    std::array<typename CellSums<D>::Fields::Terms, CellSums<D>::count> terms;
    const std::size_t end = first + static_cast<std::size_t>(footprint.along[0].cells);
    for (std::size_t c = 0; c < terms[0].size(); ++c)
      if (c < first || c >= end)
        for (auto& term : terms) term[c] = 0;
    for (std::size_t c = first; c < end; ++k[0], ++c) {
      Part<D>& part = parts.at(k);
      LanesVec<D> middle;
      for (int d = 0; d < D; ++d) middle[d] = grid.along[d].centre(widen(footprint.along[d].first + k[d]));
      const LanesVec<D> u = v + gradient * (part.x - centroid);
      part.mass *= m;
      part.internal *= warm;
      bring<D>(part, part.x - middle, u, gradient, modes, max(surplus, 0),
               [&](std::size_t field, const Lanes& term) { terms[field][c] = term; });
    }
    sums.add(footprint, k, [&](std::size_t n) { return terms[n]; });
  });
}

/// The contents of consecutive cells of a row, one per lane.
template <int D>
struct Contained {
  Lanes mass, internalEnergy;
  Lanes within;        ///< kinetic energy per mass of the motion about the mean velocity [J/kg]
  LanesVec<D> offset;  ///< offset of the centre of mass from the centre of the cell [m]
  LanesVec<D> velocity;
  LanesModes<D> modes;

  Contained(const typename CellSums<D>::Fields& sums, const Index<D>& cell) {
    using Sums = CellSums<D>;
    const auto vectorOf = [&](std::size_t field) {
      LanesVec<D> values;
      for (std::size_t d = 0; d < D; ++d) values[static_cast<int>(d)] = sums.readRow(field + d, cell);
      return values;
    };
    mass = sums.readRow(Sums::mass, cell);
    const Lanes inverse = 1 / mass;
    velocity = inverse * vectorOf(Sums::momentum);
    offset = inverse * vectorOf(Sums::offset);
    const LanesVec<D> square = inverse * vectorOf(Sums::square);
    for (int d = 0; d < D; ++d) {
      const LanesVec<D> moment = inverse * vectorOf(Sums::moment + static_cast<std::size_t>(d) * D);
      modes.col(gradientColumn(d)) = (moment - offset[d] * velocity) / (square[d] - offset[d] * offset[d]);
    }
    std::size_t field = Sums::modes;
    for (std::size_t a = 1; a < std::size_t{1} << D; ++a) {
      if (!isMixed(a)) continue;
      modes.col(static_cast<int>(a) - 1) = inverse * vectorOf(field);
      field += D;
    }
    within = max(0, inverse * sums.readRow(Sums::kinetic, cell) - 0.5 * velocity.squaredNorm());
    internalEnergy = inverse * sums.readRow(Sums::internal, cell);
  }
};

/// The box of a new particle: its cell or, next to an empty cell, the part of the cell that the gas occupies, so that
/// gas does not spread into a vacuum by one cell with every remap. It is at least a tenth of the cell wide.
template <int D>
struct NewBox {
  Vec<D> centre, edges;
  Vec<D> inertia;  ///< mean squares of the distances of nodes from the centre [m²]

  /// `offset` is the offset of the centre of mass from the centre of the cell.
  NewBox(const Level& level, CellView<const double> mass, const Index<D>& cell, const Vec<D>& offset) {
    for (int d = 0; d < D; ++d) {
      const double h = level.spacing(d);
      const bool below = isEmpty(mass, cell - Index<D>::unit(d)), above = isEmpty(mass, cell + Index<D>::unit(d));
      double lower = -0.5 * h, upper = 0.5 * h;
      if (above && !below) upper = std::clamp(0.5 * h + 2 * offset[d], -0.4 * h, 0.5 * h);
      if (below && !above) lower = std::clamp(2 * offset[d] - 0.5 * h, -0.5 * h, 0.4 * h);
      const double middle = 0.5 * (lower + upper);
      centre[d] = positionInCell(level, d, cell[d], 0) + middle;
      edges[d] = upper - lower;
      inertia[d] = 0.25 * h * h - middle * middle;
    }
  }

 private:
  static bool isEmpty(CellView<const double> mass, const Index<D>& cell) {
    return mass.box().contains(cell) && !(mass[cell] > 0);
  }
};

/// Makes the new particle of a cell, with the contents of all parts, in the box NewBox.
template <int D>
GasBox<D> boxOf(const Level& level, CellView<const double> mass, const Index<D>& cell, const Contained<D>& contained,
                int lane) {
  Vec<D> v, offset;
  Modes<D> modes;
  for (int d = 0; d < D; ++d) {
    v[d] = contained.velocity[d][lane];
    offset[d] = contained.offset[d][lane];
    for (int a = 0; a < modes.cols(); ++a) modes(d, a) = contained.modes(d, a)[lane];
  }
  const NewBox<D> box(level, mass, cell, offset);
  const double within = contained.within[lane], affine = std::min(within, modalEnergy<D>(modes, box.inertia));
  return {.id = level.cellNumber(cell) * idsOfCell,
          .x = box.centre,
          .edges = box.edges,
          .mass = contained.mass[lane],
          .velocity = v,
          .modes = modes,
          .internalEnergy = contained.internalEnergy[lane] + (within - affine),
          .affineEnergy = affine};
}

/// Whether all cells of a part of a row, which are as many as there are lanes, and all neighbours contain gas. Beyond
/// the sides of the grid is none.
template <int D>
bool isAmidGas(const Contents<D>& contents, const RowPart<D>& part) {
  if (!part.isFull()) return false;
  const auto hasGas = [&](const Index<D>& cell) { return contents.readRow(0, cell) > 0; };
  Lanes::Mask all = hasGas(part.first);
  for (int d = 0; d < D; ++d) all &= hasGas(part.first - Index<D>::unit(d)) & hasGas(part.first + Index<D>::unit(d));
  return tushar::all(all);
}

/// Appends one value per lane.
template <std::size_t Numbers, class T>
void append(const std::array<Lanes, Numbers>& columns, std::vector<T>& to) {
  static_assert(sizeof(T) == Numbers * sizeof(double));
  const std::size_t size = to.size();
  to.resize(size + Lanes::count);
  double* first = reinterpret_cast<double*>(&to[size]);
  if constexpr (Numbers <= Lanes::count)
    pack(columns, first);
  else
    storeColumns(columns, Lanes::count, [&](int lane) { return first + static_cast<std::size_t>(lane) * Numbers; });
}

/// Makes the new particles of the cells of a part of a row, one per lane, which fill their cells; bitwise equal to
/// those that boxOf makes.
template <int D>
void addWhole(const Level& level, const CellsOf<D>& grid, const RowPart<D>& part, const Contained<D>& contained,
              ParticleMaker& maker, const NewBoxes<D>& fresh) {
  LanesVec<D> centre, edges, inertia;
  for (int d = 0; d < D; ++d) {
    const Lanes cell = d == 0 ? Lanes::of([&](int lane) { return double(part.at(lane)[0]); }) : Lanes(part.first[d]);
    const double h = level.spacing(d);
    centre[d] = grid.along[static_cast<std::size_t>(d)].centre(cell);
    edges[d] = h;
    inertia[d] = 0.25 * h * h;
  }
  const Lanes affine = min(contained.within, modalEnergy<D>(contained.modes, inertia));
  for (int lane = 0; lane < part.count; ++lane) maker.add(part.at(lane), level.cellNumber(part.at(lane)) * idsOfCell);
  append(coefficientsOf<D, 1>(centre), fresh.x);
  append(coefficientsOf<D, 1>(edges), fresh.edges);
  append(std::array{contained.mass}, fresh.mass);
  append(coefficientsOf<D, 1>(contained.velocity), fresh.velocity);
  append(coefficientsOf<D, (1 << D) - 1>(contained.modes), fresh.modes);
  append(std::array{Lanes(contained.internalEnergy + (contained.within - affine))}, fresh.internalEnergy);
  append(std::array{affine}, fresh.affineEnergy);
}

}  // namespace

template <int D>
void remap(const Patch& patch, const OldBoxes<D>& old, CellView<const double> mass, CellView<const double> energy,
           ParticleMaker& maker, const NewBoxes<D>& fresh) {
  const Level& level = patch.level();
  Contents<D> contents(old.x.cells(), true);
  contents.copy(0, mass);
  contents.copy(1, energy);
  const CellsOf<D> grid(level);
  const RowsAround<D> around(patch, old.x.cells(), 0);
  typename CellSums<D>::Fields sums(around.rows, around.blocks);
  const auto visit = [&](const Batch<D>& batch) { cut<D>(level, grid, batch, old, contents, sums); };
  fresh.reserve(maker, static_cast<std::size_t>(old.x.owned()));
  const auto finish = [&](const Index<D>& row) {
    forEachPartOfRow<D>(patch.cells(), row, [&](const RowPart<D>& part) {
      const Contained<D> contained(sums, part.first);
      if (all(contained.mass > 0) && isAmidGas(contents, part))
        return addWhole<D>(level, grid, part, contained, maker, fresh);
      for (int lane = 0; lane < part.count; ++lane) {
        const Index<D> cell = part.at(lane);
        if (contained.mass[lane] > 0) fresh.add(maker, cell, boxOf<D>(level, mass, cell, contained, lane));
      }
    });
  };
  sumOverBoxes<D>(around, old.x, visit, finish, sums);
}

template void remap<1>(const Patch&, const OldBoxes<1>&, CellView<const double>, CellView<const double>, ParticleMaker&,
                       const NewBoxes<1>&);
template void remap<2>(const Patch&, const OldBoxes<2>&, CellView<const double>, CellView<const double>, ParticleMaker&,
                       const NewBoxes<2>&);
template void remap<3>(const Patch&, const OldBoxes<3>&, CellView<const double>, CellView<const double>, ParticleMaker&,
                       const NewBoxes<3>&);

}  // namespace tushar::mpm::gas::conserving
