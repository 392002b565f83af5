#include "core/input/geometry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <optional>

#include "core/input/geometry/combined.hpp"
#include "core/input/geometry/planes.hpp"
#include "core/input/geometry/shapes.hpp"
#include "core/input/geometry/smooth_cylinder.hpp"
#include "core/input/geometry/surface.hpp"
#include "core/input/schema.hpp"
#include "core/input/text.hpp"

namespace tushar::input {

namespace {

/// A kind of shape: its schema and the function that reads it.
struct Kind {
  std::string name;
  std::function<PiecePtr(const Element&, Diagnostics&)> read;
  std::function<void(std::ostream&, int)> describe;
  const SchemaBase* schema;  ///< schema of the shape; must outlive the kind
};

template <class T>
Kind simple() {
  const auto read = [](const Element& element, Diagnostics& diagnostics) -> PiecePtr {
    const std::size_t before = diagnostics.size();
    auto piece = std::make_shared<T>(T::schema().read(element, diagnostics));
    return diagnostics.size() == before ? piece : nullptr;
  };
  const auto describe = [](std::ostream& out, int indent) { T::schema().describe(out, indent); };
  return {T::schema().name(), read, describe, &T::schema()};
}

/// Whether all shapes could be read; a reference to an invalid shape is null and has no message of its own.
bool allRead(const std::vector<PiecePtr>& pieces) {
  return std::find(pieces.begin(), pieces.end(), nullptr) == pieces.end();
}

/// The shapes of a union, a difference or an intersection.
struct Operands {
  std::vector<PiecePtr> pieces;
};

std::vector<Element> shapesIn(const Element& parent) {
  const std::vector<std::string> shapes = geometryNames();
  std::vector<Element> found = parent.children();
  std::erase_if(found, [&](const Element& child) {
    return std::find(shapes.begin(), shapes.end(), child.name()) == shapes.end();
  });
  return found;
}

void readOperands(Operands& operands, const Element& parent, Diagnostics& diagnostics) {
  for (const Element& shape : shapesIn(parent)) operands.pieces.push_back(readShape(shape, diagnostics));
}

/// The schema of a tag that contains shapes: exactly two, or at least one.
Schema<Operands> operandsSchema(const std::string& name, const std::string& sentence, bool exactlyTwo) {
  const auto checkCount = [exactlyTwo](const Operands& operands, const Element& element, Diagnostics& diagnostics) {
    const std::size_t count = operands.pieces.size();
    if (exactlyTwo ? count == 2 : count >= 1) return;
    const char* expected = exactlyTwo ? "two shapes (the second is cut out of the first)" : "a shape";
    diagnostics.error(element, fmt::format("expected {} in <{}>, found {}", expected, element.name(), count));
  };
  Schema<Operands> schema(name, sentence);
  schema.foreignAttribute("label", "a name with which an empty tag further down can refer to this shape")
      .foreignAttribute("name", "a synonym of label")
      .custom("shapes", readOperands, geometryNames(), exactlyTwo ? "two shapes" : "any number of shapes")
      .forms(geometryForms(), exactlyTwo ? 2 : 1)
      .check(checkCount);
  return schema;
}

Kind combined(Schema<Operands> declared, const std::function<PiecePtr(std::vector<PiecePtr>)>& combine) {
  const auto schema = std::make_shared<const Schema<Operands>>(std::move(declared));
  const auto read = [schema, combine](const Element& element, Diagnostics& diagnostics) -> PiecePtr {
    const std::size_t before = diagnostics.size();
    Operands operands = schema->read(element, diagnostics);
    if (diagnostics.size() != before || !allRead(operands.pieces)) return nullptr;
    return combine(std::move(operands.pieces));
  };
  const auto describe = [schema](std::ostream& out, int indent) { schema->describe(out, indent); };
  return {schema->name(), read, describe, schema.get()};
}

Kind nothing() {
  struct Tag {};
  static const Schema<Tag> schema =
      Schema<Tag>("null", "The empty shape: a body without particles.")
          .foreignAttribute("label", "a name with which an empty tag further down can refer to this shape");
  const auto read = [](const Element& element, Diagnostics& diagnostics) -> PiecePtr {
    schema.read(element, diagnostics);
    return std::make_shared<Nothing>();
  };
  return {"null", read, [](std::ostream& out, int indent) { schema.describe(out, indent); }, &schema};
}

/// A shape that is defined by a file.
struct FileTag {
  std::string file;
};

/// The kind of a shape from a file; `load(path, tag, diagnostics)` makes the shape, or reports a problem at the tag.
Kind fromFile(const std::string& name, const std::string& sentence, const std::string& whatFile,
              const std::function<PiecePtr(const std::string&, const Element&, Diagnostics&)>& load) {
  const auto schema = std::make_shared<const Schema<FileTag>>(
      Schema<FileTag>(name, sentence)
          .foreignAttribute("label", "a name with which an empty tag further down can refer to this shape")
          .required("name", &FileTag::file, "m", whatFile));
  const auto read = [schema, load](const Element& element, Diagnostics& diagnostics) -> PiecePtr {
    const std::size_t before = diagnostics.size();
    const FileTag tag = schema->read(element, diagnostics);
    if (diagnostics.size() != before) return nullptr;
    const auto path = std::filesystem::path(element.where().file).parent_path() / tag.file;
    return load(path.string(), *element.child("name"), diagnostics);
  };
  return {name, read, [schema](std::ostream& out, int indent) { schema->describe(out, indent); }, schema.get()};
}

Kind surface() {
  return fromFile(
      "tri", "The inside of a closed surface of triangles.",
      "a file next to the scene: STL (text or binary) if its name ends in .stl; otherwise NAME for a pair of files: "
      "NAME.pts with a point `x y z` per line, and NAME.tri with the indices (from 0) of three points per line",
      [](const std::string& path, const Element& tag, Diagnostics& diagnostics) -> PiecePtr {
        return readSurface(path, tag, diagnostics);
      });
}

Kind polygon() {
  return fromFile("line_segment", "A polygon in the plane z = 0, within 1e-5 m of it.",
                  "a file next to the scene, with a corner `x y` per line, in order around the polygon",
                  [](const std::string& path, const Element& tag, Diagnostics& diagnostics) -> PiecePtr {
                    std::vector<Vec3> corners = readPolygon(path, tag, diagnostics);
                    return corners.empty() ? nullptr : std::make_shared<Polygon>(std::move(corners));
                  });
}

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all{
      simple<Box>(),
      simple<Cylinder>(),
      simple<Sphere>(),
      simple<Cone>(),
      simple<Ellipsoid>(),
      simple<Parallelepiped>(),
      simple<Torus>(),
      nothing(),
      surface(),
      polygon(),
      simple<Polyhedron>(),
      simple<SmoothCylinder>(),
      combined(operandsSchema("union", "The union of its shapes.", false),
               [](std::vector<PiecePtr> pieces) { return std::make_shared<Union>(std::move(pieces)); }),
      combined(operandsSchema("difference", "The points in its first shape that are not in its second.", true),
               [](std::vector<PiecePtr> pieces) { return std::make_shared<Difference>(pieces[0], pieces[1]); }),
      combined(operandsSchema("intersection", "The intersection of its shapes.", false),
               [](std::vector<PiecePtr> pieces) { return std::make_shared<Intersection>(std::move(pieces)); })};
  return all;
}

const Kind* findKind(const std::string& name) {
  const auto found = std::find_if(kinds().begin(), kinds().end(), [&](const Kind& kind) { return kind.name == name; });
  return found == kinds().end() ? nullptr : &*found;
}

std::optional<std::string> labelOf(const Element& shape) {
  const auto label = shape.attribute("label");
  return label ? label : shape.attribute("name");
}

bool isEmpty(const Element& element) { return element.children().empty() && element.text().empty(); }

bool isLabelledDefinition(const Element& element) {
  return !isEmpty(element) && labelOf(element) && findKind(element.name());
}

/// Collects the labelled shapes that end before `until` begins; returns whether `until` was reached.
bool collectAbove(const Element& from, const Element& until, std::vector<Element>& found) {
  if (from == until) return true;
  const std::size_t place = found.size();
  if (isLabelledDefinition(from)) found.push_back(from);
  for (const Element& child : from.children()) {
    if (!collectAbove(child, until, found)) continue;
    if (isLabelledDefinition(from)) found.erase(found.begin() + static_cast<std::ptrdiff_t>(place));
    return true;
  }
  return false;
}

/// The labelled shapes above a given shape in the same section of the scene (MaterialProperties, PhysicalBC, …). Each
/// section has its own labels, which hide those of other sections. Parts of the section that are read first also count
/// as above.
std::vector<Element> labelledAbove(const Element& shape) {
  Element section = shape, part = shape;
  while (section.parent() && section.parent()->parent()) {
    part = section;
    section = *section.parent();
  }
  std::vector<Element> found;
  collectAbove(section, shape, found);
  bool isBelow = false;
  for (const Element& other : section.children()) {
    if (isBelow && other.isReadFirst() && !part.isReadFirst()) collectAbove(other, shape, found);
    isBelow |= other == part;
  }
  return found;
}

/// The labelled shapes of all sections above.
std::vector<Element> labelledInScene(const Element& shape) {
  Element scene = shape;
  while (scene.parent()) scene = *scene.parent();
  std::vector<Element> found;
  collectAbove(scene, shape, found);
  return found;
}

std::vector<Element> definitions(const std::string& label, const std::vector<Element>& labelled) {
  std::vector<Element> found;
  for (const Element& shape : labelled)
    if (labelOf(shape) == label) found.push_back(shape);
  return found;
}

PiecePtr readReference(const Element& reference, const std::string& label, Diagnostics& diagnostics) {
  const std::vector<Element> labelled = labelledAbove(reference);
  std::vector<Element> originals = definitions(label, labelled);
  if (originals.empty()) originals = definitions(label, labelledInScene(reference));
  if (originals.empty()) {
    std::vector<std::string> labels;
    for (const Element& shape : labelled) labels.push_back(*labelOf(shape));
    diagnostics.error(reference,
                      fmt::format("there is no shape labelled '{}' above{}", label, didYouMean(label, labels)));
    return nullptr;
  }
  const Element& original = originals.front();
  if (originals.size() > 1) {
    diagnostics.error(reference,
                      fmt::format("'{}' is the label of two shapes, at {} and at {}; give them different labels", label,
                                  original.where().text(), originals[1].where().text()));
    return nullptr;
  }
  if (original.name() != reference.name()) {
    diagnostics.error(reference, fmt::format("'{}' is the <{}> at {}, not a <{}>", label, original.name(),
                                             original.where().text(), reference.name()));
    return nullptr;
  }
  Diagnostics toldAlready;
  return findKind(original.name())->read(original, toldAlready);
}

void noteIfTaken(const Element& shape, const std::string& label, Diagnostics& diagnostics) {
  const std::vector<Element> others = definitions(label, labelledAbove(shape));
  if (others.empty()) return;
  diagnostics.note(
      shape, fmt::format("the <{1}> at {2} also has the label '{0}', so no tag can refer to either of them", label,
                         others.front().name(), others.front().where().text()));
}

/// An empty tag that refers to a shape defined above it.
struct Reference {
  std::string label;
};

Schema<Reference> referenceSchema(const std::string& attribute) {
  return Schema<Reference>("label", "Refers to the shape further up that has this label.")
      .requiredAttribute(attribute, &Reference::label, "1", "the label of that shape");
}

std::vector<Alternative> alternativesOf(const std::string& shape) {
  static const Schema<Reference> byName = referenceSchema("name");
  static const Schema<Reference> byLabel =
      referenceSchema("label").foreignAttribute("name", "a synonym of label, which takes precedence");
  return {{findKind(shape)->schema, {}}, {&byLabel, {}}, {&byName, {}}};
}

}  // namespace

