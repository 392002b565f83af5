#include "core/data/views.hpp"

namespace tushar::data {

namespace {
std::string_view nameOf(const Label* label) { return label ? label->name : std::string_view("a view"); }
}  // namespace

void refuse(const Label* label, const Index3& index, const grid::Box& box) {
  throw AccessError(
      fmt::format("{} was accessed at ({},{},{}), outside the box ({},{},{}) to ({},{},{}) that the task declared; "
                  "declare more ghosts, or stay inside the box",
                  nameOf(label), index[0], index[1], index[2], box.lower[0], box.lower[1], box.lower[2],
                  box.upper[0] - 1, box.upper[1] - 1, box.upper[2] - 1));
}

void refuse(const Label* label, int particle, int count) {
  throw AccessError(
      fmt::format("{} was accessed for particle {}, but the patch has {} particles, and no ghost with this index",
                  nameOf(label), particle, count));
}

}  // namespace tushar::data
