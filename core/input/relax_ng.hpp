#pragma once

#include <ostream>
#include <string>

#include "core/input/tag_form.hpp"

namespace tushar::input {

/// Writes a schema for files whose outermost tag is `root`, in RELAX NG's XML syntax (ISO/IEC 19757-2), so that editors
/// can complete and check such files. The written schema accepts everything that the schemas of `root` read; further
/// checks, such as limits, are left to sus. `comment` is written at the top.
void writeRelaxNg(std::ostream& out, const TagForm& root, const std::string& comment);

}  // namespace tushar::input
