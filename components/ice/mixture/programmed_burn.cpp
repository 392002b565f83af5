#include "components/ice/mixture/programmed_burn.hpp"

namespace tushar::ice {

const input::Schema<ProgrammedBurn>& programmedBurnSchema() {
  static const input::Schema<ProgrammedBurn> schema =
      input::Schema<ProgrammedBurn>("LightTime", "A detonation runs through a gas at a given speed.")
          .location(&ProgrammedBurn::where)
          .required("fromMaterial", &ProgrammedBurn::from, "1", "the gas that burns")
          .required("toMaterial", &ProgrammedBurn::to, "1", "the gas that it becomes")
          .required("D", &ProgrammedBurn::speed, "m/s", "speed of the detonation", input::positive())
          .required("E0", &ProgrammedBurn::heat, "J/kg", "heat of the reaction")
          .required("starting_location", &ProgrammedBurn::start, "m", "the point at which the detonation begins")
          .required("direction_if_plane", &ProgrammedBurn::direction, "1",
                    "normal of the plane from which the detonation runs; [0,0,0]: it runs from the point")
          .value("react_mixed_cells", &ProgrammedBurn::burnsInMixedCells, true, "1",
                 "whether cells burn even if the two gases fill at most .99 of their volume")
          .ignored("AMR_Refinement_Criteria",
                   "a <Variable> in <Refinement_Criteria_Thresholds> determines where cells are finer");
  return schema;
}

}  // namespace tushar::ice
