#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <string>
#include <vector>

#include "components/components.hpp"
#include "core/collect/gather.hpp"
#include "core/scene/scene.hpp"
#include "core/simulation/simulation.hpp"
#include "tests/support/temporary.hpp"

namespace tushar::mpm::gas {

/// A scene with one gas, run to its end.
class GasScene {
 public:
  explicit GasScene(const std::string& scene) : run_(read(scene), quiet(), std::chrono::steady_clock::now()) {
    EXPECT_EQ(run_.run().failure, "");
  }
  /// Returns the values of the particles one after another; vectors as x, y, z.
  std::vector<double> values(const char* label) {
    data::Warehouse& warehouse = run_.warehouse();
    const auto array = collect::Gather(warehouse).array(data::Generation::old, warehouse.table().find(label, 0));
    return std::get<std::vector<double>>(array.values);
  }

 private:
  static simulation::Problem read(const std::string& scene) {
    const std::string path = test::temporaryFolder() + "scene.ups";
    std::ofstream(path) << scene;
    return scene::readScene(path, {}, catalogue());
  }
  static simulation::RunOptions quiet() {
    simulation::RunOptions options;
    options.quiet = true;
    return options;
  }

  simulation::Simulation run_;
};

/// Returns the tags of symmetry planes all around a grid.
inline std::string walls() {
  std::string faces;
  for (const char* side : {"x-", "x+", "y-", "y+", "z-", "z+"})
    faces += std::string("<Face side='") + side + "'><BCType id='all' label='Symmetric' var='symmetry'/></Face>";
  return "<BoundaryConditions>" + faces + "</BoundaryConditions>";
}

}  // namespace tushar::mpm::gas
