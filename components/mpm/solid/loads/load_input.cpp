#include "components/mpm/solid/loads/load_input.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/input/refuse.hpp"
#include "core/input/schema.hpp"
#include "core/simulation/by_dimension.hpp"

namespace tushar::mpm::solid {

using input::Diagnostics;
using input::Element;
using input::Schema;

namespace {

struct TimePoint {
  double time = 0, load = 0;
};
struct CurveSection {
  int id = 1;
  std::optional<int> material;
  std::vector<TimePoint> points;
};
struct SurfaceSection {
  Location where;
  std::optional<Surface> surface;
  CurveSection curve;
  std::optional<bool> outwardNormal;
};
struct LoadsSection {
  std::vector<SurfaceSection> pressures, torques, heatFluxes;
  std::vector<BodyLoad> forces;
};
struct PhysicalBC {
  LoadsSection mpm;
};

/// The schema of the box on which a load acts; unlike the box of a body, it may be flat.
const Schema<input::Box>& boxSchema() {
  static const Schema<input::Box> schema = Schema<input::Box>("box", "A flat or thin box.")
                                               .foreignAttribute("label", "name")
                                               .required("min", &input::Box::min, "m", "lower corner")
                                               .required("max", &input::Box::max, "m", "upper corner");
  return schema;
}

void readSurface(SurfaceSection& load, const Element& parent, Diagnostics& diagnostics) {
  load.where = parent.where();
  const auto object = parent.child("geom_object");
  const auto shapes = object ? object->children() : std::vector<Element>{};
  if (object) input::refuseAttributes(*object, {}, diagnostics);
  if (shapes.size() != 1)
    return diagnostics.error(parent, "needs one <geom_object> with one shape, which specifies where the load acts");
  if (shapes[0].name() == "box" && shapes[0].child("min")) {
    load.surface = boxSchema().read(shapes[0], diagnostics);
    return;
  }
  const input::PiecePtr piece = input::readShape(shapes[0], diagnostics);
  if (!piece) return;
  if (const auto* cylinder = dynamic_cast<const input::Cylinder*>(piece.get())) load.surface = *cylinder;
  if (const auto* sphere = dynamic_cast<const input::Sphere*>(piece.get())) load.surface = *sphere;
  if (const auto* box = dynamic_cast<const input::Box*>(piece.get())) load.surface = *box;
  if (!load.surface)
    diagnostics.error(shapes[0],
                      fmt::format("a load acts on a box, cylinder or sphere, not on a <{}>", shapes[0].name()));
}

struct Place {};

/// The schemas of the surfaces that readSurface reads.
std::vector<input::Alternative> placeAlternatives() {
  static const Schema<Place> schema = [] {
    std::vector<input::TagForm> forms;
    for (input::TagForm& form : input::geometryForms()) {
      const std::string& shape = form.tags.front();
      if (shape == "box")
        form.alternatives = [all = form.alternatives] {
          std::vector<input::Alternative> boxes = all();
          boxes.front().schema = &boxSchema();
          return boxes;
        };
      if (shape == "box" || shape == "cylinder" || shape == "sphere") forms.push_back(std::move(form));
    }
    return Schema<Place>("geom_object", "The surface or region on which a load acts.")
        .custom(
            "shape", [](Place&, const Element&, Diagnostics&) {}, {"box", "cylinder", "sphere"}, "one shape")
        .forms(std::move(forms), 1);
  }();
  return {{&schema, {}}};
}

const Schema<CurveSection>& curveSchema() {
  static const Schema<TimePoint> point =
      Schema<TimePoint>("time_point", "The load at one time.")
          .required("time", &TimePoint::time, "s", "time")
          .required("load", &TimePoint::load, "SI unit of the load", "load at this time");
  static const Schema<CurveSection> schema =
      Schema<CurveSection>("load_curve", "A load over time, linear between its points.")
          .value("id", &CurveSection::id, 1, "1", "number of the load, counted from 1 in the order of the scene",
                 input::positive())
          .optional("material", &CurveSection::material, "1",
                    "index of the material on which the load acts; all by default", input::nonNegative())
          .list("time_point", &CurveSection::points, point, "the load at one time", 1)
          .check([](const CurveSection& curve, const Element& element, Diagnostics& diagnostics) {
            input::refuseDescent(curve.points, &TimePoint::time, element.children("time_point"),
                                 "its time is not after that of the previous point", diagnostics);
          });
  return schema;
}

Schema<SurfaceSection> surfaceSchema(const std::string& name, const std::string& sentence) {
  return Schema<SurfaceSection>(name, sentence)
      .custom("geom_object", readSurface, {"geom_object"},
              "a thin box, a cylinder or a sphere: the load acts on particles along its surface that are also at the "
              "surface of their body")
      .forms({input::onceForm("geom_object", placeAlternatives, 1)})
      .requiredSection("load_curve", &SurfaceSection::curve, curveSchema())
      .optional("outward_normal", &SurfaceSection::outwardNormal, "1",
                "needed for a pressure with <use_CBDI_boundary_condition>. true: it acts on the faces of particles on "
                "the side of the outward normal of the shape; false: on the opposite faces. Without "
                "<use_CBDI_boundary_condition>, the sign of the load determines its direction")
      .ignored("res", "the number of loaded particles is determined automatically");
}

/// Checks that the number of a load curve is the position of its load in the scene, because Uintah uses the two
/// interchangeably.
void checkNumbers(const Element& loads, Diagnostics& diagnostics) {
  int place = 0;
  for (const Element& load : loads.children()) {
    ++place;
    const auto curve = load.child("load_curve"), id = curve ? curve->child("id") : std::nullopt;
    if (id && input::parse<int>(id->text()).value != place)
      diagnostics.error(
          *id, fmt::format("found '{}', expected {}: loads are numbered in the order of the scene", id->text(), place));
  }
}

const Schema<PhysicalBC>& loadsSchema() {
  static const Schema<SurfaceSection> pressure =
      surfaceSchema("pressure",
                    "Force per area, distributed evenly over the particles at a surface of a body. They share the "
                    "force on the whole shape, even if the body has only a part of its surface.");
  static const Schema<SurfaceSection> torque =
      surfaceSchema("torque",
                    "A torque about the axis of a cylinder, distributed evenly over the particles at its side.")
          .check([](const SurfaceSection& read, const Element& element, Diagnostics& diagnostics) {
            if (read.surface && !std::holds_alternative<input::Cylinder>(*read.surface))
              diagnostics.error(element, "a torque acts only on the side of a <cylinder>");
          });
  static const Schema<SurfaceSection> heatFlux = surfaceSchema(
      "heat_flux", "Heat per area and time, distributed evenly over the particles at a surface of a body.");
  static const Schema<BodyLoad> force =
      Schema<BodyLoad>("force", "A force on the particles that start in a box, or within one particle spacing of it.")
          .required("lower", &BodyLoad::lower, "m", "lower corner of the box")
          .required("upper", &BodyLoad::upper, "m", "upper corner of the box")
          .required("force_density", &BodyLoad::forceDensity, "N/kg", "force per mass");
  static const Schema<LoadsSection> mpm = [] {
    Schema<LoadsSection> loads("MPM", "Loads on particles.");
    loads.list("pressure", &LoadsSection::pressures, pressure, "force per area on a surface")
        .list("torque", &LoadsSection::torques, torque,
              "torque, N m; a positive one drives a right-handed screw from the top of the cylinder to its bottom, as "
              "in Uintah")
        .list("heat_flux", &LoadsSection::heatFluxes, heatFlux,
              "heat per area and time into the body through a surface")
        .list("force", &LoadsSection::forces, force, "force per mass, at all times")
        .check([](const LoadsSection& read, const Element& element, Diagnostics& diagnostics) {
          checkNumbers(element, diagnostics);
          if (read.pressures.size() + read.torques.size() + read.heatFluxes.size() + read.forces.size() > 127)
            diagnostics.error(element, "there can be at most 127 loads");
        });
    refuseTag(loads, "pressure_pts", "use pressure, torque, force or heat_flux");
    for (const char* tag : {"arches_heat_flux", "scalar_flux"}) refuseTag(loads, tag, "use heat_flux");
    return loads;
  }();
  static const Schema<PhysicalBC> schema =
      Schema<PhysicalBC>("PhysicalBC", "Loads.").requiredSection("MPM", &PhysicalBC::mpm, mpm);
  return schema;
}

}  // namespace

namespace {

/// The tags of loads with a name.
std::vector<Element> tagsOf(const Element& root, std::string_view name) {
  const auto section = root.child("PhysicalBC"), mpm = section ? section->child("MPM") : std::nullopt;
  return mpm ? mpm->children(name) : std::vector<Element>{};
}

void noteUnusedCurves(const Element& root, Diagnostics& diagnostics) {
  for (const char* name : {"pressure", "torque", "heat_flux"})
    for (const Element& tag : tagsOf(root, name))
      diagnostics.note(tag, "has no effect without <use_load_curves> true in <MPM>, as in Uintah");
}

/// Refuses surfaces that are not symmetric about the axis, and adds notes on those whose area is not per radian.
void checkAroundAxis(const Element& tag, const SurfaceSection& load, Diagnostics& diagnostics) {
  if (const auto* sphere = std::get_if<input::Sphere>(&*load.surface); sphere && sphere->origin[0] != 0)
    diagnostics.error(tag, fmt::format("sphere: its centre is at x = {:g} m; with <axisymmetric> it must lie on the "
                                       "axis, x = 0",
                                       sphere->origin[0]));
  const auto* cylinder = std::get_if<input::Cylinder>(&*load.surface);
  if (cylinder && !cylinder->axisymmetricEnd && !cylinder->axisymmetricSide)
    diagnostics.note(tag, cylinder->cylinderEnd
                              ? "cylinder_end: the load of the whole end, pi R^2, acts on one radian, as in Uintah: 2 "
                                "pi times as much as its part; <axisymmetric_end> takes R^2 / 2"
                              : "cylinder: the load of the whole circumference acts on one radian, as in Uintah: 2 pi "
                                "times as much as its part; <axisymmetric_side> takes a radian of it");
}

}  // namespace

Loads readLoads(const Element& root, const LoadSwitches& switches, Diagnostics& diagnostics) {
  Loads loads;
  const LoadsSection read = simulation::readOptionalSection(root, loadsSchema(), diagnostics).mpm;
  loads.bodies = read.forces;
  const std::vector<Element> forces = tagsOf(root, "force");
  for (std::size_t k = 0; k < std::min(forces.size(), loads.bodies.size()); ++k)
    loads.bodies[k].where = forces[k].where();
  if (!switches.usesCurves) {
    noteUnusedCurves(root, diagnostics);
    return loads;
  }
  const auto add = [&](const std::vector<SurfaceSection>& sections, const char* name, SurfaceLoad::Kind kind) {
    const std::vector<Element> tags = tagsOf(root, name);
    for (std::size_t k = 0; k < std::min(tags.size(), sections.size()); ++k) {
      const SurfaceSection& one = sections[k];
      if (!one.surface) continue;
      if (switches.aroundAxis && kind != LoadKind::torque) checkAroundAxis(tags[k], one, diagnostics);
      SurfaceLoad load{kind, *one.surface, {}, one.curve.material.value_or(-1), one.where};
      load.outwardNormal = one.outwardNormal.value_or(true);
      load.aroundAxis = switches.aroundAxis;
      for (const TimePoint& point : one.curve.points) load.curve.points.emplace_back(point.time, point.load);
      loads.surfaces.push_back(load);
    }
  };
  add(read.pressures, "pressure", LoadKind::pressure);
  add(read.torques, "torque", LoadKind::torque);
  add(read.heatFluxes, "heat_flux", LoadKind::heatFlux);
  return loads;
}

void describeLoads(std::ostream& out) { loadsSchema().describe(out); }
const input::SchemaBase& loadsForm() { return loadsSchema(); }

}  // namespace tushar::mpm::solid
