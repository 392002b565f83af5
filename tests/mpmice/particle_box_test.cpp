#include "components/mpmice/particle_box.hpp"

#include "tests/mpmice/fields.hpp"

namespace tushar::mpmice {

namespace {

using mpm::solid::Matrix3;

/// A plane of cells with widths 1/8 and 1/`down`.
grid::Domain plane(int down) {
  grid::Domain domain = euler::closedBox(2, 8);
  domain.resolution[1] = down;
  return domain;
}

Matrix3 turnedBy(double angle) {
  Matrix3 turn = Matrix3::Identity();
  turn(0, 0) = turn(1, 1) = std::cos(angle);
  turn(1, 0) = std::sin(angle);
  turn(0, 1) = -turn(1, 0);
  return turn;
}

Vec<2> edgesAfter(const Matrix3& deformation, const Vec<2>& size, int down = 8) {
  const Level level(plane(down));
  return edgesOf<2>(level, size, deformation);
}

ParticleBox<1> stretch(double middle, double edge) { return {Vec<1>(middle), Vec<1>(edge)}; }
double aboveFace(const ParticleBox<1>& box, double face) { return box.lengthsAbove(0, face + Quad{})[0]; }
double hatAt(const ParticleBox<1>& box, double face) { return box.hatsAt(0, face + Quad{})[0]; }

}  // namespace

TEST(ParticleBox, IsCutByFacesIntoPartsThatAddUp) {
  for (const ParticleBox<1>& box : {stretch(0.3, 0.25), stretch(0.9, 1.5), stretch(-0.4, 0.8), stretch(1, 0.5)}) {
    double inside = 0;
    for (int k = -3; k < 4; ++k) {
      inside += box.lengthIn(0, k);
      EXPECT_NEAR(aboveFace(box, k) - aboveFace(box, k + 1), box.lengthIn(0, k), 4e-15);
    }
    EXPECT_NEAR(inside, box.edges[0], 4e-15);
  }
}

TEST(ParticleBox, CoversAFaceWhollyTogetherWithItsNeighboursAndByHalfAtASurface) {
  for (const double length : {0.25, 0.3, 1.0, 1.5}) {
    double within = 0, atEnd = 0;
    for (int i = -10; i < 10; ++i) within += hatAt(stretch(0.123 + i * length, length), 1);
    for (int i = 0; i < 10; ++i) atEnd += hatAt(stretch(1 - (i + 0.5) * length, length), 1);
    EXPECT_NEAR(within, 1, 1e-14);
    EXPECT_NEAR(atEnd, 0.5, 1e-14);
  }
}

TEST(ParticleBox, ReachesWhereverItHasAPartOrAWeight) {
  for (double middle = 0; middle < 1; middle += 0.07)
    for (const double edge : {0.1, 0.5, 1.0, 1.5}) {
      const ParticleBox<1> box = stretch(middle, edge);
      const Box reach = box.reach();
      for (int k = -5; k < 7; ++k) {
        if (k >= reach.lower[0] && k < reach.upper[0]) continue;
        EXPECT_EQ(box.lengthIn(0, k), 0) << middle << " " << edge << " " << k;
        EXPECT_EQ(hatAt(box, k), 0) << middle << " " << edge << " " << k;
      }
    }
}

TEST(EdgesOf, FollowAStretchAlongTheAxes) {
  Matrix3 stretched = Matrix3::Identity();
  stretched(0, 0) = 2;
  stretched(1, 1) = 0.5;
  EXPECT_EQ(edgesAfter(stretched, {0.25, 0.25}), Vec<2>(0.5, 0.125));
  EXPECT_EQ(edgesAfter(stretched, {0.25, 0.25}, 16), Vec<2>(0.5, 0.125));
}

TEST(EdgesOf, ChangePlacesInAQuarterTurn) {
  EXPECT_NEAR((edgesAfter(turnedBy(std::acos(0.0)), {0.5, 0.25}) - Vec<2>(0.25, 0.5)).norm(), 0, 1e-15);
  // Cells of half the width along y: 0.25 of them are 0.125 of those along x.
  EXPECT_NEAR((edgesAfter(turnedBy(std::acos(0.0)), {0.5, 0.25}, 16) - Vec<2>(0.125, 1)).norm(), 0, 1e-15);
}

TEST(EdgesOf, KeepTheVolumeOfWhatTurnsAndShears) {
  Matrix3 sheared = Matrix3::Identity();
  for (const double shear : {0.1, 1.0, 2.0}) {
    sheared(0, 1) = shear;
    EXPECT_NEAR(edgesAfter(sheared, {0.25, 0.25}).prod(), 0.0625, 1e-15) << shear;
  }
  for (const double angle : {0.1, 0.5, 0.7854, 2.0}) {
    EXPECT_NEAR(edgesAfter(turnedBy(angle), {0.25, 0.25}).prod(), 0.0625, 1e-15) << angle;
    EXPECT_NEAR(edgesAfter(turnedBy(angle), {0.5, 0.25}, 16).prod(), 0.125, 1e-15) << angle;
  }
  Matrix3 both = turnedBy(0.4);
  both.col(0) *= 1.5;
  EXPECT_NEAR(edgesAfter(both, {0.25, 0.25}).prod(), 1.5 * 0.0625, 1e-15);
}

TEST(EdgesOf, AreThoseOfASquareWhateverItsAngle) {
  for (const double angle : {0.3, 0.7854, 1.2})
    EXPECT_NEAR((edgesAfter(turnedBy(angle), {0.25, 0.25}) - Vec<2>(0.25, 0.25)).norm(), 0, 1e-15);
}

TEST(EdgesOf, EndAtTheLongestThatPatchesCanSee) {
  Matrix3 stretched = Matrix3::Identity();
  stretched(0, 0) = 100;
  EXPECT_EQ(edgesAfter(stretched, {0.25, 0.25}), Vec<2>(longestEdge, 0.25));
}

}  // namespace tushar::mpmice
