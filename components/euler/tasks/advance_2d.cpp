#include "components/euler/tasks/advance_patch.hpp"

namespace tushar::euler {

template Advance<2> chooseAdvance<2>(const Method&, const Gas&);

}  // namespace tushar::euler
