#include <gtest/gtest.h>

#include "components/mpm/solid/explicit/tasks/deform_particles.hpp"
#include "tests/mpm/solid/explicit/bare_update.hpp"

// How far a step may deform a particle.

namespace tushar::mpm::solid {
namespace {

constexpr double dt = 0.5;

/// A particle whose F is updated by a step of length dt.
struct Deformed {
  Grid grid{domain()};
  data::ParticleSet set;
  std::vector<Matrix3> before{Matrix3::Identity()}, now = before;
  Method method;

  static grid::Domain domain() {
    grid::Domain domain;
    domain.upper = {1, 1, 0};
    domain.resolution = {{1, 1, 0}};
    return domain;
  }
  /// Updates F with L = `gradient`; returns whether the particle is lost.
  bool deform(Matrix3 gradient) {
    set.reset(grid.patches().front(), 0);
    set.setOwned(1);
    StateUpdate<2> update = bareUpdate(set, grid.level());
    update.oldDeformation = {before.data(), set, grid.level().cells()};
    update.deformation = {now.data(), set, grid.level().cells()};
    return deformParticles<2>(method, dt, update, 0, 1, &gradient);
  }
};

/// L of a stretch along x with the norm |L| dt.
Matrix3 stretch(double norm) {
  Matrix3 gradient = Matrix3::Zero();
  gradient(0, 0) = norm / dt;
  return gradient;
}

TEST(DeformParticles, KeepsWhatNodesThatMoveByACellCanDo) {
  Deformed one;
  Matrix3 all = Matrix3::Constant(2 / dt);  // each component at its bound: the norm is 6
  EXPECT_FALSE(one.deform(all));
  EXPECT_TRUE(one.now[0].allFinite());

  EXPECT_FALSE(one.deform(stretch(5.9)));
  EXPECT_GT(one.now[0](0, 0), 100);
  EXPECT_FALSE(one.deform(stretch(-5.9)));
  EXPECT_GT(one.now[0].determinant(), 0) << "substeps do not invert it";
}

TEST(DeformParticles, LosesWhatIsDeformedMore) {
  Deformed one;
  for (const double norm : {6.1, -6.1, 1e3, 1e200}) {
    EXPECT_TRUE(one.deform(stretch(norm)));
    EXPECT_EQ(one.now[0], -Matrix3::Identity()) << "counts as inverted";
  }
  one.method.minimumSubcyclesForF = -2;
  EXPECT_TRUE(one.deform(stretch(7)));
}

TEST(DeformParticles, LosesWhatVanishes) {
  Deformed one;
  one.before[0](0, 0) = 1e-11;
  EXPECT_FALSE(one.deform(stretch(-1.1)));
  EXPECT_GT(one.now[0].determinant(), 0);
  EXPECT_TRUE(one.deform(stretch(-5)));
  EXPECT_EQ(one.now[0], -Matrix3::Identity());
}

TEST(DeformParticles, LeavesWhatIsNotANumberToThoseWhoReportIt) {
  Deformed one;
  EXPECT_FALSE(one.deform(stretch(std::nan(""))));
  EXPECT_FALSE(one.now[0].allFinite());
}

TEST(ForgetDistortion, KeepsTheVolumeOfWhatIsShearedWithoutLimit) {
  Matrix3 sheared = Matrix3::Identity() * 2;
  sheared(0, 1) = 1500;
  Matrix3 less = sheared;
  less(0, 1) = 900;
  const Matrix3 before = less;
  forgetDistortion(less);
  EXPECT_EQ(less, before) << "its determinant has all its digits";
  sheared(0, 1) = 2100;
  forgetDistortion(sheared);
  EXPECT_LT((sheared - 2 * Matrix3::Identity()).norm(), 1e-14) << "to round-off";
}

TEST(DeformParticles, FollowsAPrescribedDeformationHoweverLarge) {
  Deformed one;
  one.method.limitsDeformation = false;
  EXPECT_FALSE(one.deform(stretch(8)));
  EXPECT_NEAR(one.now[0](0, 0), std::pow(1.5, 16), 1e-9) << "(1 + L dt/n)^n with n = 2 |L| dt substeps, to round-off";
}

}  // namespace
}  // namespace tushar::mpm::solid
