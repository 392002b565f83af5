#pragma once

#include <ostream>
#include <string>

#include "core/input/tag_form.hpp"

namespace tushar::input {

/// Writes a schema in RELAX NG's XML syntax (ISO/IEC 19757-2) of the files whose outermost tag is `root`, so that
/// editors complete and check them. It accepts all that the schemas of `root` read; what they check beyond one value or
/// tag, such as limits, it leaves open. `comment` goes to its top.
void writeRelaxNg(std::ostream& out, const TagForm& root, const std::string& comment);

}  // namespace tushar::input
