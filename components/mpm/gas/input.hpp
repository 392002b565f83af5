#pragma once

#include "components/mpm/mpm.hpp"

namespace tushar::mpm::gas {

/// Describes the gas methods of the component mpm.
MethodKind kind();

}  // namespace tushar::mpm::gas
