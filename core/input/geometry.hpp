#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "core/input/diagnostics.hpp"
#include "core/input/element.hpp"
#include "core/input/geometry/piece.hpp"
#include "core/input/schema.hpp"

namespace tushar::input {

/// The names of all tags that are shapes, for Schema::custom: `.custom("shape", …, geometryNames(), …)`.
std::vector<std::string> geometryNames();
/// The allowed content of these tags, for Schema::forms.
std::vector<TagForm> geometryForms();

/// Reads the shapes among the children of `parent`, a `<geom_object>` or a similar tag; several shapes form a union.
/// The schema of `parent` reads the other children. Returns null, with an error in the diagnostics, if there is no
/// shape or if one is invalid.
///
/// A shape with a `label` (or `name`) can be reused further down in the same section of the scene (the tag below the
/// root) by an empty tag of the same kind with that label.
PiecePtr readGeometry(const Element& parent, Diagnostics& diagnostics);

/// Reads one shape. Returns null, with an error in the diagnostics, if the shape is unknown or invalid.
PiecePtr readShape(const Element& shape, Diagnostics& diagnostics);

/// Prints the manual of all shapes, indented by `indent` blanks.
void describeGeometry(std::ostream& out, int indent = 0);

/// Adds the tags of the shapes to the schema of a body: `shape` is set to their union, and `where` to the location of
/// the body. `sentence` describes what the shape is for.
template <class S>
Schema<S>& addShape(Schema<S>& body, Location S::*where, PiecePtr S::*shape, const std::string& sentence) {
  const auto read = [shape](S& object, const Element& element, Diagnostics& diagnostics) {
    object.*shape = readGeometry(element, diagnostics);
  };
  return body.location(where)
      .custom("shape", read, geometryNames(), sentence, describeGeometry)
      .forms(geometryForms(), 1);
}

}  // namespace tushar::input
