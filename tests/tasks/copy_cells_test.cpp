#include "core/tasks/copy_cells.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace tushar::tasks {

TEST(CopyCells, CopiesABoxAndNothingElse) {
  const grid::Box from{{{0, 0, 0}}, {{9, 7, 5}}}, to{{{8, -3, 1}}, {{18, 6, 6}}};
  const Index3 shift{{9, -2, 1}};
  for (const std::size_t bytes : {1u, 4u, 8u, 16u, 24u, 72u})
    for (const int width : {0, 1, 2, 3, 4, 6, 8})
      for (const Index3& rest : {Index3{{0, 1, 1}}, Index3{{0, 4, 3}}}) {
        const grid::Box box{{{9, -1, 2}}, {{9 + width, -1 + rest[1], 2 + rest[2]}}};
        std::vector<std::byte> source(from.size() * bytes), target(to.size() * bytes, std::byte{255});
        for (std::size_t k = 0; k < source.size(); ++k) source[k] = static_cast<std::byte>(k % 251);
        copyCells(box, shift, bytes, {source.data(), from}, {target.data(), to});

        grid::forEach<3>(to, [&](const Index3& cell) {
          for (std::size_t byte = 0; byte < bytes; ++byte) {
            const std::byte found = target[to.offset(cell) * bytes + byte];
            const bool isCopied = box.contains(cell);
            const std::byte expected = isCopied ? source[from.offset(cell - shift) * bytes + byte] : std::byte{255};
            ASSERT_EQ(found, expected) << bytes << ' ' << width << ' ' << cell[0] << ' ' << cell[1] << ' ' << cell[2];
          }
        });
      }
}

}  // namespace tushar::tasks
