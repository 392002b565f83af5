#include "components/mpmice/free_space.hpp"

#include "components/mpmice/near_bodies.hpp"
#include "tests/mpmice/fields.hpp"

namespace tushar::mpmice {

namespace {

template <class T>
class FreeSpaceAlongAxes : public testing::Test {};
TYPED_TEST_SUITE(FreeSpaceAlongAxes, AllAxes);

/// Cells one third of which are empty, one third gas only, and the others partly filled.
template <int D>
GasFields<D> porous(const Level& level) {
  GasFields<D> fields(level.cells());
  for (std::size_t k = 0; k < fields.free.values.size(); ++k) {
    const double number = wild(k + 0.3);
    fields.free.values[k] = number < 0.3 ? 0 : number < 0.6 ? 1 : number - 0.6;
    for (int d = 0; d < D; ++d) fields.coverage.values[k][d] = 1.2 * wild(k + 0.17 * d);
  }
  return fields;
}

/// A grid of 6 cells along each axis.
template <int D>
struct Cube {
  Level level{euler::closedBox(D, 6)};
  Settings settings;
};

}  // namespace

TYPED_TEST(FreeSpaceAlongAxes, HasTheSameAreaOnBothSidesOfACell) {
  constexpr int D = TypeParam::value;
  const Cube<D> cube;
  const GasFields<D> fields = porous<D>(cube.level);
  const FreeSpace<D> space(cube.level, cube.settings, fields.gas());
  forEach<D>(cube.level.cells(), [&](const Index<D>& cell) {
    if (space.isEmpty(cell)) return;
    for (int d = 0; d < D; ++d) {
      for (int side = 0; side < 2; ++side) {
        EXPECT_GE(space.faces(cell, d).wall(side), 0);
        EXPECT_GE(space.aperture(cell, d, side), 0);
        EXPECT_LE(space.aperture(cell, d, side), 1);
      }
      const double lower = space.faces(cell, d).wall(0) + space.aperture(cell, d, 0);
      EXPECT_NEAR(space.faces(cell, d).wall(1) + space.aperture(cell, d, 1), lower, 1e-15);
      EXPECT_GE(space.faces(cell, d).area, fields.free.seen()[cell]);
    }
  });
}

TYPED_TEST(FreeSpaceAlongAxes, IsAsOpenOnASymmetryPlaneAsBetweenACellAndItsImage) {
  constexpr int D = TypeParam::value;
  const Cube<D> cube;
  GasFields<D> fields = porous<D>(cube.level);
  Field<Vec<D>> atEnd(cube.level.cells(), Vec<D>::Zero());
  for (std::size_t k = 0; k < atEnd.values.size(); ++k) atEnd.values[k].setConstant(1.2 * wild(k + 0.7));
  GasInCells<D> gas = fields.gas();
  gas.coverageAtEnd = atEnd.seen();
  const FreeSpace<D> space(cube.level, cube.settings, gas);
  int closed = 0, open = 0;
  forEach<D>(cube.level.cells(), [&](const Index<D>& cell) {
    const double room = fields.free.seen()[cell];
    for (int d = 0; d < D; ++d)
      for (const int side : {0, 1}) {
        if (!space.isAtSide(cell, d, side)) continue;
        const double covered = (side == 0 ? fields.coverage : atEnd).seen()[cell][d];
        const double expected = space.isEmpty(cell) ? 0 : openShare(covered, room, room, false);
        EXPECT_EQ(space.aperture(cell, d, side), expected);
        (expected > 0 ? open : closed) += 1;
      }
  });
  EXPECT_GT(std::min(open, closed), 0);
}

TYPED_TEST(FreeSpaceAlongAxes, IsAsOpenFromOneSideOfAFaceAsFromTheOther) {
  constexpr int D = TypeParam::value;
  const Cube<D> cube;
  const GasFields<D> fields = porous<D>(cube.level);
  const FreeSpace<D> space(cube.level, cube.settings, fields.gas());
  forEach<D>(cube.level.cells(), [&](const Index<D>& cell) {
    for (int d = 0; d < D; ++d) {
      if (space.isAtSide(cell, d, 0)) continue;
      EXPECT_EQ(space.aperture(cell, d, 0), space.aperture(cell - Index<D>::unit(d), d, 1));
    }
  });
}

TYPED_TEST(FreeSpaceAlongAxes, IsTheSameIfMeasuredAtOnce) {
  constexpr int D = TypeParam::value;
  Cube<D> cube;
  for (const bool thinWalls : {false, true}) {
    cube.settings.thinWalls = thinWalls;
    GasFields<D> fields = porous<D>(cube.level);
    for (std::size_t k = 0; k < fields.density.values.size(); k += 3) fields.density.values[k] = 0;
    const FreeSpace<D> one(cube.level, cube.settings, fields.gas());
    FreeSpace<D> all = one;
    all.measure(NearBodies<D>(cube.level.cells(), nearLayers, fields.free.seen(), fields.density.seen()));
    forEach<D>(cube.level.cells(), [&](const Index<D>& cell) {
      for (int d = 0; d < D; ++d)
        for (int side = 0; side < 2; ++side) EXPECT_EQ(all.aperture(cell, d, side), one.aperture(cell, d, side));
    });
  }
}

TYPED_TEST(FreeSpaceAlongAxes, IsClosedBesideEmptyCellsAndOpenWhereNoBodyIs) {
  constexpr int D = TypeParam::value;
  const Cube<D> cube;
  GasFields<D> fields(cube.level.cells());
  const Index<D> empty = Index<D>::filled(3);
  fields.free.cells()[empty] = 0;
  const FreeSpace<D> space(cube.level, cube.settings, fields.gas());
  forEach<D>(cube.level.cells(), [&](const Index<D>& cell) {
    for (int d = 0; d < D; ++d)
      for (int side = 0; side < 2; ++side) {
        const Index<D> next = side == 0 ? cell - Index<D>::unit(d) : cell + Index<D>::unit(d);
        const bool isClosed = cell == empty || next == empty;
        EXPECT_EQ(space.aperture(cell, d, side), isClosed ? 0 : 1);
        EXPECT_EQ(space.faces(cell, d).wall(side), isClosed && !(cell == empty) ? 1 : 0);
      }
  });
}

TYPED_TEST(FreeSpaceAlongAxes, IsOpenToVacuumsOnlyIfTheGasExpandsWithoutLimit) {
  constexpr int D = TypeParam::value;
  Cube<D> cube;
  GasFields<D> fields(cube.level.cells());
  const Index<D> vacuum = Index<D>::filled(3), next = vacuum + Index<D>::unit(0);
  fields.density.cells()[vacuum] = fields.density.cells()[next] = 0;
  const NearBodies<D> near(cube.level.cells(), nearLayers, fields.free.seen(), fields.density.seen());
  for (const double liquid : {0.0, 1.0}) {
    cube.settings.gas.gas.pInfinity = liquid;
    const FreeSpace<D> one(cube.level, cube.settings, fields.gas());
    FreeSpace<D> all = one;
    all.measure(near);
    for (const FreeSpace<D>& space : {one, all}) {
      EXPECT_EQ(space.aperture(vacuum, 0, 0), liquid > 0 ? 0 : 1);
      EXPECT_EQ(space.aperture(next, 0, 1), liquid > 0 ? 0 : 1);
      EXPECT_EQ(space.aperture(next, 0, 0), 0);
      EXPECT_EQ(space.faces(vacuum - Index<D>::unit(0), 0).wall(1), liquid > 0 ? 1 : 0);
      EXPECT_EQ(space.faces(vacuum, 0).area, 0);
    }
  }
}

TYPED_TEST(FreeSpaceAlongAxes, HasANormalIntoABodyAcrossAnyPlane) {
  constexpr int D = TypeParam::value;
  const Cube<D> cube;
  GasFields<D> fields(cube.level.cells());
  Vec<D> into;
  for (int d = 0; d < D; ++d) into[d] = 1 - 1.3 * d;
  into.normalize();
  // The filling increases along `into`: the gradient of a linear function is exact, away from the sides.
  forEach<D>(cube.level.cells(), [&](const Index<D>& cell) {
    double along = 0;
    for (int d = 0; d < D; ++d) along += into[d] * (cell[d] - 2);
    fields.free.cells()[cell] = 0.5 - 0.04 * along;
  });
  const FreeSpace<D> space(cube.level, cube.settings, fields.gas());
  EXPECT_NEAR((space.normal(Index<D>::filled(2)) - into).norm(), 0, 1e-14);
}

TEST(FreeSpace, LetsNoGasRushOutOfCellsThatAreAllButFull) {
  const Level level(euler::closedBox(1, 4));
  GasFields<1> fields(level.cells());
  fields.free.values[1] = 0.01;
  const FreeSpace<1> space(level, {}, fields.gas());
  EXPECT_DOUBLE_EQ(space.aperture({1}, 0, 0), 0.08);
  EXPECT_DOUBLE_EQ(space.aperture({1}, 0, 1), 0.08);
}

TEST(FreeSpace, IsClosedByThinBodiesWhereAskedTo) {
  const Level level(euler::closedBox(1, 6));
  GasFields<1> fields(level.cells());
  fields.free.values[2] = 0.65;  // a plate of .35 of a cell, in the middle of one: its boxes cover no face
  Settings settings;
  EXPECT_EQ(FreeSpace<1>(level, settings, fields.gas()).aperture({2}, 0, 0), 1);
  settings.thinWalls = true;
  const FreeSpace<1> space(level, settings, fields.gas());
  EXPECT_EQ(space.aperture({2}, 0, 0), 0);
  EXPECT_EQ(space.aperture({2}, 0, 1), 0);
  EXPECT_EQ(space.aperture({4}, 0, 1), 1);
}

TYPED_TEST(FreeSpaceAlongAxes, KnowsTheCellsNearBodies) {
  constexpr int D = TypeParam::value;
  Field<double> free(cube<D>(9), 1);
  Field<double> mass(cube<D>(9), 1);
  free.cells()[Index<D>::filled(4)] = 0.99;
  const NearBodies<D> near(cube<D>(9), 2, free.seen(), mass.seen());
  const auto isNear = [](const Index<D>& cell) {
    bool inside = true;
    for (int d = 0; d < D; ++d) inside &= std::abs(cell[d] - 4) <= 2;
    return inside;
  };
  int visits = 0;
  near.forEachIn(cube<D>(9), [&](const Index<D>& cell) {
    EXPECT_TRUE(isNear(cell));
    ++visits;
  });
  EXPECT_EQ(visits, std::pow(5, D));
  forEach<D>(cube<D>(9), [&](const Index<D>& cell) { EXPECT_EQ(near(cell), isNear(cell)); });
  EXPECT_TRUE(near.anyIn(cube<D>(3)));
  EXPECT_FALSE(near.anyIn(cube<D>(2)));
  EXPECT_FALSE(NearBodies<D>(cube<D>(2), 1, free.seen(), mass.seen()).hasAny());
  mass.cells()[Index<D>{}] = 0;
  EXPECT_TRUE(NearBodies<D>(cube<D>(2), 1, free.seen(), mass.seen()).hasAny());
}

TYPED_TEST(FreeSpaceAlongAxes, KnowsTheCellsInBodiesThatNoGasCanReach) {
  constexpr int D = TypeParam::value;
  const Box cells = cube<D>(13), body = cells.grown(-2, D), inner = body.grown(-2, D);
  Field<double> free(cells, 1), mass(cells, 1);
  forEach<D>(body, [&](const Index<D>& cell) { free.cells()[cell] = mass.cells()[cell] = 0; });
  const NearBodies<D> near(cells, 2, free.seen(), mass.seen());
  Field<int> visits(cells, 0);
  near.forEachActingIn(cells, [&](const Index<D>& cell) { ++visits.cells()[cell]; });
  forEach<D>(cells, [&](const Index<D>& cell) {
    EXPECT_EQ(visits.seen()[cell], inner.contains(cell) ? 0 : 1);
    EXPECT_EQ(near.acts(cell), !inner.contains(cell));
    EXPECT_TRUE(near(cell));
  });
}

TYPED_TEST(FreeSpaceAlongAxes, DividesRowsIntoNearAndFarRuns) {
  constexpr int D = TypeParam::value;
  Field<double> free(cube<D>(9), 1);
  const Field<double> mass(cube<D>(9), 1);
  free.cells()[Index<D>::filled(4)] = 0.5;
  const NearBodies<D> near(cube<D>(9), 1, free.seen(), mass.seen());
  Field<int> visits(cube<D>(9), 0);
  near.forEachFarRunIn(cube<D>(9), [&](Index<D> first, int count) {
    for (int i = 0; i < count; ++i, ++first[0]) ++visits.cells()[first];
  });
  forEach<D>(cube<D>(9), [&](const Index<D>& cell) { EXPECT_EQ(visits.seen()[cell], near(cell) ? 0 : 1); });
}

TYPED_TEST(FreeSpaceAlongAxes, HasNoWallsAtOpenFaces) {
  constexpr int D = TypeParam::value;
  const Level level(euler::closedBox(D, 7));
  GasFields<D> fields(level.cells());
  const Index<D> body = Index<D>::filled(3);
  fields.free.cells()[body] = 0.7;
  fields.coverage.cells()[body][0] = 0.2;
  const FreeSpace<D> space(level, {}, fields.gas());
  forEach<D>(level.cells(), [&](const Index<D>& cell) {
    for (int axis = 0; axis < D; ++axis) {
      const bool touches = cell == body || cell - Index<D>::unit(axis) == body;
      EXPECT_EQ(space.isOpen(cell, axis), cell[axis] > 0 && !touches);
      const OpenFaces faces = space.faces(cell, axis);
      EXPECT_TRUE(!space.isOpen(cell, axis) || faces.wall(0) == 0);
      EXPECT_TRUE(!space.isOpenAround(cell) || (faces.wall(0) == 0 && faces.wall(1) == 0));
    }
  });
}

}  // namespace tushar::mpmice
