#include "core/tasks/broken_value.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <regex>

#include "core/base/error.hpp"
#include "core/data/bound_rows.hpp"
#include "tests/support/run.hpp"

namespace tushar::tasks {

namespace {

using data::Bound;
using data::CellLabel;
using data::CellView;
using data::NodeLabel;
using data::NodeView;
using data::ParticleLabel;
using data::ParticleView;
using grid::forEach;
using grid::Patch;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

constexpr CellLabel<double> heat{"c.heat", "J", "heat", Bound::nonNegative};
constexpr NodeLabel<double> mass{"g.mass", "kg", "mass", Bound::nonNegative};
template <int D>
constexpr ParticleLabel<Vec<D>> x{"p.x", "m", "position"};
template <int D>
constexpr ParticleLabel<Vec<D>> velocity{"p.velocity", "m/s", "velocity", Bound::finite};
constexpr ParticleLabel<double> density{"p.density", "kg/m^3", "density", Bound::positive};

struct Material {
  std::string name;
};
const std::vector<Material> gas{{"gas"}};

/// Returns the message that running a list throws, without the patch index.
std::string failure(test::Runner& run, TaskGraph& graph) {
  try {
    run.step(graph);
  } catch (const NumericalError& error) {
    return std::regex_replace(error.what(), std::regex("patch \\d+"), "patch *");
  }
  return "";
}

/// Two particles in each cell: ids 2 c and 2 c + 1 in cell c, with density 1 + id / 100.
template <int D>
void create(const Patch& patch, const Material&, ParticleMaker& maker, std::vector<Vec<D>>& positions,
            std::vector<double>& densities) {
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    for (const ParticleId k : {0u, 1u}) {
      const ParticleId id = 2 * patch.level().cellNumber(cell) + k;
      Vec<D> at = patch.level().template cellCentre<D>(cell);
      at[0] += (k == 0 ? -0.25 : 0.25) * patch.level().spacing(0);
      maker.add(cell, id);
      positions.push_back(at);
      densities.push_back(1 + 0.01 * static_cast<double>(id));
    }
  });
}

/// Returns the message if particles get wrong densities in a step, before or after relocation.
template <int D>
std::string planted(const grid::Domain& domain, const std::map<ParticleId, double>& wrong, bool relocated) {
  test::Runner run(domain);
  TaskList start, advance;
  start.newParticles("create", create<D>, gas, creates(x<D>), creates(density));
  advance.perMaterial(
      "keep",
      [](const Patch&, const Material&, ParticleView<const Vec<D>> from, ParticleView<Vec<D>> to) {
        for (int p = 0; p < from.owned(); ++p) to[p] = from[p];
      },
      gas, requiresOld(x<D>), computes(x<D>));
  if (relocated) advance.relocate(x<D>, gas);
  advance.perMaterial(
      "copy",
      [](const Patch&, const Material&, ParticleView<const Vec<D>> at, ParticleView<double> to) {
        for (int p = 0; p < at.owned(); ++p) to[p] = 2;
      },
      gas, requiresNew(x<D>), computes(density));
  const auto plant = [wrong](const Patch&, const Material&, ParticleView<const ParticleId> ids,
                             ParticleView<double> rho) {
    for (int p = 0; p < ids.owned(); ++p)
      if (wrong.contains(ids[p])) rho[p] = wrong.at(ids[p]);
  };
  if (relocated)
    advance.perMaterial("plant", plant, gas, requiresNew(data::particleId), modifies(density));
  else
    advance.perMaterial("plant", plant, gas, requiresOld(data::particleId), modifies(density));
  TaskGraph begin = run.compile(start, {"p.x", "p.density", "p.particleID"});
  TaskGraph step = run.compile(advance, {"p.x", "p.density"}, true);
  run.step(begin);
  return failure(run, step);
}

