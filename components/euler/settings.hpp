#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "components/euler/gas.hpp"
#include "core/base/error.hpp"
#include "core/input/expression.hpp"
#include "core/input/geometry.hpp"

namespace tushar::euler {

/// The gas of a region at the start, which may vary in space.
struct GasObject {
  Location where;  ///< in the scene
  std::shared_ptr<const input::GeometryPiece> shape;
  input::Expression density;                          ///< kg/m³
  input::Expression pressure;                         ///< Pa; ignored if there is a temperature
  input::VectorExpression velocity;                   ///< m/s
  std::optional<input::Expression> temperature = {};  ///< K
  std::optional<input::Expression> share = {};        ///< volume fraction, if there are several gases; 1 by default
};

enum class FluxKind { exact, hllc };
enum class Reconstruction { firstOrder, musclHancock };
enum class Limiter { minmod, vanLeer, mc };

/// The choices of the method.
struct Method {
  FluxKind flux = FluxKind::hllc;
  Reconstruction reconstruction = Reconstruction::musclHancock;
  Limiter limiter = Limiter::vanLeer;
};

/// The `Euler` section.
struct Settings {
  Location where;                 ///< in the scene
  std::string section = "Euler";  ///< path of the section with the objects
  std::string name = {};          ///< name of the gas
  Method method;
  bool objectsMayBeEmpty = false;  ///< whether objects may contain no cell centre, as parts of what the scene has
  double cfl = 0.8;                ///< dt max(sum_d (|v_d| + c) / h_d)
  Gas gas;
  std::vector<GasObject> objects;  ///< where they overlap, the last one applies
  /// Changes the velocity and, for objects that have one, the temperature at the start, at a point with the density
  /// `rho`.
  std::function<void(const Vec3& point, double rho, Vec3& velocity, double& temperature)> disturb = {};
};

}  // namespace tushar::euler
