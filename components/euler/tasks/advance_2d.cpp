#include "components/euler/tasks/advance_block.hpp"

namespace tushar::euler {

template Advance<2> chooseAdvance<2>(const Method&, const Gas&);
TUSHAR_BLOCK_INSTANCES(, 2)
TUSHAR_REFUSE_STATES(, 2)

}  // namespace tushar::euler