std::vector<TagForm> geometryForms() {
  std::vector<TagForm> forms;
  for (const std::string& name : geometryNames())
    forms.push_back(sectionForm({name}, [name] { return alternativesOf(name); }));
  return forms;
}

std::vector<std::string> geometryNames() {
  return {"box", "cylinder",     "sphere",     "cone",      "ellipsoid", "parallelepiped", "torus",       "null",
          "tri", "line_segment", "polyhedron", "smoothcyl", "union",     "difference",     "intersection"};
}

PiecePtr readShape(const Element& shape, Diagnostics& diagnostics) {
  const Kind* kind = findKind(shape.name());
  if (!kind) {
    diagnostics.error(shape, fmt::format("unknown shape <{}>{}; the shapes are: {}", shape.name(),
                                         didYouMean(shape.name(), geometryNames()), listed(geometryNames())));
    return nullptr;
  }
  const auto label = labelOf(shape);
  if (label && isEmpty(shape)) return readReference(shape, *label, diagnostics);
  if (label) noteIfTaken(shape, *label, diagnostics);
  return kind->read(shape, diagnostics);
}

PiecePtr readGeometry(const Element& parent, Diagnostics& diagnostics) {
  const std::vector<Element> shapes = shapesIn(parent);
  if (shapes.empty()) {
    diagnostics.error(parent,
                      fmt::format("<{}> has no shape; the shapes are: {}", parent.name(), listed(geometryNames())));
    return nullptr;
  }
  const std::size_t before = diagnostics.size();
  std::vector<PiecePtr> pieces;
  for (const Element& shape : shapes) pieces.push_back(readShape(shape, diagnostics));
  if (diagnostics.size() != before || !allRead(pieces)) return nullptr;
  return pieces.size() == 1 ? pieces[0] : std::make_shared<Union>(std::move(pieces));
}

void describeGeometry(std::ostream& out, int indent) {
  for (const Kind& kind : kinds()) kind.describe(out, indent);
}

}  // namespace tushar::input
