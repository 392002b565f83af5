#pragma once

#include <string>
#include <vector>

#include "core/input/schema_base.hpp"

namespace tushar::input {

/// A type of values in schemas for editors.
struct ValueType {
  std::string type;     ///< its name in the manual
  std::string name;     ///< in schemas
  std::string pattern;  ///< a regular expression of XML Schema for a text with collapsed blanks
};

/// All types of values, `text` the first.
const std::vector<ValueType>& valueTypes();

/// The type with that name in the manual; text if there is none.
const ValueType& valueTypeOf(const std::string& type);

/// The allowed content of the tags of a declaration.
std::vector<TagForm> formsOf(const SchemaEntry& entry);

/// The documentation of a declaration, such as `number in Pa, greater than 0: its modulus [Tushar's own]`.
std::string documentationOf(const SchemaEntry& entry);

/// The requirement on a tag or attribute of this name; null if there is none.
const Demand* findDemand(const std::vector<Demand>& demands, const std::string& name);

}  // namespace tushar::input