/// Returns the message if a node or cell variable is set to `value` in one place.
template <int D, class Label>
std::string plantedOnGrid(const grid::Domain& domain, const Label& label, const Index<D>& where, double value) {
  test::Runner run(domain);
  TaskList start, advance;
  const auto fill = [](const Patch&, auto field) { field.fill(1); };
  start.perPatch("fill", fill, computes(label));
  advance.perPatch(
      "plant",
      [&](const Patch&, auto field) {
        field.fill(3);
        if (field.box().contains(where)) field[where] = value;
      },
      computes(label));
  TaskGraph begin = run.compile(start, {std::string(label.name)}),
            step = run.compile(advance, {std::string(label.name)});
  run.step(begin);
  return failure(run, step);
}

}  // namespace

TEST(Bound, IsKeptByWhatItAllows) {
  const double infinity = std::numeric_limits<double>::infinity(), least = std::numeric_limits<double>::denorm_min();
  const double greatest = std::numeric_limits<double>::max();
  const std::map<Bound, std::vector<double>> allowed{
      {Bound::finite, {0.0, -0.0, 1.0, -1.0, least, -least, greatest, -greatest}},
      {Bound::nonNegative, {0.0, -0.0, 1.0, least, greatest}},
      {Bound::positive, {1.0, least, greatest}},
      {Bound::none, {0.0, -0.0, 1.0, -1.0, least, -least, greatest, -greatest, nan, -nan, infinity, -infinity}}};

  for (const auto& [bound, values] : allowed)
    for (const double value : allowed.at(Bound::none)) {
      const bool expected =
          bound == Bound::none || std::any_of(values.begin(), values.end(), [&](double v) { return v == value; });
      const bool zero = value == 0 && bound == Bound::positive;
      EXPECT_EQ(data::holds(bound, value), expected && !zero) << data::textOf(bound) << ' ' << value;
      for (const std::size_t place : {0u, 31u, 32u, 66u}) {
        std::vector<double> many(67, 1.0);
        many[place] = value;
        EXPECT_EQ(data::holds(bound, many.data(), many.size()), expected && !zero)
            << data::textOf(bound) << ' ' << value << " at " << place;
      }
    }
}

TEST(Bound, IsCheckedInRowsAndNotBetweenThem) {
  constexpr std::size_t rows = 5, stride = 70;
  for (const std::size_t count : {1u, 7u, 8u, 16u, 23u, 31u, 67u})
    for (std::size_t place = 0; place < rows * stride; ++place) {
      std::vector<double> many(rows * stride, 1.0);
      many[place] = -1;
      const bool isInRow = place % stride < count;
      EXPECT_EQ(data::holds(Bound::positive, {many.data(), count, rows, stride}), !isInRow) << count << ' ' << place;
      EXPECT_TRUE(data::holds(Bound::finite, {many.data(), count, rows, stride}));
      many[place] = nan;
      for (const Bound bound : {Bound::finite, Bound::nonNegative})
        EXPECT_EQ(data::holds(bound, {many.data(), count, rows, stride}), !isInRow) << count << ' ' << place;
    }
  EXPECT_TRUE(data::holds(Bound::positive, data::NumberRows{nullptr, 4, 0, 0}));
}

TEST(Bound, IsKeptByNumbersWhoseSumOverflows) {
  const std::vector<double> many(67, std::numeric_limits<double>::max());

  for (const Bound bound : {Bound::finite, Bound::nonNegative, Bound::positive})
    EXPECT_TRUE(data::holds(bound, many.data(), many.size())) << data::textOf(bound);
}

TEST(BrokenValue, SaysWhichParticleWhereWhenAndWhatIsAroundIt) {
  for (const int patches : {1, 2, 7, 8})
    for (const bool relocated : {false, true})
      EXPECT_EQ(
          planted<1>(test::domain({{8, 1, 1}}, {{patches, 1, 1}}), {{7, -0.5}, {9, nan}}, relocated),
          "p.density became -0.5 kg/m^3 (was 1.07), but must be greater than 0: particle 7 in cell (3) at x = 0.46875 "
          "m; around it: 2 in its cell, 2, 2 in cell (2), 2, nan in cell (4); 2 of 16 particles are out of bounds "
          "(task "
          "plant, patch *, material gas, step 7, time 0.5 s)");
}

