#include "components/mpmice/tasks/advance_gas.hpp"

namespace tushar::mpmice {

namespace {

template <int D, int K>
AdvanceGas<D> chooseOf(const euler::Method& method) {
  if (method.reconstruction == euler::Reconstruction::firstOrder) return advanceGas<D, euler::Hllc, euler::Constant, K>;
  return advanceGas<D, euler::Hllc, euler::Sloped<VanLeer>, K>;
}

}  // namespace

template <int D>
AdvanceGas<D> chooseAdvanceGases(const euler::Method& method, std::size_t gases) {
  return gases == 2 ? chooseOf<D, 2>(method) : chooseOf<D, 3>(method);
}

template AdvanceGas<1> chooseAdvanceGases<1>(const euler::Method&, std::size_t);
template AdvanceGas<2> chooseAdvanceGases<2>(const euler::Method&, std::size_t);
template AdvanceGas<3> chooseAdvanceGases<3>(const euler::Method&, std::size_t);

}  // namespace tushar::mpmice
