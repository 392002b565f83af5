#include "components/analysis/control_vol_fluxes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>

#include "components/analysis/extents.hpp"
#include "components/analysis/gas_fields.hpp"
#include "components/analysis/sampling.hpp"
#include "core/simulation/module_with_tags.hpp"

namespace tushar::analysis {

using input::Element;
using simulation::AnalysisKind;

namespace {

constexpr std::string_view densityName = "c.density", velocityName = "c.velocity";

struct Boxes {
  std::vector<Extent> list;
};

struct FluxSettings : Times {
  std::string name, material;
  Location where;
  Boxes boxes;
};

const input::Schema<FluxSettings>& fluxSchema() {
  static const input::Schema<Extent> box =
      input::Schema<Extent>("box", "A box.")
          .location(&Extent::where)
          .location(&Extent::whereOfName, "label")
          .requiredAttribute("label", &Extent::name, "1", "name of the file in the archive, without .dat")
          .required("min", &Extent::start, "m", "lower corner")
          .required("max", &Extent::end, "m", "upper corner");
  static const input::Schema<Boxes> boxes =
      input::Schema<Boxes>("controlVolumes", "The control volumes.").list("box", &Boxes::list, box, "a box", 1);
  static const input::Schema<FluxSettings> schema = [] {
    input::Schema<FluxSettings> tags("Module", "The mass of a gas in boxes, and the mass flow through their sides.");
    tags.requiredAttribute("name", &FluxSettings::name, "1", "controlVolFluxes")
        .location(&FluxSettings::where)
        .value("material", &FluxSettings::material, "", "1", "name of the gas");
    addTimes(tags);
    return tags.requiredSection("controlVolumes", &FluxSettings::boxes, boxes, "the boxes to sample");
  }();
  return schema;
}

template <int D>
class ControlVolFluxes : public Analysis {
 public:
  ControlVolFluxes(const FluxSettings& settings, const Level& level, std::array<bool, 2> derived, int material)
      : boxes_(settings.boxes.list), where_(settings.where), derived_(derived), material_(material), times_(settings) {
    for (const Extent& box : boxes_) {
      cells_.push_back(cellsOf(box, level));
      names_.push_back("flow of " + box.name);
      labels_.emplace_back(names_.back(), "kg", "mass in a box, and mass flow through its sides");
    }
  }

  void schedule(TaskList& tasks) const override {
    const auto [isNewDensity, isNewVelocity] = derived_;
    for (std::size_t k = 0; k < boxes_.size(); ++k) {
      const auto add = [&](const auto& rho, const auto& v) {
        tasks.perPatch("controlVolFluxes::add " + boxes_[k].name, addBoxFlow<D>, with(cells_[k]), with(material_), rho,
                       v, computes(labels_[k]));
      };
      if (isNewDensity && isNewVelocity) add(requiresNew(density_, 1), requiresNew(velocity_, 1));
      if (isNewDensity && !isNewVelocity) add(requiresNew(density_, 1), requiresOld(velocity_, 1));
      if (!isNewDensity && isNewVelocity) add(requiresOld(density_, 1), requiresNew(velocity_, 1));
      if (!isNewDensity && !isNewVelocity) add(requiresOld(density_, 1), requiresOld(velocity_, 1));
    }
  }
  void setTime(double time, double sinceStart) override { times_.pass(time, sinceStart); }
  std::vector<SaveRequest> samples() const override {
    std::vector<SaveRequest> requests;
    for (const std::string& name : names_) requests.push_back({name, "", where_, where_});
    return requests;
  }
  bool isSampleDue(int) const override { return times_.isDue(); }
  std::vector<simulation::OwnFile> files() const override {
    std::vector<simulation::OwnFile> files;
    for (const Extent& box : boxes_) files.push_back({box.name + ".dat", box.whereOfName});
    return files;
  }

  void sample(const std::vector<Snapshot>& parts, const std::filesystem::path& archive) override {
    for (std::size_t k = 0; k < boxes_.size(); ++k) {
      const auto& totals = parts.front().totals;
      const auto found =
          std::find_if(totals.begin(), totals.end(), [&](const auto& array) { return array.label == names_[k]; });
      if (found == totals.end() || found->entries() == 0) continue;
      const auto at = [&](std::size_t place) { return numberAt(*found, place); };
      std::string line = fmt::format("{:<21.14E} {:<21.14E}", parts.front().time, at(0));
      for (std::size_t axis = 0; axis < 3; ++axis)
        line += fmt::format(" {:<21.14E}", at(1 + 2 * axis) - at(2 + 2 * axis));
      for (std::size_t side = 0; side < 6; ++side) line += fmt::format(" {:<21.14E}", at(1 + side));
      files_.add(archive / (boxes_[k].name + ".dat"), header(boxes_[k]), line + '\n', parts.front().time);
    }
  }

 private:
  static std::string header(const Extent& box) {
    std::string text = fmt::format("# {}: [{:g}, {:g}, {:g}] [{:g}, {:g}, {:g}] m\n", box.name, box.start[0],
                                   box.start[1], box.start[2], box.end[0], box.end[1], box.end[2]);
    text += fmt::format("{:<21} {:<21}", "#Time [s]", "Total [kg]");
    for (const char* name : {"X faces [kg/s]", "Y faces", "Z faces", "x-", "x+", "y-", "y+", "z-", "z+"})
      text += fmt::format(" {:<21}", name);
    return text + '\n';
  }

