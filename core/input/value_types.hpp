#pragma once

#include <string>
#include <vector>

#include "core/input/schema_base.hpp"

namespace tushar::input {

/// A type of values in the schemas for editors.
struct ValueType {
  std::string type;     ///< name of the type in the manual
  std::string name;     ///< name of the type in the schemas
  std::string pattern;  ///< regular expression of XML Schema that matches such values after blanks are collapsed
};

/// All types of values; `text` is the first.
const std::vector<ValueType>& valueTypes();

/// The type with this name in the manual; `text` if there is none.
const ValueType& valueTypeOf(const std::string& type);

/// The allowed content of the tags of a declaration.
std::vector<TagForm> formsOf(const SchemaEntry& entry);

/// The documentation of a declaration, such as `number in Pa, greater than 0: its modulus [Tushar's own]`.
std::string documentationOf(const SchemaEntry& entry);

/// The requirement on a tag or attribute of this name; null if there is none.
const Demand* findDemand(const std::vector<Demand>& demands, const std::string& name);

}  // namespace tushar::input
