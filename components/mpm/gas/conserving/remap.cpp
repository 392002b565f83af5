#include "components/mpm/gas/conserving/box_sums.hpp"
#include "components/mpm/gas/conserving/grid_fields.hpp"
#include "components/mpm/gas/conserving/parts.hpp"
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

/// What the boxes of a batch bring to the sums of the cells that they overlap. What is the same for all parts in a cell
/// of an axis is computed once for each of these cells.
template <int D>
struct Brought {
  using Sums = CellSums<D>;
  template <class T>
  using AlongAxes = typename Parts<D>::template AlongAxes<T>;

  AlongAxes<Lanes> offset, square;              ///< dx [m] and dx² + l²/12 [m²]
  AlongAxes<LanesVec<D>> velocity, covariance;  ///< see Parts::velocities; B_d l_d²/12 [m²/s]
  LanesVec<D> mean;                             ///< velocity of the centroid [m/s]
  LanesModes<D> modes;
  Lanes surplus;  ///< energy per mass that becomes kinetic energy within the cells [J/kg]

  Brought(const CellsOf<D>& grid, const Footprint<D>& footprint, const Parts<D>& parts,
          const LanesTensor<D>& gradient) {
    for (std::size_t d = 0; d < D; ++d)
      for (std::size_t k = 0; k < static_cast<std::size_t>(footprint.along[d].cells); ++k) {
        const Lanes middle = grid.along[d].centre(widen(footprint.along[d].first + static_cast<int>(k)));
        offset[d][k] = parts.middle[d][k] - middle;
        square[d][k] = offset[d][k] * offset[d][k] + parts.spread[d][k];
        for (int c = 0; c < D; ++c) covariance[d][k][c] = gradient(c, static_cast<int>(d)) * parts.spread[d][k];
      }
  }
  /// Adds the part in cell k, which has this mass and internal energy; `add(field, term)` adds to one of the sums.
  template <class Add>
  [[gnu::always_inline]] void bring(const Index<D>& k, const Lanes& mass, const Lanes& internal, Add&& add) const {
    const auto of = [&](const auto& along, std::size_t d) -> const auto& {
      return along[d][static_cast<std::size_t>(k[static_cast<int>(d)])];
    };
    const LanesVec<D> u = mean + Parts<D>::sumOverAxes(velocity, k);
    add(Sums::mass, mass);
    add(Sums::internal, internal);
    add(Sums::kinetic, mass * (0.5 * u.squaredNorm() + surplus));
    for (std::size_t d = 0; d < D; ++d) {
      add(Sums::momentum + d, mass * u[static_cast<int>(d)]);
      add(Sums::offset + d, mass * of(offset, d));
      add(Sums::square + d, mass * of(square, d));
      for (std::size_t c = 0; c < D; ++c) {
        const int row = static_cast<int>(c);
        add(Sums::moment + d * D + c, mass * (u[row] * of(offset, d) + of(covariance, d)[row]));
      }
    }
    std::size_t field = Sums::modes;
    for (std::size_t a = 1; a < std::size_t{1} << D; ++a) {
      if (!isMixed(a)) continue;
      for (int d = 0; d < D; ++d) add(field++, mass * modes(d, static_cast<int>(a) - 1));
    }
  }
};

/// Cuts a batch of particles at the faces of cells, and adds the parts to the sums.
template <int D>
void cut(const Level& level, const CellsOf<D>& grid, const Batch<D>& batch, const OldBoxes<D>& boxes,
         const Contents<D>& contents, typename CellSums<D>::Fields& sums) {
  const LanesVec<D> centre = load(boxes.x, batch), edges = load(boxes.edges, batch);
  const LanesModes<D> modes = load(boxes.modes, batch);
  const Lanes m = batch.only(load(boxes.mass, batch)), e = load(boxes.internalEnergy, batch),
              affine = load(boxes.affineEnergy, batch);
  const Footprint<D> footprint(grid, batch, centre, edges, Computes<SpanValues::weights>());
  Parts<D> parts(footprint, centre, relativeSlopes<D>(level, contents, 0, batch, edges),
                 relativeSlopes<D>(level, contents, 1, batch, edges));
  const LanesVec<D> centroid = parts.centroid();
  LanesTensor<D> gradient;
  for (int d = 0; d < D; ++d) gradient.col(d) = modes.col(gradientColumn(d));
  const Lanes kinetic = parts.kineticEnergy(parts.velocities(gradient, centroid)), most = affine + 0.5 * e;
  gradient *= select(kinetic > most, sqrt(most / kinetic), 1);
  const Lanes surplus = affine - min(kinetic, most), warm = m * e * (1 + min(surplus, 0) / e);
  Brought<D> brought(grid, footprint, parts, gradient);
  brought.velocity = parts.velocities(gradient, centroid);
  brought.mean = load(boxes.velocity, batch);
  brought.modes = modes;
  brought.surplus = max(surplus, 0);
  footprint.withExtentOfRows([&](auto extent) __attribute__((always_inline)) {
    constexpr std::size_t cells = decltype(extent)::cells;
    footprint.forEachRowOfCells([&](Index<D> k, const Lanes&) __attribute__((always_inline)) {
      std::array<std::array<Lanes, cells>, CellSums<D>::count> terms;
      for (std::size_t c = 0; c < cells; ++k[0], ++c)
        brought.bring(
            k, parts.mass(k) * m,
            parts.internal(k) * warm, [&](std::size_t field, const Lanes& term) __attribute__((always_inline)) {
              terms[field][c] = term;
            });
      sums.add(
          footprint, k, [&](std::size_t n) __attribute__((always_inline)) { return sums.widened(extent, terms[n]); });
    });
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
      const Lanes perVariance = 1 / (square[d] - offset[d] * offset[d]);
      modes.col(gradientColumn(d)) = perVariance * (moment - offset[d] * velocity);
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
