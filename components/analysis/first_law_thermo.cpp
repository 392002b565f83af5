#include "components/analysis/first_law_thermo.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "components/analysis/gas_fields.hpp"
#include "components/analysis/sampling.hpp"
#include "core/simulation/module_with_tags.hpp"

namespace tushar::analysis {

using input::Element;
using simulation::AnalysisKind;

namespace {

constexpr std::string_view gasTotal = "TotalIntEng", bodiesTotal = "ThermalEnergy", thermoFile = "1stLawThermo.dat";
constexpr std::string_view carriedName = "c.totalEnergy", pressingName = "c.pressure", flowName = "c.velocity",
                           roomName = "c.freeVolume";

/// A `<Face>`: a side of the grid, or the part of it between two points.
struct SideTag {
  Location where;
  int side = 0;  ///< 2 axis + side
  bool isPart = false;
  std::optional<Vec3> start, end;  ///< two opposite corners [m]
};
struct SideList {
  std::vector<SideTag> list;
};
struct FirstLawSettings : Times {
  std::string name;
  Location where;
  SideList sides;
};

const input::Schema<SideTag>& sideSchema() {
  static const input::Schema<SideTag> schema =
      input::Schema<SideTag>("Face", "A side of the grid, through which energy flows.")
          .location(&SideTag::where)
          .requiredChoiceAttribute("side", &SideTag::side,
                                   {{"x-", 0}, {"x+", 1}, {"y-", 2}, {"y+", 3}, {"z-", 4}, {"z+", 5}}, "which side")
          .choiceAttribute("extents", &SideTag::isPart, {{"entireFace", false}, {"partialFace", true}}, false,
                           "all of it, or the part from <startPt> to <endPt>")
          .optional("startPt", &SideTag::start, "m", "lower corner of the part")
          .optional("endPt", &SideTag::end, "m", "upper corner of the part")
          .check([](const SideTag& read, const Element& face, input::Diagnostics& diagnostics) {
            if (read.isPart && (!read.start || !read.end))
              diagnostics.error(face, "extents 'partialFace' needs <startPt> and <endPt>");
          });
  return schema;
}

const input::Schema<FirstLawSettings>& firstLawSchema() {
  static const input::Schema<SideList> sides =
      input::Schema<SideList>("controlVolume", "The sides of the grid through which energy flows.")
          .list("Face", &SideList::list, sideSchema(), "a side, or a part of one", 1);
  static const input::Schema<FirstLawSettings> schema = [] {
    input::Schema<FirstLawSettings> tags("Module",
                                         "The internal energy of gas and bodies, and what flows out through sides.");
    tags.requiredAttribute("name", &FirstLawSettings::name, "1", "firstLawThermo").location(&FirstLawSettings::where);
    addTimes(tags);
    tags.ignored("engy_convt_factor", "all energies are in J");
    return tags.requiredSection("controlVolume", &FirstLawSettings::sides, sides, "the sides to measure");
  }();
  return schema;
}

/// The cells of the finest level at a side; for a part of a side, those whose centres lie between its corners.
MeasuredSide sideOf(const SideTag& tag, const Level& level, int axis) {
  MeasuredSide of{axis, tag.side % 2, level.cells()};
  (of.side == 0 ? of.cells.upper[axis] : of.cells.lower[axis]) =
      of.side == 0 ? of.cells.lower[axis] + 1 : of.cells.upper[axis] - 1;
  for (int d = 0; tag.isPart && d < level.dimension(); ++d) {
    if (d == axis) continue;
    const double origin = level.domain().lower[level.axis(d)], width = level.spacing(d);
    const auto first = [&](double at) { return static_cast<int>(std::ceil((at - origin) / width - 0.5 - 1e-9)); };
    of.cells.lower[d] = std::max(of.cells.lower[d], first((*tag.start)[level.axis(d)]));
    of.cells.upper[d] = std::min(of.cells.upper[d], first((*tag.end)[level.axis(d)]));
  }
  return of;
}

/// What is wrong with the part of a side: empty if nothing is.
std::string problemOf(const SideTag& tag, const Level& level) {
  if (!tag.isPart) return tag.start || tag.end ? "<startPt> and <endPt> need extents 'partialFace'" : "";
  const int axis = tag.side / 2;
  const grid::Domain& domain = level.domain();
  const double at = (tag.side % 2 == 0 ? domain.lower : domain.upper)[axis];
  const double rounding = 1e-9 * (domain.upper[axis] - domain.lower[axis]);
  for (const Vec3& point : {*tag.start, *tag.end})
    if (std::abs(point[axis] - at) > rounding)
      return fmt::format("found a point at {} = {:g} m, expected {:g} m, where this side is", "xyz"[axis], point[axis],
                         at);
  for (int d = 0; d < level.dimension(); ++d) {
    const int along = level.axis(d);
    if (along == axis) continue;
    if ((*tag.start)[along] >= (*tag.end)[along])
      return fmt::format("found endPt at {} = {:g} m, expected more than {:g} m, the coordinate of startPt",
                         "xyz"[along], (*tag.end)[along], (*tag.start)[along]);
    if ((*tag.start)[along] >= domain.upper[along] || (*tag.end)[along] <= domain.lower[along])
      return fmt::format("has no cells of the grid between its points along {}", "xyz"[along]);
  }
  return "";
}

/// Throws InputError for parts that are not on their side, and for cells that two tags would count twice.
void checkSides(const std::vector<SideTag>& tags, const Level& level) {
  std::vector<InputProblem> problems;
  for (std::size_t k = 0; k < tags.size(); ++k) {
    std::string problem = problemOf(tags[k], level);
    for (std::size_t before = 0; before < k && problem.empty(); ++before)
      if (tags[before].side == tags[k].side && !(tags[before].isPart && tags[k].isPart))
        problem =
            fmt::format("the same side as on line {}, so that its energy would count twice", tags[before].where.line);
    if (!problem.empty()) problems.push_back({tags[k].where, "DataAnalysis/Module/controlVolume/Face", problem});
  }
  if (!problems.empty()) throw InputError(std::move(problems));
}

/// The sides normal to axes that the grid uses; nothing leaves through periodic sides.
std::vector<MeasuredSide> sidesOf(const std::vector<SideTag>& tags, const Level& level) {
  checkSides(tags, level);
  std::vector<MeasuredSide> sides;
  for (const SideTag& tag : tags)
    for (int d = 0; d < level.dimension(); ++d)
      if (level.axis(d) == tag.side / 2 && !level.isPeriodic(d)) sides.push_back(sideOf(tag, level, d));
  return sides;
}

constexpr ReductionLabel<Sum> energyOutflow{"EnergyOutflow", "W", "energy that flows out through sides of the grid"};

template <int D>
class FirstLawThermo : public Analysis {
 public:
  FirstLawThermo(const FirstLawSettings& settings, const Level& level, bool hasBodies, int material)
      : sides_(sidesOf(settings.sides.list, level)),
        where_(settings.where),
        has_bodies_(hasBodies),
        material_(material),
        times_(settings) {}

