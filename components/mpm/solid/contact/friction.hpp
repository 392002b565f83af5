#pragma once

#include "components/mpm/solid/constitutive_model.hpp"
#include "components/mpm/solid/contact/contact.hpp"

namespace tushar::mpm::solid {

/// What a body's surface looks like from a node.
template <int D>
struct BodySurface {
  Vec<D> massGradient;  ///< sum_p m_p grad S_i: points into the body, kg/m
  Vec<D> position;      ///< sum_p S_i m_p x_p, kg m
  Matrix3 stress;       ///< sum_p S_i V_p sigma_p, Pa m^3
};

/// A node at which a body touches others.
template <int D>
struct Touch {
  Vec<D> normal;      ///< out of the body
  Vec<D> velocity;    ///< of the body less that of the centre of mass of all, m/s
  bool isPressed;     ///< the stress presses on the surface
};

/// The change of a body's velocity at a node, m/s, where it is pressed against others or approaches them: it does not
/// pass through, and slides by what friction with the coefficient mu leaves; Bardenhagen, Guilkey, Roessig, Brackbill,
/// Witzel & Foster, CMES 2 (2001) 509.
template <int D>
Vec<D> frictionChange(const Touch<D>& touch, double mu) {
  const double approach = touch.velocity.dot(touch.normal);
  if (!touch.isPressed && approach <= 0) return Vec<D>::Zero();
  const Vec<D> slip = touch.velocity - approach * touch.normal;
  const double speed = slip.norm();
  const double share = speed > 0 ? std::min(mu * std::abs(approach) / speed, 1.0) : 0.0;
  return -approach * touch.normal - share * slip;
}

/// The surfaces of all materials, by material.
template <int D>
struct Surfaces {
  const std::vector<NodeView<const Vec<D>>>&massGradient, &position;
  const std::vector<NodeView<const Matrix3>>& stress;

  BodySurface<D> at(std::size_t material, const Index<D>& node) const {
    return {massGradient[material][node], position[material][node], stress[material][node]};
  }
};

/// Applies frictionChange to all materials that take part. A change that would strain a cell by more than a half is cut
/// down to that.
template <int D>
void rub(const Patch& patch, const Contact& contact, double dt, const Records& records, const Surfaces<D>& surfaces);

}  // namespace tushar::mpm::solid