TEST(BrokenValue, NamesAPlantedParticleOnAnyLayoutInTwoAndThreeDimensions) {
  for (const ParticleId id : {0u, 13u, 40u, 83u}) {
    const std::string reference = planted<2>(test::domain({{7, 6, 1}}), {{id, nan}}, true);
    EXPECT_NE(reference.find(
                  fmt::format("p.density became nan kg/m^3 (was {:.6g}), but must be greater than 0: particle {} in",
                              1 + 0.01 * static_cast<double>(id), id)),
              std::string::npos)
        << reference;
    for (const Index3& patches : {Index3{{3, 2, 1}}, Index3{{7, 6, 1}}})
      EXPECT_EQ(planted<2>(test::domain({{7, 6, 1}}, patches), {{id, nan}}, true), reference);
    const std::string inSpace = planted<3>(test::domain({{4, 3, 5}}), {{id, -1}}, false);
    EXPECT_NE(inSpace.find(fmt::format("particle {} in cell (", id)), std::string::npos) << inSpace;
    EXPECT_EQ(planted<3>(test::domain({{4, 3, 5}}, {{2, 3, 2}}), {{id, -1}}, false), inSpace);
  }
}

TEST(BrokenValue, OfSeveralNamesTheFirstByCellWhateverThePatches) {
  const std::map<ParticleId, double> wrong{{70, nan}, {31, -3}, {44, 0}};  // cells (0,5), (1,2), (1,3) of 7 x 6

  for (const Index3& patches : {Index3{{1, 1, 1}}, Index3{{3, 2, 1}}, Index3{{7, 6, 1}}})
    EXPECT_NE(planted<2>(test::domain({{7, 6, 1}}, patches), wrong, true).find("became -3 kg/m^3"), std::string::npos);
}

TEST(BrokenValue, SaysWhichCellOrNode) {
  for (const int patches : {1, 2, 5})
    for (const double value : {-2.0, -std::numeric_limits<double>::infinity()}) {
      const grid::Domain tube = test::domain({{5, 1, 1}}, {{patches, 1, 1}});
      EXPECT_EQ(plantedOnGrid<1>(tube, heat, Index<1>{{4}}, value),
                fmt::format("c.heat became {} J (was 1), but must be at least 0: cell (4) at x = 0.9 m; around it: 3 "
                            "in cell (3); 1 of 5 cells is out of bounds (task plant, patch *, step 7, time 0.5 s)",
                            value));
      EXPECT_EQ(
          plantedOnGrid<1>(tube, mass, Index<1>{{2}}, value),
          fmt::format("g.mass became {} kg (was 1), but must be at least 0: node (2) at x = 0.4 m; around it: 3 in "
                      "node (1), 3 in node (3); 1 of 6 nodes is out of bounds (task plant, patch *, step 7, time "
                      "0.5 s)",
                      value));
    }
}

TEST(BrokenValue, SaysWhereInTwoDimensions) {
  for (const Index3& patches : {Index3{{1, 1, 1}}, Index3{{2, 3, 1}}})
    EXPECT_EQ(
        plantedOnGrid<2>(test::domain({{5, 3, 1}}, patches), mass, Index<2>{{0, 1}}, nan),
        "g.mass became nan kg (was 1), but must be at least 0: node (0, 1) at x = (0, 0.2) m; around it: 3 in node (1, "
        "1), 3 in node (0, 0), 3 in node (0, 2); 1 of 24 nodes is out of bounds (task plant, patch *, step 7, time "
        "0.5 s)");
}

