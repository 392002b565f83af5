#pragma once

#include <ostream>
#include <string>

#include "core/input/tag_form.hpp"

namespace tushar::input {

/// Writes an XML Schema (XSD 1.0) for files whose outermost tag is `root`. XSD 1.0 has no means to describe tags in
/// arbitrary order if some may be repeated and some are required, or tags whose contents depend on an attribute.
/// Therefore, in the written schema, all tags are optional and may be repeated, and a tag may contain whatever any of
/// its kinds may contain. `comment` is written at the top.
void writeXmlSchema(std::ostream& out, const TagForm& root, const std::string& comment);

}  // namespace tushar::input
