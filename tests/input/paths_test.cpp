#include "core/input/paths.hpp"

#include <gtest/gtest.h>

#include "core/input/document.hpp"

namespace tushar::input {

TEST(SettablePaths, NameValuesAndAttributesInTheOrderOfTheFile) {
  Diagnostics diagnostics;
  const Document document = Document::parse(
      "<Uintah_specification><Time><maxTime>1</maxTime></Time><Grid><Face side='x-'/><Face side='x+'><a>1</a></Face>"
      "</Grid><flag/><save label='b'>text</save></Uintah_specification>",
      "s.ups", diagnostics);
  EXPECT_EQ(settablePaths(document.root()),
            (std::vector<std::string>{"Time/maxTime", "Grid/Face[1]/@side", "Grid/Face[2]/@side", "Grid/Face[2]/a",
                                      "flag", "save", "save/@label"}));
}

TEST(SettablePaths, LeadToTheirTags) {
  Diagnostics diagnostics;
  Document document = Document::parse("<Uintah_specification><a k='1'><b>1</b><b>2</b></a></Uintah_specification>",
                                      "s.ups", diagnostics);
  for (const std::string& path : settablePaths(document.root())) document.set(path + "=3", diagnostics);
  EXPECT_FALSE(diagnostics.any());
  EXPECT_EQ(document.root().child("a")->attribute("k"), "3");
  EXPECT_EQ(document.root().child("a")->children("b").size(), 2u);
  EXPECT_EQ(document.root().child("a")->children("b")[1].text(), "3");
}

}  // namespace tushar::input
