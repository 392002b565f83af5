#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "core/base/vec.hpp"

namespace tushar::output {

struct Array {
  std::string label, unit, description;
  int components = 1;
  std::variant<std::vector<double>, std::vector<std::uint64_t>, std::vector<std::int32_t>> values;
};
struct ParticleBlock {
  std::string material;
  int materialIndex = 0;
  std::vector<Array> arrays;
};
enum class Centring { cell, node };
struct FieldBlock {
  Centring centring = Centring::cell;
  std::string material;
  int materialIndex = -1;
  Array array;
};
struct GridInfo {
  Vec3 lower, spacing;
  Index3 cells;
  int dimension = 0;
};
struct Snapshot {
  int step = 0;
  double time = 0, delT = 0;
  GridInfo grid;
  std::vector<ParticleBlock> particles;
  std::vector<FieldBlock> fields;
  std::vector<Array> reference;
};

}  // namespace tushar::output