  void schedule(TaskList& tasks) const override {
    const auto body = [](const Patch& patch, const std::vector<MeasuredSide>& sides, int material,
                         CellView<const double> energy, CellView<const double> pressure,
                         CellView<const Vec<D>> velocity, std::optional<CellView<const double>> free, Sum& sum) {
      addOutflow<D>(patch, sides, material, {energy, pressure, velocity, free}, sum);
    };
    tasks.perPatch("firstLawThermo::addOutflow", body, with(sides_), with(material_), requiresOld(energy_),
                   requiresNew(pressure_), requiresNew(velocity_), when(has_bodies_, requiresOld(free_)),
                   computes(energyOutflow));
  }
  void setTime(double time, double sinceStart) override { times_.pass(time, sinceStart); }
  std::vector<SaveRequest> samples() const override {
    std::vector<SaveRequest> requests;
    for (const std::string_view name : {gasTotal, std::string_view(energyOutflow.name)})
      requests.push_back({std::string(name), "", where_, where_});
    if (has_bodies_) requests.push_back({std::string(bodiesTotal), "", where_, where_});
    return requests;
  }
  bool isSampleDue(int) const override { return times_.isDue(); }
  std::vector<simulation::OwnFile> files() const override { return {{std::string(thermoFile), where_}}; }

