#include "components/euler/tasks/advance_block.hpp"

namespace tushar::euler {

template Advance<3> chooseAdvance<3>(const Method&, const Gas&);
TUSHAR_BLOCK_INSTANCES(, 3)
TUSHAR_REFUSE_STATES(, 3)

}  // namespace tushar::euler
