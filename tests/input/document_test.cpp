#include "core/input/document.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>

#include "tests/input/support.hpp"

namespace tushar::input {
namespace {

Lines problemsOf(const std::string& text) {
  Diagnostics diagnostics;
  Document::parse(text, "s.ups", diagnostics);
  return told(diagnostics);
}

Lines problemsOfFile(const std::string& path) {
  Diagnostics diagnostics;
  Document::load(path, diagnostics);
  return told(diagnostics);
}

TEST(Document, RemembersWhereEachTagStands) {
  Diagnostics diagnostics;
  const Document document = Document::parse(
      "<?xml version='1.0'?>\n<Uintah_specification>\n  <Time>\n    <maxTime> 1 </maxTime>\n  "
      "</Time>\n</Uintah_specification>\n",
      "s.ups", diagnostics);

  const Element maxTime = *document.root().child("Time")->child("maxTime");

  EXPECT_EQ(maxTime.where().text(), "s.ups:4:6");
  EXPECT_EQ(maxTime.path(), "Time/maxTime");
  EXPECT_EQ(maxTime.text(), "1");
}

TEST(Document, GivesChildrenInTheOrderOfTheFile) {
  const Document document = documentOf("<a/><!-- no tag --><b k=' v '/><a>2</a>");

  const Element root = document.root();

  EXPECT_EQ(root.children().size(), 3u);
  EXPECT_EQ(root.children("a").at(1).text(), "2");
  EXPECT_EQ(root.child("b")->attribute("k"), "v");
  EXPECT_EQ(root.child("b")->attribute("none"), std::nullopt);
  EXPECT_EQ(root.child("c"), std::nullopt);
  EXPECT_EQ(root.child("b")->parent(), root);
}

TEST(Document, KeepsElementsValidWhenItMoves) {
  Document document = documentOf("<a>1</a>");
  const Element a = *document.root().child("a");

  const Document moved = std::move(document);

  EXPECT_EQ(a.text(), "1");
  EXPECT_EQ(moved.root().child("a"), a);
}

TEST(Document, ReadsLatin1AsUtf8) {
  Diagnostics diagnostics;
  const Document document = Document::parse(
      "<?xml version='1.0' encoding='ISO-8859-1' ?><Uintah_specification><a>\xE9</a></Uintah_specification>", "s.ups",
      diagnostics);

  EXPECT_EQ(document.root().child("a")->text(), "é");
}

TEST(Document, SaysThatAFileIsMissing) {
  EXPECT_EQ(problemsOfFile("none.ups"), Lines{"none.ups: there is no such file"});
}

TEST(Document, SaysThatAFolderIsNoFile) {
  const std::string folder = test::temporaryFolder() + "folder.ups";
  std::filesystem::create_directory(folder);

  EXPECT_EQ(problemsOfFile(folder), Lines{folder + ": this is a folder, not a file"});
}

/// A triangle surface is named without the extensions of its two files, NAME.pts and NAME.tri.
TEST(Document, FindsTheFilesOfASurfaceAboveAndBesideTheScene) {
  const std::filesystem::path above = test::newFolder("surfaces"), beside = above / "scenes" / "hearts";
  std::filesystem::create_directories(beside);
  std::filesystem::create_directories(above / "parts");
  for (const std::filesystem::path& surface : {above / "parts" / "heart", beside / "moved"})
    for (const char* end : {".pts", ".tri"}) std::ofstream(surface.string() + end) << "0 0 0\n";
  std::filesystem::create_directories(beside / "folder");
  Diagnostics diagnostics;
  const auto found = [&](const std::string& name) {
    const Document document =
        Document::parse("<Uintah_specification><tri><name>" + name + "</name></tri></Uintah_specification>",
                        (beside / "s.ups").string(), diagnostics);
    return std::string(document.root().child("tri")->child("name")->text());
  };

  EXPECT_EQ(found("parts/heart"), (above / "parts" / "heart").string());
  EXPECT_FALSE(diagnostics.any());
  EXPECT_EQ(found("elsewhere/moved"), (beside / "moved").string());
  EXPECT_EQ(found("parts/none"), (beside / "parts" / "none").string());
  EXPECT_EQ(found("parts/folder"), (beside / "parts" / "folder").string());  // beside the scene, but not a file
}

TEST(Document, SaysThatAFileIsEmpty) {
  const std::string path = temporaryFile("empty.ups", " \n");

  EXPECT_EQ(problemsOfFile(path), Lines{path + ": the file is empty"});
}

TEST(Document, SaysWhyAFileCannotBeRead) {
  const std::string path = "/proc/self/mem";  // can be opened, but has nothing to read at its start
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "there is no such file on this system";

  EXPECT_EQ(problemsOfFile(path), Lines{path + ": it cannot be read: Input/output error"});
}

TEST(Document, SaysWhereXmlIsMalformed) {
  EXPECT_EQ(problemsOf("<Uintah_specification>\n  <Time></Tme>\n</Uintah_specification>"),
            Lines{"s.ups:2:11: found </Tme>, but no such tag is open; the open tag here is <Time> of s.ups:2:4"});
  EXPECT_EQ(problemsOf("<Uintah_specification>\n  <Time <Grid/>\n</Uintah_specification>"),
            Lines{"s.ups:2:9: this is not well-formed XML: Error parsing start element tag"});
}

TEST(Document, ExplainsALessThanWithinAFormula) {
  for (const std::string formula : {"1+(x<.5)", "if(x < 0, 1, 2)", "x<y ? 1 : 2", "(x<y) + (y>z)"})
    EXPECT_EQ(problemsOf(scene("<a>\n</a><b>" + formula + "</b>")),
              Lines{fmt::format("s.ups:2:{}: found < within a text: in a formula, write &lt; for 'less than'",
                                8 + formula.find('<'))});
}

TEST(Document, NamesTheTagThatIsNotClosed) {
  EXPECT_EQ(problemsOf("<Uintah_specification>\n <Time>\n <!-- <a> --> <b c='</b>'/>\n</Uintah_specification>"),
            Lines{"s.ups:4:3: found </Uintah_specification> while <Time> of s.ups:2:3 is still open; its </Time> may "
                  "be missing"});
  EXPECT_EQ(
      problemsOf("<Uintah_specification>\n <Time>\n"),
      Lines{
          "s.ups:3:1: found the end of the file while <Time> of s.ups:2:3 is still open; its </Time> may be missing"});
  EXPECT_EQ(problemsOf("<Uintah_specification/></Time>"), Lines{"s.ups:1:26: found </Time>, but no tag is open here"});
}

TEST(Document, RefusesTagsThatAreNestedTooDeep) {
  std::string text = "<Uintah_specification>";
  for (int k = 0; k < 200000; ++k) text += "<a>";
  for (int k = 0; k < 200000; ++k) text += "</a>";

  EXPECT_EQ(problemsOf(text + "</Uintah_specification>"),
            Lines{"s.ups:1:321: tags are nested more than 100 levels deep"});
}

TEST(Document, SaysThatTheRootIsAnother) {
  EXPECT_EQ(
      problemsOf("\n<Uintah_specificaton/>"),
      Lines{"s.ups:2:2: the outermost tag is <Uintah_specificaton>, expected <Uintah_specification> (did you mean "
            "'Uintah_specification'?)"});
}

TEST(Document, SaysThatThereAreTwoRoots) {
  EXPECT_EQ(problemsOf("<Uintah_specification/>\n<Time/>"),
            Lines{"s.ups:2:2: a second outermost tag <Time> after <Uintah_specification>"});
}

TEST(Document, SaysThatAnAttributeIsGivenTwice) {
  EXPECT_EQ(problemsOf(scene("<a k='1' k='2'/>")), Lines{"s.ups:1:24: attribute 'k' of <a> is given twice"});
}

TEST(Document, HasABareRootAfterAProblem) {
  Diagnostics diagnostics;
  const Document document = Document::load("none.ups", diagnostics);

  EXPECT_EQ(document.root().name(), "Uintah_specification");
  EXPECT_TRUE(document.root().children().empty());
}

TEST(Document, WritesItsTextWithCommentsAndOverrides) {
  Document document = documentOf("<!--why--><Time k='&lt;'><maxTime>1</maxTime></Time>");
  Diagnostics diagnostics;
  document.set("Time/maxTime=2", diagnostics);

  EXPECT_EQ(document.text(),
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Uintah_specification>\n  <!--why-->\n  <Time k=\"&lt;\">\n"
            "    <maxTime>2</maxTime>\n  </Time>\n</Uintah_specification>\n");
}

class Include : public testing::Test {
 protected:
  std::string other_ = temporaryFile("other.xml", "<Uintah_Include>\n<A><B><c>1</c>\n<d/></B></A></Uintah_Include>");

