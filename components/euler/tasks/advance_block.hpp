#pragma once

#include "components/euler/tasks/block_instances.hpp"

namespace tushar::euler {

// Steps of blocks with HLLC's flux, for components that are built from `euler`; `euler` compiles them.
TUSHAR_BLOCK_INSTANCES(extern, 1)
TUSHAR_BLOCK_INSTANCES(extern, 2)
TUSHAR_BLOCK_INSTANCES(extern, 3)

}  // namespace tushar::euler
