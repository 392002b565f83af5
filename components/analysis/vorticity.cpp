#include "components/analysis/vorticity.hpp"

#include <optional>

#include "components/analysis/gas_fields.hpp"
#include "core/input/schema.hpp"
#include "core/simulation/module_with_tags.hpp"

namespace tushar::analysis {

using input::Element;
using simulation::Analysis;
using simulation::AnalysisKind;

namespace {

constexpr std::string_view gasVelocityName = "c.velocity";

struct VorticitySettings {
  std::string name, material;
};

const input::Schema<VorticitySettings>& vorticitySchema() {
  static const input::Schema<VorticitySettings> schema =
      input::Schema<VorticitySettings>("Module",
                                       "The vorticity of the gas, as a variable c.vorticity that can be saved.")
          .requiredAttribute("name", &VorticitySettings::name, "1", "vorticity")
          .value("material", &VorticitySettings::material, "", "1", "name of the gas");
  return schema;
}

template <int D>
class Vorticity : public Analysis {
 public:
  explicit Vorticity(bool derived) : derived_(derived) {}

  void schedule(TaskList& tasks) const override {
    if (derived_)
      tasks.perPatch("vorticity::compute", computeVorticity<D>, requiresNew(velocity_, 1), computes(vorticityLabel));
    else
      tasks.perPatch("vorticity::compute", computeVorticity<D>, requiresOld(velocity_, 1), computes(vorticityLabel));
  }
  void setTime(double, double) override {}
  simulation::OtherNames otherNames() const override { return {{"vorticity", std::string(vorticityLabel.name)}}; }

 private:
  bool derived_;
  CellLabel<Vec<D>> velocity_{gasVelocityName, "m/s", "velocity"};
};

}  // namespace

template <int D>
void computeVorticity(const Patch& patch, CellView<const Vec<D>> velocity, CellView<Vec3> vorticity) {
  const Level& level = patch.level();
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    Eigen::Matrix3d slope = Eigen::Matrix3d::Zero();  // slope(i, j) = dv_i / dx_j
    for (int d = 0; d < D; ++d) {
      Index<D> above = cell, below = cell;
      ++above[d];
      --below[d];
      if (!velocity.box().contains(above)) above = cell;
      if (!velocity.box().contains(below)) below = cell;
      if (above[d] == below[d]) continue;  // one cell
      const Vec<D> difference = velocity[above] - velocity[below];
      slope.col(level.axis(d)) = level.expandDirection<D>(difference) / ((above[d] - below[d]) * level.spacing(d));
    }
    vorticity[cell] = Vec3(slope(2, 1) - slope(1, 2), slope(0, 2) - slope(2, 0), slope(1, 0) - slope(0, 1));
  });
}

template void computeVorticity<1>(const Patch&, CellView<const Vec<1>>, CellView<Vec3>);
template void computeVorticity<2>(const Patch&, CellView<const Vec<2>>, CellView<Vec3>);
template void computeVorticity<3>(const Patch&, CellView<const Vec<3>>, CellView<Vec3>);

AnalysisKind vorticityKind() {
  return simulation::moduleMadeBy(
      "vorticity", "the vorticity of the gas, as a cell variable", vorticitySchema(),
      [](const VorticitySettings& settings, const Element& module, const Component& component, const Level& level) {
        const std::optional<bool> derived = isDerived(component, gasVelocityName);
        if (!derived)
          throw InputError({{module.where(), "DataAnalysis/Module",
                             "this component has no velocity of a gas in cells; remove the module"}});
        checkGas(settings.material, component, module);
        return simulation::analysisByDimension<Vorticity>(level, *derived);
      });
}

}  // namespace tushar::analysis