  void sample(const std::vector<Snapshot>& parts, const std::filesystem::path& archive) override {
    const auto total = [&](std::string_view name) {
      for (const output::Array& array : parts.front().totals)
        if (array.label == name && array.entries() > 0) return numberAt(array, 0);
      return 0.0;
    };
    const double gas = total(gasTotal), bodies = total(bodiesTotal);
    std::string line = fmt::format("{:<22.15E}", parts.front().time);
    for (const double number : {gas, bodies, gas + bodies, total(energyOutflow.name)})
      line += fmt::format(" {:<22.15E}", number);
    std::string header = fmt::format("{:<22}", "#Time [s]");
    for (const char* name : {"ICE_totalIntEng [J]", "MPM_totalIntEng [J]", "totalIntEng [J]", "total_ICE_Flux [W]"})
      header += fmt::format(" {:<22}", name);
    files_.add(archive / thermoFile, header + '\n', line + '\n', parts.front().time);
  }

 private:
  std::vector<MeasuredSide> sides_;
  Location where_;
  bool has_bodies_;
  int material_;
  CellLabel<double> energy_{carriedName, "J/m^3", "energy"}, pressure_{pressingName, "Pa", "pressure"},
      free_{roomName, "1", "share of the gas"};
  CellLabel<Vec<D>> velocity_{flowName, "m/s", "velocity"};
  SampleTimes times_;
  SampleFiles files_;
};

}  // namespace

template <int D>
void addOutflow(const Patch& patch, const std::vector<MeasuredSide>& sides, int material, const OutflowViews<D>& gas,
                Sum& outflow) {
  const Level& level = patch.level();
  for (const MeasuredSide& of : sides) {
    const VelocityAtEnd velocity(level, of.axis, of.side, material);
    forEach<D>(of.cells.intersect(patch.cells()), [&](const Index<D>& cell) {
      Index<D> beyond = cell;
      beyond[of.axis] += of.side == 0 ? -1 : 1;
      const double v = velocity(gas.velocity[cell][of.axis], level.partAt<D>(of.axis, of.side, beyond));
      const double carried = gas.totalEnergy[cell] + (gas.free ? (*gas.free)[cell] : 1.0) * gas.pressure[cell];
      outflow.add((of.side == 0 ? -v : v) * carried * level.cellVolume() / level.spacing(of.axis));
    });
  }
}

template void addOutflow<1>(const Patch&, const std::vector<MeasuredSide>&, int, const OutflowViews<1>&, Sum&);
template void addOutflow<2>(const Patch&, const std::vector<MeasuredSide>&, int, const OutflowViews<2>&, Sum&);
template void addOutflow<3>(const Patch&, const std::vector<MeasuredSide>&, int, const OutflowViews<3>&, Sum&);

AnalysisKind firstLawThermoKind() {
  return simulation::moduleMadeBy(
      "firstLawThermo", "the internal energy of gas and bodies, and the energy that leaves through sides",
      firstLawSchema(),
      [](const FirstLawSettings& settings, const Element& module, const Component& component, const Level& level) {
        const auto refuse = [&](const char* sentence) {
          throw InputError({{module.where(), "DataAnalysis/Module", sentence}});
        };
        if (isDerived(component, carriedName) != false || isDerived(component, pressingName) != true ||
            isDerived(component, flowName) != true || !computesTotal(component, gasTotal))
          refuse("this component has no gas with energy, pressure and velocity in cells; remove the module");
        if (level.domain().refinement.levels > 1)
          refuse("firstLawThermo needs a grid of one level; remove the module, or the finer Levels and <AMR>");
        const int bodies = bodiesOf(component);
        const bool hasBodies = isDerived(component, roomName) == false && computesTotal(component, bodiesTotal);
        return simulation::analysisByDimension<FirstLawThermo>(level, settings, level, hasBodies, bodies);
      });
}

}  // namespace tushar::analysis
