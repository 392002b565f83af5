#include "components/euler/tasks/advance_block.hpp"

namespace tushar::euler {

template Advance<1> chooseAdvance<1>(const Method&, const Gas&);
TUSHAR_BLOCK_INSTANCES(, 1)
TUSHAR_REFUSE_STATES(, 1)

}  // namespace tushar::euler
