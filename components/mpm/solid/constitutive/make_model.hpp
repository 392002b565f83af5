#pragma once

#include <memory>
#include <tuple>

#include "components/mpm/solid/constitutive/all.hpp"
#include "components/mpm/solid/material.hpp"

// Models in the form that particles use, compiled for speed in one file; the code that reads their constants is
// separate.

namespace tushar::mpm::solid {

/// Whether a model supports thermal expansion: as in Uintah, only neo-Hookean ones do.
template <class M>
inline constexpr bool expands =
    std::is_same_v<M, CompNeoHook> || std::is_same_v<M, Ucnh> || std::is_same_v<M, CompNeoHookPlastic>;

/// Makes a Model of an M for the particles of a material.
template <class M>
using MakeModel = std::shared_ptr<const Model> (*)(const M& model, const Material& material);
template <class Models>
struct MakersOf;
template <class... Ms>
struct MakersOf<std::tuple<Ms...>> {
  using type = std::tuple<MakeModel<Ms>...>;
};
/// The functions that make each of AllModels.
const MakersOf<AllModels>::type& modelMakers();

/// The model of a material for use by its particles.
template <class M>
std::shared_ptr<const Model> makeModel(const M& model, const Material& material) {
  return std::get<MakeModel<M>>(modelMakers())(model, material);
}

}  // namespace tushar::mpm::solid
