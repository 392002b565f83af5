#include "components/mpm/solid/loads/load_input.hpp"

#include <fmt/format.h>

#include "core/input/schema.hpp"

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
struct PressureSection {
  std::optional<Surface> surface;
  CurveSection curve;
};
struct LoadsSection {
  std::vector<PressureSection> pressures;
};
struct PhysicalBC {
  LoadsSection mpm;
};

/// A box of a load may be flat, which a body's may not.
const Schema<input::Box>& boxSchema() {
  static const Schema<input::Box> schema = Schema<input::Box>("box", "A flat or thin box.")
                                               .foreignAttribute("label", "its name")
                                               .required("min", &input::Box::min, "m", "lower corner")
                                               .required("max", &input::Box::max, "m", "upper corner");
  return schema;
}

void readSurface(PressureSection& pressure, const Element& parent, Diagnostics& diagnostics) {
  const auto object = parent.child("geom_object");
  const auto shapes = object ? object->children() : std::vector<Element>{};
  if (shapes.size() != 1) return diagnostics.error(parent, "needs one <geom_object> with one shape: where it acts");
  if (shapes[0].name() == "box" && shapes[0].child("min")) {
    pressure.surface = boxSchema().read(shapes[0], diagnostics);
    return;
  }
  const input::PiecePtr piece = input::readShape(shapes[0], diagnostics);
  if (!piece) return;
  if (const auto* cylinder = dynamic_cast<const input::Cylinder*>(piece.get())) pressure.surface = *cylinder;
  if (const auto* sphere = dynamic_cast<const input::Sphere*>(piece.get())) pressure.surface = *sphere;
  if (const auto* box = dynamic_cast<const input::Box*>(piece.get())) pressure.surface = *box;
  if (!pressure.surface)
    diagnostics.error(shapes[0], fmt::format("a pressure acts on a box, cylinder or sphere, not on a <{}>", shapes[0].name()));
}

const Schema<CurveSection>& curveSchema() {
  static const Schema<TimePoint> point = Schema<TimePoint>("time_point", "A load at a time.")
                                             .required("time", &TimePoint::time, "s", "when")
                                             .required("load", &TimePoint::load, "SI unit of the load", "how much");
  static const Schema<CurveSection> schema =
      Schema<CurveSection>("load_curve", "A load over time, straight between its points.")
          .value("id", &CurveSection::id, 1, "1", "its number; loads are counted from 1 as they stand in the scene",
                 input::positive())
          .optional("material", &CurveSection::material, "1", "number of the material that it acts on; else all",
                    input::nonNegative())
          .list("time_point", &CurveSection::points, point, "a load at a time", 1)
          .check([](const CurveSection& curve, const Element& element, Diagnostics& diagnostics) {
            for (std::size_t k = 1; k < curve.points.size(); ++k)
              if (curve.points[k].time <= curve.points[k - 1].time)
                diagnostics.error(element.children("time_point")[k], "its time is not after that of the one before");
          });
  return schema;
}

const Schema<PhysicalBC>& loadsSchema() {
  static const Schema<PressureSection> pressure =
      Schema<PressureSection>("pressure", "Force per area, shared evenly among the particles at a surface of a body.")
          .custom("geom_object", readSurface, {"geom_object"},
                  "a thin box, a cylinder or a sphere: particles along it and at the surface of their body are loaded")
          .requiredSection("load_curve", &PressureSection::curve, curveSchema())
          .ignored("outward_normal", "the sign of the load says where to")
          .ignored("res", "particles are counted");
  static const Schema<LoadsSection> mpm =
      Schema<LoadsSection>("MPM", "Loads on particles.")
          .list("pressure", &LoadsSection::pressures, pressure, "force per area on a surface")
          .check([](const LoadsSection& loads, const Element& element, Diagnostics& diagnostics) {
            if (loads.pressures.size() > 127) diagnostics.error(element, "there can be 127 pressures");
          });
  static const Schema<PhysicalBC> schema =
      Schema<PhysicalBC>("PhysicalBC", "Loads.").requiredSection("MPM", &PhysicalBC::mpm, mpm);
  return schema;
}

}  // namespace

std::vector<PressureLoad> readLoads(const Element& root, Diagnostics& diagnostics) {
  std::vector<PressureLoad> loads;
  const auto section = root.child("PhysicalBC");
  if (!section) return loads;
  for (const PressureSection& read : loadsSchema().read(*section, diagnostics).mpm.pressures) {
    if (!read.surface) continue;
    PressureLoad load;
    load.surface = *read.surface;
    for (const TimePoint& point : read.curve.points) load.curve.points.emplace_back(point.time, point.load);
    load.material = read.curve.material.value_or(-1);
    loads.push_back(load);
  }
  return loads;
}

void describeLoads(std::ostream& out) { loadsSchema().describe(out); }

}  // namespace tushar::mpm::solid
