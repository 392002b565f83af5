#include "components/mpm/solid/explicit/tasks/share_volume.hpp"

#include <Eigen/LU>

#include <cmath>

namespace tushar::mpm::solid {

template <int D>
void shareVolume(double dt, const data::ParticleRange& range, const StateUpdate<D>& u, Matrix3* velocityGradient) {
  const auto bears = [&](int p) { return (!u.localized || !(*u.localized)[p]) && u.deformation[p].determinant() > 0; };
  double start = 0, now = 0;
  for (const int p : range) {
    if (!bears(p)) continue;
    start += u.mass[p];
    now += u.mass[p] * u.deformation[p].determinant();
  }
  for (const int p : range) {
    if (!bears(p)) continue;
    const double cubed = now / start / u.deformation[p].determinant();
    const double stretch = std::cbrt(cubed);
    Matrix3& gradient = velocityGradient[p - range.first];
    u.deformation[p] *= stretch;
    gradient.diagonal().array() += std::log(stretch) / dt;
    if (u.volume) (*u.volume)[p] *= cubed;
    if (u.velocityGradient) (*u.velocityGradient)[p] = gradient;
  }
}

template void shareVolume(double, const data::ParticleRange&, const StateUpdate<1>&, Matrix3*);
template void shareVolume(double, const data::ParticleRange&, const StateUpdate<2>&, Matrix3*);
template void shareVolume(double, const data::ParticleRange&, const StateUpdate<3>&, Matrix3*);

}  // namespace tushar::mpm::solid
