#include "components/euler/tasks/advance_patch.hpp"

namespace tushar::euler {

template Advance<3> chooseAdvance<3>(const Method&, const Gas&);

}  // namespace tushar::euler
