#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "core/input/diagnostics.hpp"
#include "core/input/document.hpp"
#include "tests/support/temporary.hpp"

namespace tushar::input {

/// Returns the messages that the user would see, one line per problem.
inline std::vector<std::string> told(const Diagnostics& diagnostics) {
  std::vector<std::string> lines;
  for (const InputProblem& problem : diagnostics.sorted()) lines.push_back(problem.text());
  return lines;
}

using Lines = std::vector<std::string>;

/// Wraps `inside` in the root tag on the same line, so columns of line 1 are shifted by 23.
inline std::string scene(const std::string& inside) {
  return "<Uintah_specification>" + inside + "</Uintah_specification>";
}

/// Returns a document named `s.ups` that is expected to be well-formed.
inline Document documentOf(const std::string& inside) {
  Diagnostics diagnostics;
  Document document = Document::parse(scene(inside), "s.ups", diagnostics);
  EXPECT_EQ(told(diagnostics), Lines{});
  return document;
}

/// Writes a file into the temporary folder and returns its path.
inline std::string temporaryFile(const std::string& name, const std::string& text) {
  const std::string path = test::temporaryFolder() + name;
  std::ofstream(path) << text;
  return path;
}

}  // namespace tushar::input
