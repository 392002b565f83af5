#include "components/euler/tasks/advance_patch.hpp"

namespace tushar::euler {

template Advance<1> chooseAdvance<1>(const Method&, const Gas&);

}  // namespace tushar::euler
