#pragma once

#include <ostream>
#include <string>

#include "core/input/tag_form.hpp"

namespace tushar::input {

/// Writes an XML Schema (XSD 1.0) of the files whose outermost tag is `root`. It cannot have tags in any order of which
/// some may repeat and some must be there, nor tags whose contents depend on an attribute: all tags are optional and
/// may repeat, and a tag may hold what any of its kinds may. `comment` goes to its top.
void writeXmlSchema(std::ostream& out, const TagForm& root, const std::string& comment);

}  // namespace tushar::input
