#include "tests/mpmice/fields.hpp"

#include "components/mpmice/tasks/measure_motion.hpp"

namespace tushar::mpmice {

namespace {

template <class T>
class BodiesAlongAxes : public testing::Test {};
TYPED_TEST_SUITE(BodiesAlongAxes, AllAxes);

/// Returns the volume that boxes leave free in a cube of cells.
template <int D>
struct Shares {
  explicit Shares(int size) : volume(cube<D>(size), 1), coverage(cube<D>(size), Vec<D>::Zero()) {}
  Field<double> volume;
  Field<Vec<D>> coverage;
  TakenShares<D> taken{{volume.cells(), coverage.cells()}};
};

/// A box centred in a cell, in coordinates of that cell.
template <int D>
ParticleBox<D> boxAt(double seed) {
  ParticleBox<D> box;
  for (int d = 0; d < D; ++d) {
    box.middle[d] = 0.999 * wild(seed + d);
    box.edges[d] = 0.1 + 1.3 * wild(3 * seed + d + 0.5);
  }
  return box;
}

/// Returns the greatest free volume of a cell within a plane body that is deformed by F, with 2 x 2 particles per cell;
/// `seed` selects its place.
double greatestHoleOf(const mpm::solid::Matrix3& f, int seed) {
  const Grid grid(euler::closedBox(2, 9));
  const Vec<2> size = Vec<2>::Constant(0.5);
  Shares<2> shares(9);
  for (int i = -40; i < 40; ++i)
    for (int j = -40; j < 40; ++j) {
      const Vec<2> x = f.topLeftCorner<2, 2>() * Vec<2>(0.5 * i, 0.5 * j) + Vec<2>(wild(seed), wild(seed + 0.5)) +
                       Vec<2>::Constant(4.5);
      const Index<2> cell{static_cast<int>(std::floor(x[0])), static_cast<int>(std::floor(x[1]))};
      shares.taken.take(cell, {Vec<2>(x[0] - cell[0], x[1] - cell[1]), edgesOf<2>(grid.level(), size, f)});
    }
  shares.taken.settle();
  double greatest = 0;
  forEach<2>(cube<2>(9), [&](const Index<2>& cell) { greatest = std::max(greatest, shares.volume.seen()[cell]); });
  return greatest;
}

}  // namespace

TYPED_TEST(BodiesAlongAxes, LeaveAsMuchFreeBetweenSymmetryPlanesAsWithTheirImagesBeyond) {
  constexpr int D = TypeParam::value;
  constexpr int size = 4;
  const Level level(euler::closedBox(D, size));
  Shares<D> whole(3 * size);
  Field<double> volume(cube<D>(size), 1);
  Field<Vec<D>> coverage(cube<D>(size), Vec<D>::Zero()), atEnd(coverage);
  TakenShares<D> taken({volume.cells(), coverage.cells(), atEnd.cells()}, BoxImages<D>(level));
  forEach<D>(cube<D>(size), [&](const Index<D>& cell) {
    const ParticleBox<D> box = boxAt<D>(7 * level.cellNumber<D>(cell));
    taken.take(cell, box);
    EXPECT_TRUE(taken.planes().areNear(cell));
    taken.planes().template forEachOf<1>(cell, {box},
                                         [&](const Index<D>& at, const auto& images) { taken.take(at, images[0]); });
    forEach<D>(cube<D>(3), [&](const Index<D>& tile) {  // the middle tile is the grid
      Index<D> at;
      ParticleBox<D> image = box;
      for (int d = 0; d < D; ++d) {
        at[d] = size * tile[d] + (tile[d] == 1 ? cell[d] : size - 1 - cell[d]);
        if (tile[d] != 1) image.middle[d] = 1 - box.middle[d];
      }
      whole.taken.take(at, image);
    });
  });
  taken.settle();
  whole.taken.settle();
  forEach<D>(cube<D>(size), [&](const Index<D>& cell) {
    const Index<D> there = cell + Index<D>::filled(size);
    EXPECT_NEAR(volume.seen()[cell], whole.volume.seen()[there], 1e-14);
    for (int d = 0; d < D; ++d) {
      const Index<D> above = there + Index<D>::unit(d);
      EXPECT_NEAR(coverage.seen()[cell][d], whole.coverage.seen()[there][d], 1e-14);
      EXPECT_NEAR(atEnd.seen()[cell][d], cell[d] == size - 1 ? whole.coverage.seen()[above][d] : 0, 1e-14);
    }
  });
}

TYPED_TEST(BodiesAlongAxes, LeaveNothingFreeWhereTheyTileTheCells) {
  constexpr int D = TypeParam::value;
  Shares<D> shares(5);
  // Three boxes along each axis of the cells 0 to 4; the faces of 1 to 4 are within.
  forEach<D>(cube<D>(15), [&](const Index<D>& at) {
    Index<D> cell;
    ParticleBox<D> box;
    for (int d = 0; d < D; ++d) {
      cell[d] = at[d] / 3;
      box.middle[d] = (at[d] % 3 + 0.5) / 3;
      box.edges[d] = 1.0 / 3;
    }
    shares.taken.take(cell, box);
  });
  shares.taken.settle();
  forEach<D>(cube<D>(5), [&](const Index<D>& cell) {
    EXPECT_NEAR(shares.volume.seen()[cell], 0, 4e-15);
    for (int d = 0; d < D; ++d) EXPECT_NEAR(shares.coverage.seen()[cell][d], cell[d] == 0 ? 0.5 : 1.0, 1e-14);
  });
}

TYPED_TEST(BodiesAlongAxes, TakeTheirVolume) {
  constexpr int D = TypeParam::value;
  for (int seed = 0; seed < 50; ++seed) {
    Shares<D> shares(7);
    const ParticleBox<D> box = boxAt<D>(seed);
    shares.taken.take(Index<D>::filled(3), box);
    shares.taken.settle();
    double taken = 0;
    for (const double left : shares.volume.values) taken += 1 - left;
    EXPECT_NEAR(taken, box.edges.prod(), 1e-13);
  }
}

TYPED_TEST(BodiesAlongAxes, OfOneCellTakeTheSameTogetherAsAlone) {
  constexpr int D = TypeParam::value;
  constexpr int count = 20;
  const Index<D> origin = Index<D>::filled(4);
  Shares<D> together(9);
  Field<double> volume(cube<D>(9), 1);
  Field<Vec<D>> coverage(cube<D>(9), Vec<D>::Zero());
  for (int seed = 0; seed < count; ++seed) {
    ParticleBox<D> box = boxAt<D>(seed);
    for (int d = 0; d < D; ++d) box.middle[d] += 3 * wild(5 * seed + d) - 1.5;  // it has moved to another cell
    box.edges *= 0.2;
    Shares<D> alone(9);
    for (TakenShares<D>* taken : {&alone.taken, &together.taken}) taken->take(origin, box);
    alone.taken.settle();
    for (std::size_t k = 0; k < volume.values.size(); ++k) {
      volume.values[k] -= 1 - alone.volume.values[k];
      coverage.values[k] += alone.coverage.values[k];
    }
  }
  together.taken.settle();
  for (std::size_t k = 0; k < volume.values.size(); ++k) {
    EXPECT_NEAR(together.volume.values[k], std::max(0.0, volume.values[k]), 1e-14);
    for (int d = 0; d < D; ++d) EXPECT_NEAR(together.coverage.values[k][d], coverage.values[k][d], 1e-14);
  }
}

/// On another patch, a cell may be the first one with particles, or not.
TYPED_TEST(BodiesAlongAxes, TakeTheSameBitsWhateverWasTakenBefore) {
  constexpr int D = TypeParam::value;
  for (const bool isFirst : {true, false}) {
    Shares<D> shares(9), reference(9);
    if (!isFirst) shares.taken.take(Index<D>::filled(6), {Vec<D>::Constant(0.5), Vec<D>::Constant(0.3)});
    reference.taken.take(Index<D>::filled(7), {Vec<D>::Constant(0.5), Vec<D>::Constant(0.3)});
    for (const double middle : {0.7, 0.3, 0.9, 0.1, 0.6})
      for (Shares<D>* one : {&shares, &reference})
        one->taken.take(Index<D>{}, {Vec<D>::Constant(middle), Vec<D>::Constant(0.31 + 0.1 * middle)});
    shares.taken.settle();
    reference.taken.settle();
    forEach<D>(cube<D>(3), [&](const Index<D>& cell) {
      EXPECT_EQ(shares.volume.seen()[cell], reference.volume.seen()[cell]);
      EXPECT_EQ(shares.coverage.seen()[cell], reference.coverage.seen()[cell]);
    });
  }
}

TYPED_TEST(BodiesAlongAxes, ThatOverlapLeaveNoLessThanNothing) {
  constexpr int D = TypeParam::value;
  Shares<D> shares(3);
  ParticleBox<D> box{Vec<D>::Constant(0.5), Vec<D>::Ones()};
  for (int k = 0; k < 3; ++k) shares.taken.take(Index<D>::filled(1), box);
  shares.taken.settle();
  EXPECT_EQ(shares.volume.seen()[Index<D>::filled(1)], 0);
}

/// Boxes do not shear or turn with their particles, but their volumes are right and their centres regular. So what they
/// leave free of a cell within a body is less than the free volume below which a hole is closed.
TEST(Bodies, ThatAreShearedOrTurnedLeaveOnlySmallHoles) {
  const auto turned = [](double angle) {
    mpm::solid::Matrix3 f = mpm::solid::Matrix3::Identity();
    f(0, 0) = f(1, 1) = std::cos(angle);
    f(1, 0) = std::sin(angle);
    f(0, 1) = -f(1, 0);
    return f;
  };
  const auto sheared = [](double by) {
    mpm::solid::Matrix3 f = mpm::solid::Matrix3::Identity();
    f(0, 1) = by;
    return f;
  };
  const auto stretched = [&](double by) {
    const mpm::solid::Matrix3 axes = turned(0.25 * M_PI), stretch = Vec3(by, 1 / by, 1).asDiagonal();
    return mpm::solid::Matrix3(axes * stretch * axes.transpose());
  };
  double greatest = 0;
  for (const mpm::solid::Matrix3& f : {turned(0.1), turned(0.5), turned(0.25 * M_PI), sheared(0.1), sheared(0.5),
                                       sheared(1), stretched(1.2), stretched(1.5), stretched(2)})
    for (int seed = 0; seed < 4; ++seed) greatest = std::max(greatest, greatestHoleOf(f, seed));
  EXPECT_LT(greatest, 0.4 * narrowFreeVolume);  // .071 with a body turned by 45 degrees
}

TYPED_TEST(BodiesAlongAxes, SweepWhatCellsGainOrLose) {
  constexpr int D = TypeParam::value;
  for (int seed = 0; seed < 50; ++seed) {
    Shares<D> old(9), fresh(9);
    Field<Vec<D>> swept(cube<D>(9), Vec<D>::Zero());
    const ParticleBox<D> before = boxAt<D>(seed);
    ParticleBox<D> after = before;
    for (int d = 0; d < D; ++d) after.middle[d] += 1.6 * wild(7 * seed + d) - 0.8;
    const Index<D> origin = Index<D>::filled(4);
    old.taken.take(origin, before);
    old.taken.settle();
    fresh.taken.take(origin, after);
    fresh.taken.settle();
    Field<Vec<D>> by = swept;
    const SweptFaces<D> faces{swept.cells(), by.cells()};
    Sweeps<D>(faces).add(origin, before, after);
    forEach<D>(cube<D>(8), [&](const Index<D>& cell) {
      double left = 0;
      for (int d = 0; d < D; ++d) left += swept.seen()[cell + Index<D>::unit(d)][d] - swept.seen()[cell][d];
      EXPECT_NEAR(fresh.volume.seen()[cell] - old.volume.seen()[cell], left, 4e-15) << seed;
    });
  }
}

TEST(SweptFaces, AreTheSameForTurnedMotionsInThreeDimensions) {
  const ParticleBox<3> before{{0.4, 0.5, 0.3}, {0.5, 0.25, 0.75}};
  const Vec<3> way(0.5, -0.375, 0.625);
  const auto sweep = [&](const std::array<int, 3>& axes) {
    Field<Vec<3>> swept(cube<3>(9), Vec<3>::Zero()), by = swept;
    const SweptFaces<3> faces{swept.cells(), by.cells()};
    ParticleBox<3> turned = before;
    for (int d = 0; d < 3; ++d) {
      turned.middle[axes[d]] = before.middle[d];
      turned.edges[axes[d]] = before.edges[d];
    }
    ParticleBox<3> after = turned;
    for (int d = 0; d < 3; ++d) after.middle[axes[d]] += way[d];
    Sweeps<3>(faces).add(Index<3>::filled(4), turned, after);
    return swept;
  };
  const auto straight = sweep({0, 1, 2});
  double greatest = 0;
  for (const std::array<int, 3> axes : {std::array{1, 0, 2}, {2, 1, 0}, {0, 2, 1}, {1, 2, 0}, {2, 0, 1}}) {
    const auto turned = sweep(axes);
    forEach<3>(cube<3>(9), [&](const Index<3>& cell) {
      Index<3> other;
      for (int d = 0; d < 3; ++d) other[axes[d]] = cell[d];
      for (int d = 0; d < 3; ++d) {
        EXPECT_NEAR(turned.seen()[other][axes[d]], straight.seen()[cell][d], 1e-16);
        greatest = std::max(greatest, std::abs(straight.seen()[cell][d]));
      }
    });
  }
  EXPECT_GT(greatest, 1e-2);
}

TYPED_TEST(BodiesAlongAxes, SweepTheirCrossSectionTimesTheirWay) {
  constexpr int D = TypeParam::value;
  Field<Vec<D>> swept(cube<D>(5), Vec<D>::Zero());
  const ParticleBox<D> before{Vec<D>::Constant(0.5), Vec<D>::Constant(0.5)};
  ParticleBox<D> after = before;
  after.middle[0] += 0.5;  // half of it through the upper face of its cell
  Field<Vec<D>> by = swept;
  const SweptFaces<D> faces{swept.cells(), by.cells()};
  Sweeps<D> sweeps(faces);
  sweeps.add(Index<D>::filled(2), before, after);
  sweeps.settle();
  forEach<D>(cube<D>(5), [&](const Index<D>& cell) {
    const bool isFace = cell == Index<D>::filled(2) + Index<D>::unit(0);
    for (int d = 0; d < D; ++d) {
      EXPECT_EQ(swept.seen()[cell][d], isFace && d == 0 ? 0.25 * std::pow(0.5, D - 1) : 0.0);
      EXPECT_EQ(by.seen()[cell][d], isFace && d == 0 ? 0.5 : c::notSwept);
    }
  });
}

TYPED_TEST(BodiesAlongAxes, SweepFacesOnlyNearGas) {
  constexpr int D = TypeParam::value;
  const Grid grid(euler::closedBox(D, 16));
  const Box& cells = grid.level().cells();
  Field<double> free(cells, 1), mass(cells, 1);
  const Box body = cells.grown(-1, D), inner = body.grown(-sweptReach, D);
  forEach<D>(body, [&](const Index<D>& cell) { free.cells()[cell] = mass.cells()[cell] = 0; });
  // A patch that covers the grid knows no cells beyond its sides; these count as cells with gas.
  const CellMarks<D> needed = GasNearby{{free.seen(), mass.seen()}}.template mark<D>(grid.patches().front());
  const CellMarks<D> around = markAround<D>(grid.patches().front(), needed);
  forEach<D>(cells, [&](const Index<D>& cell) {
    EXPECT_EQ(needed(cell), !inner.contains(cell));
    EXPECT_EQ(around(cell), !inner.grown(-1, D).contains(cell));
  });
  Field<Vec<D>> swept(cells, Vec<D>::Zero()), by(cells, Vec<D>::Zero());
  const SweptFaces<D> faces{swept.cells(), by.cells()};
  Sweeps<D> sweeps(faces);
  const Index<D> last = Index<D>::filled(inner.upper[0] - 1);
  Index<D> outside = last;
  ++outside[0];
  for (const Index<D>& face : {last, outside}) {  // a box of a cell, halfway through the face
    ParticleBox<D> before{Vec<D>::Constant(0.5), Vec<D>::Ones()};
    before.middle[0] = 0;
    ParticleBox<D> after = before;
    after.middle[0] += 0.25;
    sweeps.add(face, before, after);
  }
  sweeps.settle(needed);
  EXPECT_EQ(swept.seen()[last], Vec<D>(Vec<D>::Zero()));
  EXPECT_EQ(by.seen()[last][0], c::notSwept);
  EXPECT_EQ(swept.seen()[outside][0], 0.25);
  EXPECT_EQ(by.seen()[outside][0], 0.25);
}

namespace {

/// A grid of 6 cells along each of D axes without its lower left corner of 3 x 3 cells.
template <int D>
grid::Domain withoutCorner() {
  grid::Domain domain;
  domain.resolution = {{6, 6, D == 3 ? 6 : 1}};
  domain.upper[2] = D == 3 ? 1 : 0;
  const int top = domain.resolution[2];
  domain.boxes = {{{{0, 3, 0}}, {{6, 6, top}}}, {{{3, 0, 0}}, {{6, 3, top}}}};
  return domain;
}

template <int D>
void fillOutsideOfBodiesThatFillAll(double freeAtSide, double most) {
  const Level level(withoutCorner<D>());
  Shares<D> shares(6);
  shares.volume.cells().fill(0);
  Index<D> atSide{}, away{};
  atSide[0] = 3;
  away[0] = 4;
  shares.volume.cells()[atSide] = freeAtSide;
  shares.volume.cells()[away] = 0.5;
  fillOutside<D>(level, {shares.volume.cells(), shares.coverage.cells()}, most);
  EXPECT_EQ(shares.volume.seen()[away], 0.5);
  EXPECT_EQ(shares.volume.seen()[atSide], freeAtSide);
  forEach<D>(cube<D>(6), [&](const Index<D>& cell) {
    const bool isOutside = cell[0] < 3 && cell[1] < 3;
    EXPECT_TRUE(!isOutside || shares.volume.seen()[cell] == 0);
    for (int d = 0; d < D; ++d) {
      const bool isInnerSide = d < 2 && cell[d] == 3 && cell[1 - d] < 3;
      EXPECT_EQ(shares.coverage.seen()[cell][d], isOutside || isInnerSide ? 1 : 0) << cell[0] << ' ' << cell[1];
    }
  });
}

}  // namespace

TEST(OutsideOfSeveralBoxes, IsFilledAndCovered) {
  fillOutsideOfBodiesThatFillAll<2>(0, leastFreeVolume);
  fillOutsideOfBodiesThatFillAll<3>(0, leastFreeVolume);
  fillOutsideOfBodiesThatFillAll<2>(0.1, narrowFreeVolume);
}

TEST(OutsideOfSeveralBoxes, MustNotMeetGas) {
  EXPECT_THROW(fillOutsideOfBodiesThatFillAll<2>(0.1, leastFreeVolume), NumericalError);
  EXPECT_THROW(fillOutsideOfBodiesThatFillAll<3>(0.3, narrowFreeVolume), NumericalError);
}

}  // namespace tushar::mpmice
