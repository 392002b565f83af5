#include <fmt/format.h>

#include <algorithm>
#include <list>
#include <map>

#include "core/grid/choose_patches.hpp"
#include "core/input/schema.hpp"
#include "core/scene/scene_boxes.hpp"
#include "core/scene/scene_levels.hpp"
#include "core/scene/scene_sides.hpp"

namespace tushar::scene {

using input::Diagnostics;
using input::Element;
using input::Schema;
using simulation::namesOf;

namespace {

struct GridSection {
  FacesSection boundaries;
  std::vector<LevelSection> levels;
};

/// The schema of `<BoundaryConditions>` with the component's own sections.
Schema<FacesSection> facesTag(const Schema<FaceSection>& face, const std::vector<simulation::SectionForm>& own) {
  Schema<FacesSection> tags("BoundaryConditions",
                            "The conditions at the sides of the grid; a side without conditions is free.");
  tags.list("Face", &FacesSection::faces, face, "a side, or a part of one");
  for (const simulation::SectionForm& section : own)
    tags.custom(
            section.name, [](FacesSection&, const Element&, Diagnostics&) {}, {section.name},
            "values for conditions of this kind",
            [schema = section.schema](std::ostream& out, int indent) { schema->describeContents(out, indent); })
        .forms({input::onceForm(section.name, [schema = section.schema] {
          return std::vector<input::Alternative>{{schema, {}}};
        })});
  return tags;
}

/// The schemas of `<Grid>` and of the tags in it that contain conditions; the schema `condition` must outlive this
/// object.
struct GridTags {
  explicit GridTags(const Schema<ConditionSection>& condition, const std::vector<simulation::SectionForm>& own)
      : face(faceTag(condition)),
        faces(facesTag(face, own)),
        grid(Schema<GridSection>("Grid", "The grid and its boundary conditions.")
                 .ignoredAttribute("doAMR", "a grid with several levels is refined")
                 .section("BoundaryConditions", &GridSection::boundaries, faces)
                 .list("Level", &GridSection::levels, levelSchema(),
                       "the grid, and boxes in which it is finer; the coarsest first", 1)) {}
  GridTags(const GridTags&) = delete;
  GridTags& operator=(const GridTags&) = delete;

  Schema<FaceSection> face;
  Schema<FacesSection> faces;
  Schema<GridSection> grid;
};

/// The schema of `<Grid>` as it is read, for components that have the sections `own` for conditions.
const Schema<GridSection>& gridSchema(const std::vector<simulation::SectionForm>& own = {}) {
  static std::map<std::vector<std::string>, GridTags> all;
  return all.try_emplace(namesOf(own), conditionSchema(), own).first->second.grid;
}

/// A Grid section with the labels and words that one component accepts.
struct GridFor {
  explicit GridFor(const simulation::ComponentKind& kind)
      : condition(conditionFor(kind.boundaryLabels, kind.conditionWords.vars)),
        tags(condition, kind.conditionWords.sections) {}

  Schema<ConditionSection> condition;
  GridTags tags;
};

void checkSize(const grid::Domain& domain, const Element& element, Diagnostics& diagnostics) {
  double cells = 1;
  for (int axis = 0; axis < 3; ++axis) {
    cells *= domain.resolution[axis];
    if (domain.upper[axis] == domain.lower[axis] && domain.resolution[axis] > 1)
      diagnostics.error(element, fmt::format("there are {} cells along {}, but the box has no extent along this axis",
                                             domain.resolution[axis], "xyz"[axis]));
  }
  if (domain.upper == domain.lower) diagnostics.error(element, "the box has no extent along any axis");
  if (cells > mostCells)
    diagnostics.error(element,
                      fmt::format("resolution [{},{},{}] gives {:.3g} cells; at most {:.3g} are possible",
                                  domain.resolution[0], domain.resolution[1], domain.resolution[2], cells, mostCells));
}

/// Divides a grid of one level into patches.
void cutIntoPatches(const GridBox& box, const grid::Workers& workers, const Element& element, grid::Domain& domain,
                    Diagnostics& diagnostics) {
  domain.mayRecut = !workers.layout;
  if (!box.patches && !workers.layout) {
    domain.patches =
        grid::choosePatches(domain.resolution, box.autoPatch.value_or(workers.patchesFor(domain.resolution)));
    return;
  }
  domain.patches = workers.layout ? *workers.layout : *box.patches;
  for (int axis = 0; axis < 3; ++axis)
    if (domain.patches[axis] > domain.resolution[axis])
      diagnostics.error(element,
                        fmt::format("there are {} patches along {}{}, but only {}", domain.patches[axis], "xyz"[axis],
                                    workers.layout ? " in --layout" : "", counted(domain.resolution[axis], "cell")));
}

/// Divides a grid of several levels into patches, which are boxes of blocks.
void groupBlocks(const Element& section, const grid::Workers& workers, grid::Domain& domain, Diagnostics& diagnostics) {
  if (workers.layout) {
    grid::Refinement& refinement = domain.refinement;
    refinement.blocksPerPatch = *workers.layout;
    for (int axis = 0; axis < 3; ++axis) {  // no more than exist, so that the number of their cells fits an int
      const int blocks = std::max(1, domain.resolution[axis] / refinement.blockCells[axis]) << (refinement.levels - 1);
      (*refinement.blocksPerPatch)[axis] = std::min((*workers.layout)[axis], blocks);
    }
  }
  for (const Element& level : section.children("Level"))
    for (const Element& box : level.children("Box"))
      for (const char* tag : {"patches", "autoPatch"})
        if (const auto given = box.child(tag))
          diagnostics.note(*given,
                           "does nothing: patches of a refined grid are boxes of blocks; --layout sets the largest "
                           "number of blocks in a patch");
}

}  // namespace

grid::Domain readGrid(const Element& section, const SideWords& words, const grid::Workers& workers,
                      const AmrSettings& amr, Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.size();
  grid::Domain domain;
  const GridSection read = gridSchema(words.own.sections).read(section, diagnostics);
  const std::vector<GivenPart> parts = readFaces(section, read.boundaries, words, domain.boundaries, diagnostics);
  if (diagnostics.size() > before) return domain;
  const Element first = section.children("Level").front();
  const std::vector<Element> boxes = first.children("Box");
  const LevelSection& level = read.levels.front();
  readBoxes(first, level, domain, diagnostics);
  domain.periodic = level.periodic;
  dropPeriodicSides(section, domain, diagnostics);
  checkSize(domain, boxes.front(), diagnostics);
  if (diagnostics.size() == before) readRefinement(section, read.levels, amr, domain, diagnostics);
  if (domain.refinement.levels > 1 && !domain.boxes.empty())
    diagnostics.error(boxes[1], "a grid of several levels needs one Box in its first Level");
  if (diagnostics.size() == before) checkParts(parts, domain, diagnostics);
  if (diagnostics.size() > before) return domain;
  if (domain.refinement.levels > 1)
    groupBlocks(section, workers, domain, diagnostics);
  else
    cutIntoPatches(patchesOfBoxes(first, level, diagnostics), workers, boxes.front(), domain, diagnostics);
  return domain;
}

const input::SchemaBase& gridForm(const simulation::ComponentKind& kind) {
  static std::list<GridFor> all;
  return all.emplace_back(kind).tags.grid;
}

void describeGrid(std::ostream& out) { gridSchema().describe(out); }

}  // namespace tushar::scene
