#include "components/mpm/solid/constitutive/trans_iso_hyper.hpp"

#include <gtest/gtest.h>

#include "tests/mpm/solid/constitutive/example_models.hpp"
#include "tests/mpm/solid/constitutive/material_point.hpp"

namespace tushar::mpm::solid::testing {
namespace {

constexpr double roundOff = 1e-12;

TEST(TransIsoHyper, HoldsByItsFibresWhereTheyArePulled) {
  TransIsoHyper model = ligament<>();
  model.fibre = {0, 1, 0};
  model.straight = 1.2;
  const MaterialPoint<TransIsoHyper> point{model};
  const double l = 1.1, side = 1 / std::sqrt(l);  // no change of volume
  const Matrix3 pulled = Vec3(side, l, side).asDiagonal();
  model.c3 = model.c5 = 0;
  const MaterialPoint<TransIsoHyper> bare{model};

  const Matrix3 byFibres = point.stress(pulled) - bare.stress(pulled);

  EXPECT_NEAR(byFibres(1, 1) - byFibres(0, 0), 0.4 * (std::exp(3 * 0.1) - 1), roundOff);
  EXPECT_NEAR(point.state(pulled).stretch, l, roundOff);
  EXPECT_EQ((point.stress(pulled.inverse()) - bare.stress(pulled.inverse())).norm(), 0);
}

TEST(TransIsoHyper, KeepsTheStressOfThePartsThatHaveNotFailed) {
  TransIsoHyper model = ligament<>();
  model.fibre = {0, 1, 0};
  const MaterialPoint<TransIsoHyper> lasting{model};
  model.c3 = model.c5 = 0;
  const MaterialPoint<TransIsoHyper> bare{model};  // without fibres
  model = lasting.model;
  model.failureOption = 1;
  model.mostFibreStretch = 1.2;
  model.mostShear = 0.5;
  MaterialPoint<TransIsoHyper> point{model};
  const Matrix3 low = Vec3(1, 1.15, 1).asDiagonal(), pulled = Vec3(1.1, 1.25, 1).asDiagonal();
  const Matrix3 sheared = Vec3(1, 1.5, 1).asDiagonal();

  EXPECT_EQ((point.stress(low) - lasting.stress(low)).norm(), 0);
  EXPECT_EQ(point.state(low).failure, 0);
  EXPECT_EQ(point.state(pulled).failure, 2) << "(1.25² - 1)/2 = .28 is less than .5";
  EXPECT_LT((point.stress(pulled) - bare.stress(pulled)).norm(), roundOff);

  point.advance(pulled);
  EXPECT_EQ(point.state(low).failure, 2) << "fibres do not heal";
  EXPECT_LT((point.stress(low) - bare.stress(low)).norm(), roundOff);
  point.advance(sheared);
  EXPECT_EQ(point.state(low).failure, 3);
  EXPECT_EQ(point.stress(low).norm(), 0);
  EXPECT_EQ(point.energy(low), 0);

  model.mostFibreStretch = 10;
  const MaterialPoint<TransIsoHyper> ofFibres{model};
  EXPECT_EQ(ofFibres.state(sheared).failure, 1);
  EXPECT_LT((ofFibres.stress(sheared) - deviator(lasting.stress(sheared) - bare.stress(sheared))).norm(), roundOff);
}

}  // namespace
}  // namespace tushar::mpm::solid::testing
