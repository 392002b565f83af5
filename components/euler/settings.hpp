#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "components/euler/courant.hpp"
#include "components/euler/gas.hpp"
#include "core/base/error.hpp"
#include "core/input/expression.hpp"
#include "core/input/geometry.hpp"

namespace tushar::euler {

/// The initial gas in a region; it may vary in space.
struct GasObject {
  Location where;  ///< in the scene
  std::shared_ptr<const input::GeometryPiece> shape;
  input::Expression density;                          ///< density [kg/m³]
  input::Expression pressure;                         ///< pressure [Pa]; ignored if a temperature is given
  input::VectorExpression velocity;                   ///< velocity [m/s]
  std::optional<input::Expression> temperature = {};  ///< temperature [K]
  std::optional<input::Expression> share = {};        ///< volume fraction, if there are several gases; 1 by default
  /// Number of points of a cell along each axis at which regions of several gases are found.
  Index3 points = Index3::filled(1);
};

enum class FluxKind { exact, hllc };
enum class Reconstruction { firstOrder, musclHancock };
enum class Limiter { minmod, vanLeer, mc };

/// The numerical method.
struct Method {
  FluxKind flux = FluxKind::hllc;
  Reconstruction reconstruction = Reconstruction::musclHancock;
  Limiter limiter = Limiter::vanLeer;
};

class BlendLaws;

/// The `Euler` section.
struct Settings {
  Location where;                 ///< in the scene
  std::string section = "Euler";  ///< path of the section with the objects
  std::string name = {};          ///< name of the gas
  Method method;
  /// Whether objects may contain no cell centre; true if they are parts into which an object of the scene was divided.
  bool objectsMayBeEmpty = false;
  Courant courant = {};
  Gas gas;
  /// The laws of all gases that share cells with this one, if one of them has its own law; otherwise null.
  std::shared_ptr<const BlendLaws> blend = nullptr;
  std::vector<GasObject> objects;  ///< regions with their initial gas; where they overlap, the last one applies
  /// Changes the initial velocity and, for objects with a temperature, the initial temperature at a point with the
  /// density `rho`.
  std::function<void(const Vec3& point, double rho, Vec3& velocity, double& temperature)> disturb = {};
};

}  // namespace tushar::euler
