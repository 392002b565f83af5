#pragma once

#include "components/euler/children.hpp"
#include "components/euler/tasks/advance_mixture.hpp"

namespace tushar::euler {

/// The interpolation between levels of several gases that share cells, so that uniform pressure and velocity remain
/// uniform. It is linear in the volume fractions z_k, masses m_k, momentum M and energy E. Their slopes s are, with the
/// values of the cell itself for rho_k = m_k / z_k, v and p, and limited slopes L of what remains,
///
///     s(z_k) = f mean difference, where f is the least limiter of all fractions, so that their sum remains 1,
///     s(m_k) = rho_k s(z_k) + L(m_k - rho_k z_k),   s(rho) = sum of s(m_k),
///     s(M) = v s(rho) + L(M - v rho),
///     s(E) = p s(G) + s(S) + v² s(rho) / 2 + L(E - p G - S - v² rho / 2).
///
/// Gases with laws of their own have no such G and S: there f is the least limiter of the fractions, the masses and the
/// internal energy, which all get the slope f mean difference; at one pressure and temperature, the internal energy is
/// linear in the masses. Slopes are reduced until no mass or fraction is below 0; if a state would be impossible, they
/// are 0.
template <int D>
class MixtureInterpolation : public data::JointInterpolation {
 public:
  /// The gases must outlive the object.
  explicit MixtureInterpolation(const std::vector<Settings>& gases) : gases_(&gases) {}

  std::vector<data::VariableName> variables() const override;
  void correct(const Box& parents, const std::vector<data::CellValues>& coarse,
               const std::vector<data::CellValues>& fine) const override;

 private:
  /// A quarter of the slopes of all variables of a cell along an axis, or the state of a cell.
  struct Numbers {
    double density = 0, energy = 0;
    Vec<D> momentum = Vec<D>::Zero();
    std::array<double, kMostGases> mass{}, share{};
  };
  using Slopes = std::array<Numbers, D>;

  Numbers numbersOf(const std::vector<data::CellValues>& values, const Index3& cell) const;
  Numbers slopesOf(const Numbers& below, const Numbers& middle, const Numbers& above) const;
  /// The slopes of volume fractions and masses, and the slope of the internal energy at the velocity of the cell.
  double slopesOfGases(const Numbers& below, const Numbers& middle, const Numbers& above, Numbers& slopes) const;
  double slopesOfBlend(const Numbers& below, const Numbers& middle, const Numbers& above, Numbers& slopes) const;
  double partThatIsPossible(const Numbers& middle, const Slopes& quarters) const;
  Numbers child(const Numbers& middle, const Slopes& quarters, double part, int k) const;
  bool canBe(const Numbers& cell) const;

  const std::vector<Settings>* gases_;
};

extern template class MixtureInterpolation<1>;
extern template class MixtureInterpolation<2>;
extern template class MixtureInterpolation<3>;

}  // namespace tushar::euler
