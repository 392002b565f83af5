#pragma once

#include <fmt/format.h>

#include <memory>

#include "core/grid/level.hpp"
#include "core/input/schema.hpp"
#include "core/simulation/catalogue.hpp"

namespace tushar::simulation {

/// Constructs a component with as many dimensions as the grid has axes in use.
template <template <int> class C, class... Arguments>
std::unique_ptr<Component> makeByDimension(const grid::Level& level, const Arguments&... arguments) {
  if (level.dimension() == 1) return std::make_unique<C<1>>(arguments...);
  if (level.dimension() == 2) return std::make_unique<C<2>>(arguments...);
  return std::make_unique<C<3>>(arguments...);
}

/// Reads the section that `schema` describes, below the scene's root tag `root`; reports an error if the section is
/// missing or given twice.
template <class S>
S readSection(const input::Element& root, const input::Schema<S>& schema, input::Diagnostics& diagnostics) {
  const auto sections = root.children(schema.name());
  if (sections.empty()) {
    diagnostics.error(root, fmt::format("the section <{}> is missing", schema.name()));
    return schema.defaults();
  }
  if (sections.size() > 1)
    diagnostics.error(
        sections[1], fmt::format("<{}> is given twice; the first is at {}", schema.name(), sections[0].where().text()));
  return schema.read(sections.front(), diagnostics);
}

/// Like readSection, but returns the defaults if the section is missing.
template <class S>
S readOptionalSection(const input::Element& root, const input::Schema<S>& schema, input::Diagnostics& diagnostics) {
  return root.child(schema.name()) ? readSection(root, schema, diagnostics) : schema.defaults();
}

/// The conditions (`BCType`) of all faces of the grid, in the order of the scene.
inline std::vector<input::Element> boundaryConditions(const input::Element& root) {
  std::vector<input::Element> all;
  const auto grid = root.child("Grid");
  const auto group = grid ? grid->child("BoundaryConditions") : std::nullopt;
  if (!group) return all;
  for (const input::Element& face : group->children("Face"))
    for (const input::Element& condition : face.children("BCType")) all.push_back(condition);
  return all;
}

/// Reports the conditions for materials that a scene with `count` materials does not have: they would apply to nothing.
inline void refuseOtherMaterials(const input::Element& root, int count, input::Diagnostics& diagnostics) {
  for (const input::Element& condition : boundaryConditions(root)) {
    const auto material = input::parse<int>(condition.attribute("id").value_or("all")).value;
    if (material && *material >= count)
      diagnostics.error(condition.whereOf("id"), condition.path(),
                        count == 1 ? fmt::format("there is no material {}: the only material has index 0", *material)
                                   : fmt::format("there is no material {}; materials are numbered from 0 to {}",
                                                 *material, count - 1));
  }
}

/// The description of a component with as many dimensions as the grid has axes, and one section of settings.
template <template <int> class C, class S>
ComponentKind kindWithSection(std::string name, std::string sentence, const input::Schema<S>& schema,
                              std::vector<grid::BoundaryVariable> boundaryLabels) {
  ComponentKind kind;
  kind.name = std::move(name);
  kind.sentence = std::move(sentence);
  kind.sections = {schema.name()};
  kind.boundaryLabels = std::move(boundaryLabels);
  kind.describe = [&schema](std::ostream& out) { schema.describe(out); };
  kind.forms = [&schema] { return std::vector<std::vector<SectionForm>>{{{schema.name(), &schema}}}; };
  kind.read = [&schema](const input::Element& root, input::Diagnostics& diagnostics) -> MakeComponent {
    const S settings = readSection(root, schema, diagnostics);
    refuseOtherMaterials(root, 1, diagnostics);
    return [settings](const grid::Level& level) { return makeByDimension<C>(level, settings); };
  };
  return kind;
}

}  // namespace tushar::simulation