  Document load(const std::string& include, Diagnostics& diagnostics) {
    path_ = temporaryFile("main.ups", scene("\n<Grid>" + include + "</Grid>"));
    return Document::load(path_, diagnostics);
  }
  Lines problems(const std::string& include) {
    Diagnostics diagnostics;
    load(include, diagnostics);
    return told(diagnostics);
  }

  std::string path_;
};

TEST_F(Include, InsertsTheChildrenOfTheSectionWhenAsked) {
  Diagnostics diagnostics;
  const Document document =
      load("<x/><include href='other.xml' section='A/B' excludeSectionTag='true'/><y/>", diagnostics);

  const Element grid = *document.root().child("Grid");

  EXPECT_EQ(told(diagnostics), Lines{});
  ASSERT_EQ(grid.children().size(), 4u);
  EXPECT_EQ(grid.children()[1].name(), "c");
  EXPECT_EQ(grid.children()[1].path(), "Grid/c");
  EXPECT_EQ(grid.children()[2].where().text(), other_ + ":3:2");
}

TEST_F(Include, InsertsTheWholeFileWithoutASection) {
  Diagnostics diagnostics;
  const Document document = load("<include href='other.xml'/>", diagnostics);

  EXPECT_EQ(document.root().child("Grid")->children().at(0).name(), "A");
}

TEST(Document, MakesThePathOfAFileAbsolute) {
  Diagnostics diagnostics;
  Document document = Document::parse(
      "<Uintah_specification><a><file> ../t.h5 </file><name>steel</name></a>"
      "<tri><name>../t.h5</name></tri><contact><filename>../t.h5</filename></contact>"
      "</Uintah_specification>",
      "some/folder/s.ups", diagnostics);
  const std::string expected = (std::filesystem::current_path() / "some/t.h5").string();
  EXPECT_EQ(document.root().child("tri")->child("name")->text(), expected);
  EXPECT_EQ(document.root().child("contact")->child("filename")->text(), expected);
  EXPECT_EQ(document.root().child("a")->child("name")->text(), "steel");
  EXPECT_EQ(document.root().child("a")->child("file")->text(), expected);
  EXPECT_NE(document.text().find("<file>" + expected + "</file>"), std::string::npos);
  document.set("a/file=other.h5", diagnostics);
  EXPECT_EQ(document.root().child("a")->child("file")->text(), "other.h5");
}

TEST_F(Include, InsertsTheSectionItself) {
  Diagnostics diagnostics;
  const Document document = load("<include href='other.xml' section='A/B'/>", diagnostics);

  EXPECT_EQ(document.root().child("Grid")->children().at(0).name(), "B");
}

TEST_F(Include, FindsAFileThatIsNamedFromAFolderAbove) {
  const std::filesystem::path deep = std::filesystem::path(test::temporaryFolder()) / "MPM" / "inner";
  std::filesystem::create_directories(deep);
  std::ofstream(deep / "main.ups") << scene("\n<Grid><include href='other.xml' section='A/B'/></Grid>");
  Diagnostics diagnostics;
  const Document document = Document::load((deep / "main.ups").string(), diagnostics);

  EXPECT_EQ(told(diagnostics), Lines{});
  EXPECT_EQ(document.root().child("Grid")->children().at(0).name(), "B");
}

TEST_F(Include, SaysThatTheFileIsMissing) {
  const Lines lines = problems("<include href='othr.xml'/>");

  EXPECT_EQ(lines,
            Lines{path_ + ":2:8: cannot include '" + test::temporaryFolder() + "othr.xml': there is no such file"});
}

TEST_F(Include, SaysThatTheSectionIsMissing) {
  const Lines lines = problems("<include href='other.xml' section='A/Bc'/>");

  EXPECT_EQ(lines, Lines{path_ + ":2:8: there is no <Bc> in <A> of '" + other_ + "'"});
}

TEST_F(Include, SuggestsTheNearestSection) {
  temporaryFile("near.xml", "<Uintah_Include><Materials/></Uintah_Include>");

  const Lines lines = problems("<include href='near.xml' section='Material'/>");

  EXPECT_EQ(lines, Lines{path_ + ":2:8: there is no <Material> in <Uintah_Include> of '" + test::temporaryFolder() +
                         "near.xml' (did you mean 'Materials'?)"});
}

TEST_F(Include, SaysThatHrefIsMissing) {
  const Lines lines = problems("<include/>");

  EXPECT_EQ(lines, Lines{path_ + ":2:8: <include> needs the attribute 'href', the file to include"});
}

TEST_F(Include, SaysThatAnAttributeIsUnknown) {
  const Lines lines = problems("<include href='other.xml' sektion='A'/>");

  EXPECT_EQ(lines, Lines{path_ + ":2:8: unknown attribute 'sektion' of <include> (did you mean 'section'?); allowed "
                                 "here: href, section, excludeSectionTag"});
}

TEST_F(Include, SaysThatItWouldNeverEnd) {
  const Lines lines = problems("<include href='main.ups'/>");

  EXPECT_EQ(lines,
            Lines{path_ + ":2:8: cannot include '" + path_ + "': it includes itself, directly or through other files"});
}

}  // namespace
}  // namespace tushar::input
