#pragma once

#include <cstddef>
#include <stdexcept>
#include <string_view>

#include "core/base/vec.hpp"
#include "core/data/bound.hpp"
#include "core/data/reduction_slot.hpp"

namespace tushar::data {

/// The entities on which a variable has values. Fluxes live on rims: the faces of a patch beyond which another level
/// begins.
enum class Centring { particle, node, cell, rim, reduction };

/// The type in which a number of a variable is stored.
enum class Number { real, id, integer };

/// The nodes on which the values of a node variable are defined: all nodes, or only those that particles of its
/// material touch. In the second case, patches exchange only the touched nodes (see tasks/near_rows); the values on
/// other nodes are undefined, and may differ between patches; if the variable is saved, they are 0.
enum class Counts { everywhere, nearParticles };

/// The properties of a variable of any type that the graph, the archive and messages to users need. Two labels with the
/// same name are the same variable.
struct Label {
  std::string_view name;         ///< the name in .ups and .uda: `p.mass`, `g.velocity`
  std::string_view unit;         ///< SI unit; `1` for dimensionless values
  std::string_view description;  ///< a short description
  Centring centring;
  Number number;
  int components;     ///< number of components per particle, node or cell
  std::size_t bytes;  ///< size of a value per particle, node or cell [bytes]
  bool isVector;      ///< whether the components belong to the kernel axes
  Bound bound;        ///< checked after every task that writes the variable; a violation ends the run or the step
  MakeReduction makeReduction = nullptr;  ///< creates the reduction; only for reduction labels
  Counts counts = Counts::everywhere;
};

/// How a type is stored in a variable.
template <class T>
struct Stored;
template <>
struct Stored<double> {
  static constexpr Number number = Number::real;
  static constexpr int components = 1;
  static constexpr bool isVector = false;
};
template <>
struct Stored<ParticleId> {
  static constexpr Number number = Number::id;
  static constexpr int components = 1;
  static constexpr bool isVector = false;
};
template <>
struct Stored<int> {
  static constexpr Number number = Number::integer;
  static constexpr int components = 1;
  static constexpr bool isVector = false;
};
/// Matrices with one column are vectors along the kernel axes. Matrices with several columns, such as tensors, are
/// stored as they are in memory: row by row.
template <int Rows, int Columns, int Options>
struct Stored<Eigen::Matrix<double, Rows, Columns, Options>> {
  static constexpr Number number = Number::real;
  static constexpr int components = Rows * Columns;
  static constexpr bool isVector = Columns == 1;
};

template <Centring C, class T>
struct FieldLabel : Label {
  using Value = T;
  static constexpr Centring centred = C;
  constexpr FieldLabel(std::string_view called, std::string_view inUnit, std::string_view meaning,
                       Bound bounded = Bound::none)
      : Label{called,  inUnit, meaning, C, Stored<T>::number, Stored<T>::components, sizeof(T), Stored<T>::isVector,
              bounded, nullptr} {
    if (bounded != Bound::none && Stored<T>::number != Number::real)
      throw std::invalid_argument("only real numbers have bounds");
    if (!called.starts_with(prefix())) throw std::invalid_argument("the name of a label must start with p., g. or c.");
  }
  constexpr FieldLabel(std::string_view called, std::string_view inUnit, std::string_view meaning, Counts where)
      : FieldLabel(called, inUnit, meaning) {
    if (C != Centring::node) throw std::invalid_argument("Counts::nearParticles is only for node labels");
    counts = where;
  }
  /// Sets the number of values of T that are stored for each particle, node or cell.
  constexpr void setCount(int count) {
    components = count * Stored<T>::components;
    bytes = count * sizeof(T);
  }
  /// The prefix of the names of labels with this centring, as in Uintah: p. for particles, g. for grid nodes, c. for
  /// cells.
  static constexpr std::string_view prefix() {
    return C == Centring::particle ? "p." : C == Centring::node ? "g." : "c.";
  }
};

/// The label of a variable with one T per particle, node or cell.
template <class T>
using ParticleLabel = FieldLabel<Centring::particle, T>;
template <class T>
using NodeLabel = FieldLabel<Centring::node, T>;
template <class T>
using CellLabel = FieldLabel<Centring::cell, T>;

/// The label of one value for the whole grid, combined from all patches by a reducer R (see reduction.hpp).
template <class R>
struct ReductionLabel : Label {
  using Reducer = R;
  constexpr ReductionLabel(std::string_view called, std::string_view inUnit, std::string_view meaning)
      : Label{called, inUnit,    meaning, Centring::reduction, Number::real,
              1,      sizeof(R), false,   Bound::none,         &data::makeReduction<R>} {}
};

/// The name of the label of particle positions. The positions of ghosts that are periodic images are shifted by the
/// period.
inline constexpr std::string_view positionName = "p.x";

/// The label of the id of a particle; the framework stores an id for each particle.
inline constexpr ParticleLabel<ParticleId> particleId{"p.particleID", "1",
                                                      "identifier of the particle, which never changes"};

}  // namespace tushar::data
