#include "components/mpm/solid/constitutive/make_model.hpp"

#include "components/mpm/solid/constitutive/expanding.hpp"
#include "components/mpm/solid/constitutive/gurson.hpp"

namespace tushar::mpm::solid {

namespace {

/// Constructs a model, with thermal expansion if the material has any; `bulkModulus` is that of the model [Pa].
template <class M>
std::shared_ptr<const Model> expandingIfAsked(const M& model, double bulkModulus, const Material& material) {
  if (material.thermalExpansion > 0)
    return std::make_shared<Expanding<M>>(model, bulkModulus,
                                          ThermalExpansion{material.thermalExpansion, material.roomTemperature});
  return std::make_shared<ModelOf<M>>(model);
}

/// Constructs the model of a material, for use by its particles.
template <class M>
std::shared_ptr<const Model> modelFrom(const M& model, const Material& material) {
  if constexpr (requires { model.yieldSpreads; })
    if (model.isPlastic && model.yieldSpreads && model.yieldStress && model.hardeningModulus)
      return expandingIfAsked(UcnhVar::spread(model), model.bulkModulus, material);
  if constexpr (std::is_same_v<M, ElasticPlasticHp>)
    if (std::holds_alternative<GursonYield>(model.yieldCondition))
      return std::make_shared<ModelOf<GursonPlastic>>(GursonPlastic{model});
  if constexpr (std::is_same_v<M, ViscoScram>)
    if (model.thermalExpansion > 0) return std::make_shared<ModelOf<ExpandingViscoScram>>(ExpandingViscoScram{model});
  if constexpr (expands<M>)
    return expandingIfAsked(model, model.bulkModulus, material);
  else
    return std::make_shared<ModelOf<M>>(model);
}

template <class... Ms>
MakersOf<AllModels>::type makersOf(const std::tuple<Ms...>&) {
  return {modelFrom<Ms>...};
}

}  // namespace

const MakersOf<AllModels>::type& modelMakers() {
  static const MakersOf<AllModels>::type makers = makersOf(AllModels{});
  return makers;
}

}  // namespace tushar::mpm::solid
