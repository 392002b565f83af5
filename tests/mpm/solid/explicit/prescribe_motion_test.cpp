#include "components/mpm/solid/explicit/tasks/prescribe_motion.hpp"

#include <gtest/gtest.h>

#include "components/mpm/shapes/linear.hpp"
#include "components/mpm/shapes/tensor_shape.hpp"
#include "tests/support/particles.hpp"

// The motion of nodes that a deformation prescribes, on plain fields.

namespace tushar::mpm::solid {
namespace {

/// Eight cells around the origin, with one particle in the last.
struct OneParticle : test::Particles {
  static grid::Domain domain() {
    grid::Domain domain;
    domain.lower = {-1, -1, -1};
    domain.upper = {1, 1, 1};
    domain.resolution = {{2, 2, 2}};
    return domain;
  }
  OneParticle() : Particles(domain()) {
    set.reset(patch(), 1);
    set.at(Index3{{1, 1, 1}}) = {0, 1};
    set.setOwned(1);
  }

  Material material;
  std::vector<Vec<3>> x{{0.5, 0.25, 0.75}};
};

TEST(PrescribeMotion, MovesTheNodesThatParticlesTouchWithTheDeformation) {
  OneParticle one;
  Matrix3 end = Matrix3::Identity();
  end(0, 1) = 0.4;
  end(2, 2) = 0.5;
  const PrescribedDeformation deformation(
      {{0, Matrix3::Identity(), 0, Vec3::UnitX()}, {2, end, 30, Vec3(0.6, 0, 0.8)}});
  std::vector<NodeRecord> records(one.level.nodes().size());
  const NodeView<NodeRecord> nodes{records.data(), one.level.nodes()};
  forEach<3>(one.level.nodes(), [&](const Index3& node) {
    for (int k = 0; k < 8; ++k) nodes[node][k] = 7;
  });
  prescribeMotion<3>(one.patch(), one.material, &deformation, LinearShape<3>::ghostNodes, 0.5, one.read(one.x), nodes);
  const Matrix3 gradient = deformation.velocityGradient(0.5);
  forEach<3>(one.level.nodes(), [&](const Index3& node) {
    const bool isTouched = node[0] > 0 && node[1] > 0 && node[2] > 0;
    const Vec3 place(node[0] - 1, node[1] - 1, node[2] - 1);
    const Vec3 velocity = isTouched ? Vec3(gradient * place) : Vec3(7, 7, 7);
    EXPECT_TRUE(lanes<3>(nodes[node], lane::velocity).isApprox(velocity, 1e-14));
    EXPECT_EQ(lanes<3>(nodes[node], lane::before), lanes<3>(nodes[node], lane::velocity)) << "no acceleration";
    EXPECT_EQ(nodes[node][lane::mass], 7);
  });
}

}  // namespace
}  // namespace tushar::mpm::solid
