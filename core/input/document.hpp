#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "core/input/diagnostics.hpp"
#include "core/input/element.hpp"
#include "core/input/node.hpp"

namespace tushar::input {

/// A scene file as a tree of tags with their locations in the file.
///
/// `<include href="other.xml" section="A/B"/>` is replaced by that section of the other file, including its tag.
/// Without `section`, it is replaced by the contents of the root tag, and with `excludeSectionTag="true"`, by the
/// contents of the section's tag. `href` is relative to the including file, and so are the file names in tags such as
/// `<file>`: their text becomes an absolute path, so that the scene that text() returns finds the files from any
/// folder.
class Document {
 public:
  /// Reads a file. Reports all problems to `diagnostics`; after an error, the document has only an empty root.
  static Document load(const std::string& path, Diagnostics& diagnostics);
  /// Reads a scene from memory, as if it were the file `name`.
  static Document parse(std::string_view text, const std::string& name, Diagnostics& diagnostics);

  /// Overrides one value, such as `Grid/Level/Box/resolution=[200,1,1]`. `Tag[2]` picks the second of several siblings,
  /// `Tag[@label='left']` one by its attribute, and a path that ends in `@type` sets an attribute. Missing tags are
  /// created. The location of the new value is `--set PATH=VALUE`.
  void set(const std::string& change, Diagnostics& diagnostics);

  /// Treats the tags at `path`, such as `MaterialProperties/MPM`, as if they were above their siblings, which can then
  /// refer to labels in them.
  void readFirst(std::string_view path);

  /// The root tag, `<Uintah_specification>`.
  Element root() const { return Element(*root_); }
  /// The scene as XML, with included files inserted and overrides applied.
  std::string text() const;
  /// The path or name that was given to load or parse.
  const std::string& path() const { return path_; }

 private:
  Document(std::string path, std::unique_ptr<Node> root) : path_(std::move(path)), root_(std::move(root)) {}

  std::string path_;
  std::unique_ptr<Node> root_;
};

}  // namespace tushar::input
