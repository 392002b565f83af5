#pragma once

#include "components/ice/gas_schemas.hpp"
#include "components/ice/heating.hpp"

namespace tushar::ice {

/// The heating of `gases` gases, whose indices follow those of `solids` bodies. Reports materials that are not gases or
/// are given twice, lists of different lengths, and times in the wrong order.
Heating heatingOf(const HeatingSection& read, int solids, std::size_t gases, input::Diagnostics& diagnostics);

}  // namespace tushar::ice