  std::vector<Extent> boxes_;
  std::vector<Box> cells_;
  Location where_;
  /// Whether diagnostics compute density and velocity (otherwise they are part of the state).
  std::array<bool, 2> derived_;
  CellLabel<double> density_{densityName, "kg/m^3", "density"};
  CellLabel<Vec<D>> velocity_{velocityName, "m/s", "velocity"};
  int material_;
  /// Names of the variables; their addresses must not change, because labels refer to them.
  std::deque<std::string> names_;
  std::deque<ReductionLabel<BoxFlow>> labels_;
  SampleTimes times_;
  SampleFiles files_;
};

void checkBoxes(const std::vector<Extent>& boxes, const Level& level, const Element& module) {
  std::vector<InputProblem> problems;
  const std::string path = "DataAnalysis/Module/controlVolumes/box";
  if (level.domain().refinement.levels > 1)
    problems.push_back({module.where(), "DataAnalysis/Module",
                        "controlVolFluxes needs a grid of one level; remove the module, or the finer Levels and "
                        "<AMR>"});
  std::vector<std::string> names;
  for (const Extent& box : boxes) {
    if (box.name.empty() || box.name.starts_with('.') || box.name.find('/') != std::string::npos)
      problems.push_back(
          {box.whereOfName, path,
           fmt::format("label: found '{}', expected the name of a file, without '/' or leading dots", box.name)});
    else if (std::find(names.begin(), names.end(), box.name) != names.end())
      problems.push_back({box.whereOfName, path, fmt::format("the name '{}' is given twice", box.name)});
    names.push_back(box.name);
    for (int axis = 0; axis < 3; ++axis) {
      const double lower = level.domain().lower[axis], upper = level.domain().upper[axis];
      const bool isFlat = upper > lower && box.start[axis] >= box.end[axis];
      if (isFlat || box.start[axis] > upper || box.end[axis] < lower)
        problems.push_back(
            {box.where, path,
             fmt::format("found {} from {:g} to {:g} m, expected a part of the grid, from {:g} to {:g} m", "xyz"[axis],
                         box.start[axis], box.end[axis], lower, upper)});
    }
  }
  if (!problems.empty()) throw InputError(std::move(problems));
}

}  // namespace

void BoxFlow::merge(const BoxFlow& other) {
  mass.merge(other.mass);
  for (std::size_t side = 0; side < through.size(); ++side) through[side].merge(other.through[side]);
}

std::vector<double> BoxFlow::values() const {
  std::vector<double> values{mass.total()};
  for (const Sum& side : through) values.push_back(side.total());
  return values;
}

template <int D>
void addBoxFlow(const Patch& patch, const Box& box, int material, CellView<const double> density,
                CellView<const Vec<D>> velocity, BoxFlow& flow) {
  const Level& level = patch.level();
  const Box mine = box.intersect(patch.cells());
  if (mine.empty()) return;
  std::vector<VelocityAtEnd> ends;  // at the ends of the grid along each axis
  for (int d = 0; d < D; ++d)
    for (const int side : {0, 1}) ends.emplace_back(level, d, side, material);
  forEach<D>(mine, [&](const Index<D>& cell) {
    flow.mass.add(density[cell] * level.cellVolume());
    for (int d = 0; d < D; ++d)
      for (const int side : {0, 1}) {
        if (cell[d] != (side == 0 ? box.lower[d] : box.upper[d] - 1)) continue;
        Index<D> behind = cell;
        behind[d] += side == 0 ? -1 : 1;
        const bool isEnd = !density.box().contains(behind);
        const double v = isEnd ? ends[2 * d + side](velocity[cell][d], level.partAt<D>(d, side, behind))
                               : 0.5 * (velocity[cell][d] + velocity[behind][d]);
        const bool isFromInside = isEnd || (side == 0 ? v <= 0 : v > 0);
        const double rho = density[isFromInside ? cell : behind];
        const std::size_t place = 2 * level.axis(d) + side;
        flow.through[place].add(rho * v * level.cellVolume() / level.spacing(d));
      }
  });
}

template void addBoxFlow<1>(const Patch&, const Box&, int, CellView<const double>, CellView<const Vec<1>>, BoxFlow&);
template void addBoxFlow<2>(const Patch&, const Box&, int, CellView<const double>, CellView<const Vec<2>>, BoxFlow&);
template void addBoxFlow<3>(const Patch&, const Box&, int, CellView<const double>, CellView<const Vec<3>>, BoxFlow&);

AnalysisKind controlVolFluxesKind() {
  return simulation::moduleMadeBy(
      "controlVolFluxes", "the mass of a gas in boxes, and the mass flow through their sides", fluxSchema(),
      [](const FluxSettings& settings, const Element& module, const Component& component, const Level& level) {
        const auto density = isDerived(component, densityName), velocity = isDerived(component, velocityName);
        if (!density || !velocity)
          throw InputError({{module.where(), "DataAnalysis/Module",
                             "this component has no gas with density and velocity in cells; remove the module"}});
        checkGas(settings.material, component, module);
        checkBoxes(settings.boxes.list, level, module);
        const std::array<bool, 2> derived{*density, *velocity};
        return simulation::analysisByDimension<ControlVolFluxes>(level, settings, level, derived, bodiesOf(component));
      });
}

}  // namespace tushar::analysis
