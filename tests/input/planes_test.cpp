#include <fmt/format.h>

#include "core/input/geometry.hpp"
#include "tests/input/support.hpp"

// Shapes that are bounded by lines and planes.

namespace tushar::input {
namespace {

PiecePtr pieceOf(const std::string& inside, Diagnostics& diagnostics) {
  const Document document = documentOf("<M>" + inside + "</M>");
  return readGeometry(*document.root().child("M"), diagnostics);
}

Lines problemsOf(const std::string& inside) {
  Diagnostics diagnostics;
  pieceOf(inside, diagnostics);
  return told(diagnostics);
}

/// The octahedron |x| + |y| + |z| <= 1 shifted by (1, 1, 1), half of its planes given by points, half by offsets.
std::string octahedron() {
  std::string planes;
  for (int k = 0; k < 8; ++k) {
    const Vec3 away(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1);
    planes += k < 4 ? fmt::format("<half_space type='relative'><offset>[{},{},{}]</offset></half_space>", away[0] / 3,
                                  away[1] / 3, away[2] / 3)
                    : fmt::format(
                          "<half_space type='absolute'><planePoint>[1,1,{}]</planePoint><normal>[{},{},{}]"
                          "</normal></half_space>",
                          1 + away[2], -away[0], -away[1], -away[2]);
  }
  return "<polyhedron><center>[1,1,1]</center><bounds>" + planes + "</bounds></polyhedron>";
}

TEST(Planes, PolyhedronIsOnTheInnerSideOfItsPlanes) {
  Diagnostics diagnostics;
  const PiecePtr piece = pieceOf(octahedron(), diagnostics);

  ASSERT_NE(piece, nullptr);

  EXPECT_TRUE(piece->contains({1.3, 1.3, 0.7}));
  EXPECT_FALSE(piece->contains({1.4, 1.4, 0.7}));
  EXPECT_FALSE(piece->contains({0.6, 0.6, 0.7}));
  const Box3 box = piece->bounds();
  EXPECT_NEAR((box.min - Vec3(0, 0, 0)).norm() + (box.max - Vec3(2, 2, 2)).norm(), 0, 1e-12);
}

TEST(Planes, RefusesAPolyhedronThatIsOpenOrOfWrongPlanes) {
  std::string open = octahedron();
  open.replace(open.find("[1,1,1]"), 7, "[3,1,1]");
  EXPECT_EQ(problemsOf(open),
            Lines{"s.ups:1:27: M/polyhedron: its <center> is not on the inner side of all its planes"});
  const std::string plane = "<half_space><planePoint>[0,0,0]</planePoint><normal>[0,0,1]</normal></half_space>";
  EXPECT_EQ(problemsOf("<polyhedron><center>[0,0,1]</center><bounds>" + plane + plane + plane + plane +
                       "</bounds></polyhedron>"),
            Lines{"s.ups:1:27: M/polyhedron: its planes do not enclose a finite volume"});
  std::string wrong = octahedron();
  wrong.replace(wrong.find("relative"), 8, "absolute");
  EXPECT_EQ(problemsOf(wrong).at(0),
            "s.ups:1:71: M/polyhedron/bounds/half_space: type absolute needs <planePoint> and <normal>, and no "
            "<offset>");
}

/// Returns the piece that `<line_segment>` makes from a file.
PiecePtr polygonOf(const std::string& text, Diagnostics& diagnostics) {
  temporaryFile("corners.pts", text);
  return pieceOf("<line_segment><name>" + test::temporaryFolder() + "corners.pts</name></line_segment>", diagnostics);
}

TEST(Planes, PolygonIsWithinItsSidesInThePlaneOfXAndY) {
  Diagnostics diagnostics;
  const PiecePtr piece = polygonOf("0 0\n2 0\n\n2 1\n1 0.5\n0 1\n", diagnostics);

  ASSERT_NE(piece, nullptr);
  EXPECT_TRUE(piece->contains({0.5, 0.6, 0}));
  EXPECT_FALSE(piece->contains({1, 0.6, 0})) << "in the notch";
  EXPECT_FALSE(piece->contains({2.1, 0.6, 0}));
  EXPECT_FALSE(piece->contains({0.5, 0.6, 1e-4})) << "as in Uintah";
}

TEST(Planes, SaysWhichLineOfAPolygonIsWrong) {
  const std::string path = "'" + test::temporaryFolder() + "corners.pts': ";
  for (const auto& [text, problem] : {std::pair{"0 0\n1 x\n", "line 2: found '1 x', expected two numbers"},
                                      {"0 0\n1 0 0\n", "line 2: found '1 0 0', expected two numbers"},
                                      {"0 0\n1 0\n", "a polygon needs at least three corners"}}) {
    Diagnostics diagnostics;
    EXPECT_EQ(polygonOf(text, diagnostics), nullptr);
    EXPECT_NE(told(diagnostics).at(0).find(path + problem), std::string::npos) << told(diagnostics).at(0);
  }
}

}  // namespace
}  // namespace tushar::input
