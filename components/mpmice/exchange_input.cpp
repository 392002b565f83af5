#include "components/mpmice/exchange_input.hpp"

#include <fmt/format.h>

namespace tushar::mpmice {

using input::Diagnostics;
using input::Element;

namespace {

/// Calls `visit(body, gas, value)` for each pair of a body and a gas; `pairs` is a matrix of Uintah, which contains all
/// pairs row by row.
template <class Visit>
void forEachPairWithGas(const std::vector<double>& pairs, int solids, int gases, Visit&& visit) {
  std::size_t at = 0;
  for (int row = 0; row < solids; ++row)
    for (int column = row + 1; column < solids + gases; ++column, ++at)
      if (column >= solids) visit(row, column - solids, pairs[at]);
}

/// Whether a list has one number for each pair of materials; reports an error otherwise.
bool hasAllPairs(const std::vector<double>& given, const char* name, int materials, const Element& tag,
                 Diagnostics& diagnostics) {
  const std::size_t pairs = static_cast<std::size_t>(materials) * (materials - 1) / 2;
  if (given.size() == pairs) return true;
  diagnostics.error(
      tag.child(name).value_or(tag),
      fmt::format("found {} numbers, expected {}: one for each pair of {} materials", given.size(), pairs, materials));
  return false;
}

/// The coefficient of momentum exchange from which bodies are walls along which gas slips [kg/(m³ s)].
constexpr double onlyWalls = 1e9;

/// Notes what coefficients of momentum exchange do between a body and a gas that are less than walls need.
void noteDrag(int body, double k, const Element& tag, Diagnostics& diagnostics) {
  const std::string drag =
      k > 0 ? fmt::format(
                  "that drag it along, with {:g} h / 4 times the relative velocity per area; from {:g} on, gas "
                  "slips along walls",
                  k, onlyWalls)
            : "along which it slips, all the same";
  diagnostics.note(tag, fmt::format("{:g}: body {} consists of walls to the gas, {}", k, body, drag));
}

/// Returns what the coefficients of momentum exchange do. Bodies are walls to the gas, whatever they are; coefficients
/// below those of walls drag the gas along. Between bodies, only contacts act.
Drag dragOf(const ice::GasScene& scene, int solids, bool areRigid, const Element& root, const Element& tag,
            Diagnostics& diagnostics) {
  const std::vector<double>& momentum = scene.exchange->momentum;
  const std::size_t count = std::max<std::size_t>(1, scene.mixture.size());
  const auto given = tag.child("momentum");
  if (!given || !input::parse<std::vector<double>>(given->text()).value) return {};  // absent, or already refused
  if (!hasAllPairs(momentum, "momentum", solids + static_cast<int>(count), tag, diagnostics)) return {};
  Drag drag{std::vector(count, std::vector<double>(static_cast<std::size_t>(solids), 0.0))};
  forEachPairWithGas(momentum, solids, static_cast<int>(count), [&](int body, int gas, double k) {
    if (k >= onlyWalls || (areRigid && k == 0)) return;
    noteDrag(body, k, *given, diagnostics);
    drag.ofGases[static_cast<std::size_t>(gas)][static_cast<std::size_t>(body)] = k;
  });
  if (solids > 1)
    diagnostics.note(*given, root.child("MaterialProperties")->child("MPM")->child("contact")
                                 ? "does nothing between bodies: they interact through their <contact>"
                                 : "does nothing between bodies: they interact through their <contact>, and pass "
                                   "through each other, as there is none");
  if (!drag.acts()) return {};
  return drag;
}

/// The coefficients of heat exchange; none if the scene does not give one for each pair, or if a body has no specific
/// heat.
ice::HeatCoefficients heatOf(const ice::Exchange& exchange, int solids, int gases, const Element& root,
                             const Element& tag, Diagnostics& diagnostics) {
  ice::HeatCoefficients heat = exchange.heatCoefficients();
  if (!heat.pairs.empty() && !hasAllPairs(heat.pairs, "heat", solids + gases, tag, diagnostics)) return {};
  if (!heat.act()) return {};
  for (const Element& material : root.child("MaterialProperties")->child("MPM")->children("material"))
    if (!material.child("specific_heat"))
      diagnostics.error(material, "missing tag <specific_heat>: the body exchanges heat");
  return heat;
}

/// The body and the gas of do_convective_heat_transfer, if a scene has it.
std::optional<Convection> convectionOf(const ice::Exchange& exchange, int solids, int gases, const Element& properties,
                                       Diagnostics& diagnostics) {
  if (!exchange.convects) return {};
  const auto isAmong = [&](const char* tag, int number, int first, int count, const char* kind) {
    if (number >= first && number < first + count) return true;
    diagnostics.error(*properties.child(tag),
                      fmt::format("found {}, expected a {}: {} to {}", number, kind, first, first + count - 1));
    return false;
  };
  const bool isGas = isAmong("convective_fluid", *exchange.fluid, solids, gases, "gas");
  if (!isAmong("convective_solid", *exchange.solid, 0, solids, "body") || !isGas) return {};
  const Convection one{.body = *exchange.solid, .gas = *exchange.fluid - solids};
  const auto all = static_cast<std::size_t>(solids + gases) * static_cast<std::size_t>(solids + gases - 1) / 2;
  const Element where = *properties.child("do_convective_heat_transfer");
  if (exchange.heatByMasses || exchange.heat.size() != all) return one;  // the latter is already refused
  forEachPairWithGas(exchange.heat, solids, gases, [&](int body, int gas, double h) {
    if (body == one.body && gas == one.gas && h == 0)
      diagnostics.note(where, "does nothing: the coefficient of heat exchange of the two is 0");
  });
  return one;
}

}  // namespace

void readExchange(const ice::GasScene& scene, int solids, const Element& root, Settings& settings,
                  Diagnostics& diagnostics) {
  const Element properties = *root.child("MaterialProperties")->child("exchange_properties");
  const Element tag = *properties.child("exchange_coefficients");
  const int gases = std::max<int>(1, static_cast<int>(scene.mixture.size()));
  settings.drag = dragOf(scene, solids, settings.areRigid, root, tag, diagnostics);
  settings.heat = heatOf(*scene.exchange, solids, gases, root, tag, diagnostics);
  settings.convection = convectionOf(*scene.exchange, solids, gases, properties, diagnostics);
}

}  // namespace tushar::mpmice
