#include <fmt/format.h>

#include "components/ice/gas_schemas.hpp"

// The tag dynamicViscosityModels: a viscosity that depends on the temperature or on the position.

namespace tushar::ice {

using input::Diagnostics;
using input::Element;
using input::Schema;

namespace {

const Schema<euler::Sutherland>& sutherlandSchema() {
  using euler::Sutherland;
  static const Schema<Sutherland> schema =
      Schema<Sutherland>("Model", "name=\"Sutherland\": mu = a T^(3/2) / (T + b).")
          .foreignAttribute("name", "Sutherland")
          .required("a", &Sutherland::a, "Pa s / K^(1/2)", "the factor a", input::nonNegative())
          .required("b", &Sutherland::b, "K", "the temperature b", input::nonNegative());
  return schema;
}

/// The box of a sponge layer, as written in the scene, and the layer.
struct SpongeBox {
  Vec3 min = Vec3::Zero(), max = Vec3::Zero();
};
struct SpongeTag {
  double viscosity = 0;
  SpongeBox box;
};

const Schema<SpongeTag>& spongeSchema() {
  static const Schema<SpongeBox> box = Schema<SpongeBox>("box", "The box of the layer.")
                                           .ignoredAttribute("label", "a note for readers")
                                           .required("min", &SpongeBox::min, "m", "a corner")
                                           .required("max", &SpongeBox::max, "m", "the opposite corner");
  static const Schema<SpongeTag> schema =
      Schema<SpongeTag>("Model", "name=\"SpongeLayer\": a box with its own viscosity, which absorbs waves.")
          .foreignAttribute("name", "SpongeLayer")
          .required("maxDynamicViscosity", &SpongeTag::viscosity, "Pa s", "the viscosity in the box",
                    input::nonNegative())
          .requiredSection("box", &SpongeTag::box, box);
  return schema;
}

void readOne(euler::VaryingDiffusion& varying, const Element& model, Diagnostics& diagnostics) {
  const std::string name = model.attribute("name").value_or("");
  if (name == "Sutherland") {
    if (varying.sutherland || !varying.sponges.empty())
      return diagnostics.error(model, "give Sutherland once, and before any SpongeLayer");
    varying.sutherland = sutherlandSchema().read(model, diagnostics);
  } else if (name == "SpongeLayer") {
    const SpongeTag read = spongeSchema().read(model, diagnostics);
    if (!(read.box.min.array() < read.box.max.array()).all())
      return diagnostics.error(
          model, "the <box> is empty: each number of <min> must be less than the corresponding one of <max>");
    varying.sponges.push_back({read.box.min, read.box.max, read.viscosity});
  } else {
    diagnostics.error(model, fmt::format("name: {}", input::choiceProblem(name, {"Sutherland", "SpongeLayer"})));
  }
}

}  // namespace

void readViscosityModels(euler::VaryingDiffusion& varying, const Element& material, Diagnostics& diagnostics) {
  const auto models = material.child("dynamicViscosityModels");
  if (!models) return;
  if (models->children().empty()) diagnostics.error(*models, "is empty: it needs at least one Model");
  for (const Element& model : models->children())
    if (model.name() == "Model")
      readOne(varying, model, diagnostics);
    else
      diagnostics.error(model,
                        fmt::format("unknown tag <{}> in <dynamicViscosityModels>; allowed here: Model", model.name()));
}

void describeViscosityModels(std::ostream& out, int indent) {
  sutherlandSchema().describe(out, indent);
  spongeSchema().describe(out, indent);
}

}  // namespace tushar::ice
