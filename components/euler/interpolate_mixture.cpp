#include "components/euler/interpolate_mixture.hpp"

#include <algorithm>

namespace tushar::euler {

namespace {

/// Indices of the variables of a mixture; those of gas k follow.
enum { ofDensity, ofMomentum, ofEnergy, ofGases };
std::size_t placeOfMass(std::size_t gas) { return ofGases + 2 * gas; }
std::size_t placeOfShare(std::size_t gas) { return placeOfMass(gas) + 1; }

Differences differencesOf(double below, double middle, double above) { return {middle - below, above - middle}; }

}  // namespace

template <int D>
std::vector<data::VariableName> MixtureInterpolation<D>::variables() const {
  std::vector<data::VariableName> names{{&c::density, -1}, {&c::momentum<D>, -1}, {&c::totalEnergy, -1}};
  for (int k = 0; k < static_cast<int>(gases_->size()); ++k) {
    names.push_back({&c::gasMass, k});
    names.push_back({&c::gasShare, k});
  }
  return names;
}

template <int D>
void MixtureInterpolation<D>::correct(const Box& parents, const std::vector<data::CellValues>& coarse,
                                      const std::vector<data::CellValues>& fine) const {
  grid::forEach<3>(parents, [&](const Index3& parent) {
    const Numbers middle = numbersOf(coarse, parent);
    Slopes quarters;
    for (int d = 0; d < D; ++d) {
      if (!hasNeighbours(coarse[ofDensity], parent, d)) continue;
      Index3 lower = parent, upper = parent;
      --lower[d], ++upper[d];
      quarters[d] = slopesOf(numbersOf(coarse, lower), middle, numbersOf(coarse, upper));
    }
    const double part = partThatIsPossible(middle, quarters);
    for (int k = 0; k < ChildCells<D>::count; ++k) {
      const Index3 cell = ChildCells<D>::at(parent, k);
      const Numbers values = child(middle, quarters, part, k);
      valueIn<double>(fine[ofDensity], cell) = values.density;
      valueIn<Vec<D>>(fine[ofMomentum], cell) = values.momentum;
      valueIn<double>(fine[ofEnergy], cell) = values.energy;
      for (std::size_t gas = 0; gas < gases_->size(); ++gas) {
        valueIn<double>(fine[placeOfMass(gas)], cell) = values.mass[gas];
        valueIn<double>(fine[placeOfShare(gas)], cell) = values.share[gas];
      }
    }
  });
}

template <int D>
auto MixtureInterpolation<D>::numbersOf(const std::vector<data::CellValues>& values, const Index3& cell) const
    -> Numbers {
  Numbers numbers;
  numbers.density = valueIn<double>(values[ofDensity], cell);
  numbers.momentum = valueIn<Vec<D>>(values[ofMomentum], cell);
  numbers.energy = valueIn<double>(values[ofEnergy], cell);
  for (std::size_t gas = 0; gas < gases_->size(); ++gas) {
    numbers.mass[gas] = valueIn<double>(values[placeOfMass(gas)], cell);
    numbers.share[gas] = valueIn<double>(values[placeOfShare(gas)], cell);
  }
  return numbers;
}

template <int D>
double MixtureInterpolation<D>::slopesOfGases(const Numbers& below, const Numbers& middle, const Numbers& above,
                                              Numbers& slopes) const {
  MixedGas law, ofLaw;
  Differences ofSoftness, ofStiffness;
  double factor = 1;
  const auto shares = [&](std::size_t k) { return differencesOf(below.share[k], middle.share[k], above.share[k]); };
  for (std::size_t k = 0; k < gases_->size(); ++k) factor = std::min(factor, shares(k).factor(1));
  for (std::size_t k = 0; k < gases_->size(); ++k) {
    const Gas& gas = (*gases_)[k].gas;
    slopes.share[k] = factor * shares(k).mean();
    MixedGas pure;
    pure.add(1, gas.gamma, gas.pInfinity);
    law.add(middle.share[k], gas.gamma, gas.pInfinity);
    ofLaw.add(slopes.share[k], gas.gamma, gas.pInfinity);
    ofSoftness += pure.softness * shares(k);
    ofStiffness += pure.stiffness * shares(k);
    const double own = middle.share[k] > 0 ? middle.mass[k] / middle.share[k] : 0;
    slopes.mass[k] =
        own * slopes.share[k] + (differencesOf(below.mass[k], middle.mass[k], above.mass[k]) - own * shares(k)).slope();
  }
  const double squared = middle.momentum.squaredNorm() / (middle.density * middle.density);
  const double p = law.pressure(middle.density, middle.energy - 0.5 * squared * middle.density);
  const Differences rest = differencesOf(below.energy, middle.energy, above.energy) - p * ofSoftness - ofStiffness -
                           0.5 * squared * differencesOf(below.density, middle.density, above.density);
  return p * ofLaw.softness + ofLaw.stiffness + rest.slope();
}

template <int D>
double MixtureInterpolation<D>::slopesOfBlend(const Numbers& below, const Numbers& middle, const Numbers& above,
                                              Numbers& slopes) const {
  const double squared = middle.momentum.squaredNorm() / (middle.density * middle.density);
  const Differences inner = differencesOf(below.energy, middle.energy, above.energy) -
                            0.5 * squared * differencesOf(below.density, middle.density, above.density);
  const auto shares = [&](std::size_t k) { return differencesOf(below.share[k], middle.share[k], above.share[k]); };
  const auto masses = [&](std::size_t k) { return differencesOf(below.mass[k], middle.mass[k], above.mass[k]); };
  double factor = inner.factor(100 * std::abs(middle.energy));
  for (std::size_t k = 0; k < gases_->size(); ++k)
    factor = std::min({factor, shares(k).factor(100), masses(k).factor(100 * middle.density)});
  for (std::size_t k = 0; k < gases_->size(); ++k) {
    slopes.share[k] = factor * shares(k).mean();
    slopes.mass[k] = factor * masses(k).mean();
  }
  return factor * inner.mean();
}

template <int D>
auto MixtureInterpolation<D>::slopesOf(const Numbers& below, const Numbers& middle, const Numbers& above) const
    -> Numbers {
  Numbers slopes;
  const bool areBlended = gases_->front().blend != nullptr;
  const double inner =
      areBlended ? slopesOfBlend(below, middle, above, slopes) : slopesOfGases(below, middle, above, slopes);
  for (std::size_t k = 0; k < gases_->size(); ++k) slopes.density += slopes.mass[k];
  const Differences densities = differencesOf(below.density, middle.density, above.density);
  const Vec<D> v = middle.momentum / middle.density;
  for (int d = 0; d < D; ++d) {
    const Differences own = differencesOf(below.momentum[d], middle.momentum[d], above.momentum[d]);
    slopes.momentum[d] = v[d] * slopes.density + (own - v[d] * densities).slope();
  }
  slopes.energy = inner + 0.5 * v.squaredNorm() * slopes.density;
  slopes.density *= 0.25;
  slopes.energy *= 0.25;
  slopes.momentum *= 0.25;
  for (std::size_t k = 0; k < gases_->size(); ++k) slopes.mass[k] *= 0.25, slopes.share[k] *= 0.25;
  return slopes;
}

/// The part of all slopes with which masses and fractions are not below 0; 0 if a child would be impossible with it.
template <int D>
double MixtureInterpolation<D>::partThatIsPossible(const Numbers& middle, const Slopes& quarters) const {
  constexpr double withRoundOff = 1 - 1e-12;
  double part = 1;
  for (std::size_t k = 0; k < gases_->size(); ++k) {
    double mass = 0, share = 0;
    for (const Numbers& one : quarters) mass += std::abs(one.mass[k]), share += std::abs(one.share[k]);
    if (mass > middle.mass[k]) part = std::min(part, withRoundOff * std::max(middle.mass[k], 0.0) / mass);
    if (share > middle.share[k]) part = std::min(part, withRoundOff * std::max(middle.share[k], 0.0) / share);
  }
  for (int k = 0; k < ChildCells<D>::count; ++k)
    if (!canBe(child(middle, quarters, part, k))) return 0;
  return part;
}

template <int D>
auto MixtureInterpolation<D>::child(const Numbers& middle, const Slopes& quarters, double part, int k) const
    -> Numbers {
  const auto changed = [&](double value, auto&& slope) {
    std::array<double, D> along;
    for (int d = 0; d < D; ++d) along[d] = slope(quarters[d]);
    return value + part * ChildCells<D>::change(along, k);
  };
  Numbers child;
  child.density = changed(middle.density, [](const Numbers& one) { return one.density; });
  child.energy = changed(middle.energy, [](const Numbers& one) { return one.energy; });
  for (int d = 0; d < D; ++d)
    child.momentum[d] = changed(middle.momentum[d], [d](const Numbers& one) { return one.momentum[d]; });
  for (std::size_t gas = 0; gas < gases_->size(); ++gas) {
    child.mass[gas] = changed(middle.mass[gas], [gas](const Numbers& one) { return one.mass[gas]; });
    child.share[gas] = changed(middle.share[gas], [gas](const Numbers& one) { return one.share[gas]; });
  }
  return child;
}

template <int D>
bool MixtureInterpolation<D>::canBe(const Numbers& cell) const {
  if (const BlendLaws* laws = gases_->front().blend.get()) {
    const double inner = cell.energy - 0.5 * cell.momentum.squaredNorm() / cell.density;
    return cell.density > 0 && laws->at(cell.mass.data(), inner, cell.share.data()).isPossible;
  }
  MixedGas law;
  for (std::size_t k = 0; k < gases_->size(); ++k)
    law.add(cell.share[k], (*gases_)[k].gas.gamma, (*gases_)[k].gas.pInfinity);
  return euler::canBe<D>(law.alike(), &cell.density, cell.momentum.data(), &cell.energy, 1);
}

template class MixtureInterpolation<1>;
template class MixtureInterpolation<2>;
template class MixtureInterpolation<3>;

}  // namespace tushar::euler
