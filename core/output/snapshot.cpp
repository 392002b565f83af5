#include "core/output/snapshot.hpp"

namespace tushar::output {

void load(Array& array) {
  if (!array.source) return;
  const std::size_t entries = array.entries();
  std::visit(
      [&](auto& values) {
        values.resize(entries * array.components);
        array.source->read(0, entries, reinterpret_cast<std::byte*>(values.data()));
      },
      array.values);
  array.source.reset();
}

}  // namespace tushar::output