TEST(BrokenValue, IsFoundInEachMaterialOfATaskForAllOfThem) {
  const std::vector<Material> two{{"gas"}, {"dust"}};
  for (const std::size_t bad : {0u, 1u}) {
    test::Runner run(test::domain({{4, 1, 1}}, {{2, 1, 1}}));
    TaskList list;
    list.acrossMaterials(
        "mix",
        [bad](const Patch& patch, const std::vector<Material>&, const std::vector<CellView<double>>& fields) {
          for (const CellView<double>& field : fields) field.fill(3);
          if (patch.cells().contains(Index<1>{{2}})) fields[bad][Index<1>{{2}}] = -1;
        },
        two, computes(heat));
    TaskGraph graph = run.compile(list, {"c.heat"});

    EXPECT_EQ(
        failure(run, graph),
        "c.heat became -1 J, but must be at least 0: cell (2) at x = 0.625 m; around it: 3 in cell (1), 3 in cell (3); "
        "1 of 4 cells is out of bounds (task mix, patch *, material " +
            two[bad].name + ", step 7, time 0.5 s)");
  }
}

TEST(BrokenValue, LooksAtGhostsOfNobody) {
  test::Runner run(test::domain({{8, 1, 1}}, {{2, 1, 1}}));
  TaskList list;
  list.perPatch(
      "fill",
      [](const Patch& patch, CellView<double> field) {
        field.fill(-1);  // ghosts too, which are not the patch's to fill
        forEach<1>(patch.cells(), [&](const Index<1>& cell) { field[cell] = 1; });
      },
      computes(heat));
  list.perPatch(
      "read", [](const Patch&, CellView<const double>, NodeView<double> to) { to.fill(0); }, requiresNew(heat, 2),
      computes(mass));
  TaskGraph graph = run.compile(list, {"g.mass"});

  EXPECT_EQ(failure(run, graph), "");
}

TEST(BrokenValue, IsFoundInNewParticles) {
  test::Runner run(test::domain({{4, 1, 1}}, {{2, 1, 1}}));
  TaskList start;
  start.newParticles(
      "create",
      [](const Patch& patch, const Material&, ParticleMaker& maker, std::vector<Vec<2>>& v, std::vector<Vec<1>>& at) {
        forEach<1>(patch.cells(), [&](const Index<1>& cell) {
          maker.add(cell, patch.level().cellNumber(cell));
          at.push_back(patch.level().cellCentre<1>(cell));
          v.push_back(Vec<2>(0, cell[0] == 2 ? nan : 0));
        });
      },
      gas, creates(velocity<2>), creates(x<1>));
  TaskGraph begin = run.compile(start, {"p.x", "p.velocity"});

  EXPECT_EQ(
      failure(run, begin),
      "p.velocity became (0, nan) m/s, but must be finite: particle 2 in cell (2) at x = 0.625 m; around it: none in "
      "its cell, (0, 0) in cell (1), (0, 0) in cell (3); 1 of 4 particles is out of bounds (task create, patch *, "
      "material gas, step 7, time 0.5 s)");
}

TEST(BrokenValue, IsFoundOnNodesBehindWhichTheirLevelEnds) {
  grid::Domain domain = test::domain({{32, 1, 1}});
  domain.refinement.levels = 2;
  domain.refinement.regions.push_back({1, Vec3(0.25, 0, 0), Vec3(0.75, 1, 1)});  // nodes 16 to 48 of the finer level
  test::Runner run(domain);
  TaskList list;
  list.perPatch(
      "weigh",
      [](const Patch& patch, NodeView<double> masses) {
        forEach<1>(patch.nodes(),
                   [&](const Index<1>& node) { masses[node] = patch.level().number() == 1 && node[0] == 48 ? -1 : 1; });
      },
      computes(mass));
  TaskGraph graph = run.compile(list, {"g.mass"});

  const std::string said = failure(run, graph);

  EXPECT_TRUE(said.starts_with("g.mass became -1 kg, but must be")) << said;
  EXPECT_NE(said.find("node (48) at x = 0.75 m"), std::string::npos) << said;
}

}  // namespace tushar::tasks
