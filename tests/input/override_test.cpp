#include "tests/input/support.hpp"

namespace tushar::input {
namespace {

constexpr const char* boxes =
    "<Grid><Level><Box label='left'><resolution>[1,1,1]</resolution></Box><Box label='right'/></Level></Grid>"
    "<SimulationComponent type='mpm'/>";

Document changed(const std::string& change) {
  Document document = documentOf(boxes);
  Diagnostics diagnostics;
  document.set(change, diagnostics);
  EXPECT_EQ(told(diagnostics), Lines{});
  return document;
}

Lines problemsOf(const std::string& change) {
  Document document = documentOf(boxes);
  Diagnostics diagnostics;
  document.set(change, diagnostics);
  return told(diagnostics);
}

Element box(const Document& document, std::size_t i) {
  return document.root().child("Grid")->child("Level")->children("Box").at(i);
}

TEST(Override, ReplacesAValueOfTheSiblingByNumber) {
  const Document document = changed("Grid/Level/Box[1]/resolution=[200,1,1]");

  const Element resolution = *box(document, 0).child("resolution");

  EXPECT_EQ(resolution.text(), "[200,1,1]");
  EXPECT_EQ(resolution.where().text(), "--set Grid/Level/Box[1]/resolution=[200,1,1]");
}

TEST(Override, PicksASiblingByAttributeAndCreatesTheTag) {
  const Document document = changed("Grid/Level/Box[@label='right']/resolution = [3,1,1]");

  EXPECT_EQ(box(document, 1).child("resolution")->text(), "[3,1,1]");
}

TEST(Override, CreatesTheNextSibling) {
  const Document document = changed("Grid/Level/Box[3]/patches=[1,1,1]");

  EXPECT_EQ(box(document, 2).path(), "Grid/Level/Box");
}

TEST(Override, SetsAnAttribute) {
  const Document document = changed("SimulationComponent/@type=heat");

  const Element component = *document.root().child("SimulationComponent");

  EXPECT_EQ(component.attribute("type"), "heat");
  EXPECT_EQ(component.attributes().at(0).where.text(), "--set SimulationComponent/@type=heat");
}

TEST(Override, AddsAnAttribute) {
  const Document document = changed("Grid/Level/Box[2]/@kind=a=b");

  EXPECT_EQ(box(document, 1).attribute("kind"), "a=b");
}

TEST(Override, SaysThatAPathIsAmbiguous) {
  EXPECT_EQ(problemsOf("Grid/Level/Box/patches=[1,1,1]"),
            Lines{"--set Grid/Level/Box/patches=[1,1,1]: 2 tags <Box> in <Level> match; choose one, such as Box[1] or "
                  "Box[@label='…']"});
}

TEST(Override, SaysThatASiblingDoesNotExist) {
  EXPECT_EQ(problemsOf("Grid/Level/Box[4]/x=1"),
            Lines{"--set Grid/Level/Box[4]/x=1: there is no Box[4]: <Level> has 2 of them"});
}

TEST(Override, SaysThatNoSiblingHasTheAttribute) {
  EXPECT_EQ(problemsOf("Grid/Level/Box[@label='up']/x=1"),
            Lines{"--set Grid/Level/Box[@label='up']/x=1: there is no <Box> in <Level> with label='up'"});
}

TEST(Override, SaysThatAValueIsMissing) {
  EXPECT_EQ(problemsOf("Grid/Level"), Lines{"--set Grid/Level: expected PATH=VALUE, such as Time/maxTime=0.2"});
  EXPECT_EQ(problemsOf("=1"), Lines{"--set =1: expected PATH=VALUE, such as Time/maxTime=0.2"});
}

TEST(Override, SaysThatAPathIsMalformed) {
  EXPECT_EQ(problemsOf("Grid//x=1"), Lines{"--set Grid//x=1: found '', expected Tag, Tag[2] or Tag[@label='…']"});
  EXPECT_EQ(problemsOf("Grid/Box[0]/x=1"),
            Lines{"--set Grid/Box[0]/x=1: found 'Box[0]', expected Tag, Tag[2] or Tag[@label='…']"});
  EXPECT_EQ(problemsOf("@a/x=1"), Lines{"--set @a/x=1: found '@a', expected Tag, Tag[2] or Tag[@label='…']"});
}

}  // namespace
}  // namespace tushar::input
