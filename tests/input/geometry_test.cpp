#include "core/input/geometry.hpp"

#include <cmath>
#include <sstream>

#include "tests/input/support.hpp"

namespace tushar::input {
namespace {

PiecePtr pieceOf(const std::string& shapes) {
  const Document document = documentOf("<geom_object>" + shapes + "</geom_object>");
  Diagnostics diagnostics;
  PiecePtr piece = readGeometry(*document.root().child("geom_object"), diagnostics);
  EXPECT_EQ(told(diagnostics), Lines{});
  return piece;
}

/// Returns the problems of `inside`, read as geom_objects of a section M; it starts on line 2, column 1.
Lines problemsOf(const std::string& inside) {
  const Document document = documentOf("<M>\n" + inside + "</M>");
  Diagnostics diagnostics;
  for (const Element& object : document.root().child("M")->children()) readGeometry(object, diagnostics);
  return told(diagnostics);
}

std::string box(const std::string& min, const std::string& max, const std::string& label = "") {
  return "<box" + (label.empty() ? "" : " label='" + label + "'") + "><min>" + min + "</min><max>" + max +
         "</max></box>";
}

void expectBounds(const GeometryPiece& piece, const Vec3& min, const Vec3& max) {
  EXPECT_TRUE(piece.bounds().min.isApprox(min)) << piece.bounds().min.transpose();
  EXPECT_TRUE(piece.bounds().max.isApprox(max)) << piece.bounds().max.transpose();
}

TEST(Geometry, BoxHoldsItsFacesAndOwnsTheLower) {
  const PiecePtr piece = pieceOf(box("[0,0,0]", "[1,2,3]"));

  EXPECT_TRUE(piece->contains({0, 0, 0}));
  EXPECT_TRUE(piece->contains({0.9, 1.9, 2.9}));
  EXPECT_TRUE(piece->contains({1, 2, 3}));
  EXPECT_FALSE(piece->contains({std::nextafter(1, 2), 1, 1}));
  EXPECT_FALSE(piece->contains({0.5, -0.1, 1}));
  EXPECT_TRUE(piece->owns({0, 0, 0}));
  EXPECT_FALSE(piece->owns({1, 1, 1}));
  expectBounds(*piece, {0, 0, 0}, {1, 2, 3});
}

TEST(Geometry, SphereHoldsItsSurface) {
  const PiecePtr piece = pieceOf("<sphere><origin>[1,1,1]</origin><radius>0.5</radius></sphere>");

  EXPECT_TRUE(piece->contains({1.5, 1, 1}));
  EXPECT_FALSE(piece->contains({1.4, 1.4, 1}));
  expectBounds(*piece, {0.5, 0.5, 0.5}, {1.5, 1.5, 1.5});
}

TEST(Geometry, CylinderHoldsItsEndsAndOwnsItsBottom) {
  const PiecePtr piece = pieceOf("<cylinder><bottom>[0,0,1]</bottom><top>[0,0,3]</top><radius>1</radius></cylinder>");

  EXPECT_TRUE(piece->contains({1, 0, 1}));
  EXPECT_TRUE(piece->contains({1, 0, 3}));
  EXPECT_FALSE(piece->contains({0, 0, 3.0001}));
  EXPECT_FALSE(piece->contains({0.8, 0.8, 2}));
  EXPECT_TRUE(piece->owns({1, 0, 1}));
  EXPECT_FALSE(piece->owns({0, 0, 3}));
  expectBounds(*piece, {-1, -1, 1}, {1, 1, 3});
}

TEST(Geometry, ConeNarrowsTowardsItsTop) {
  const PiecePtr piece = pieceOf(
      "<cone><bottom>[0,0,0]</bottom><top>[4,0,0]</top><bottom_radius>2</bottom_radius><top_radius>0</top_radius></"
      "cone>");

  EXPECT_TRUE(piece->contains({2, 1, 0}));
  EXPECT_TRUE(piece->contains({4, 0, 0}));
  EXPECT_FALSE(piece->owns({4, 0, 0}));
  EXPECT_FALSE(piece->contains({2, 1.01, 0}));
  expectBounds(*piece, {0, -2, -2}, {4, 2, 2});
}

TEST(Geometry, EllipsoidHasRadiiAlongTheAxes) {
  const PiecePtr piece = pieceOf("<ellipsoid><origin>[0,0,0]</origin><rx>1</rx><ry>2</ry><rz>3</rz></ellipsoid>");

  EXPECT_TRUE(piece->contains({0, 2, 0}));
  EXPECT_TRUE(piece->contains({0, 2 * (1 + 4e-13), 0}));
  EXPECT_FALSE(piece->contains({0, 2 * (1 + 6e-13), 0}));
  EXPECT_FALSE(piece->contains({0.8, 1.3, 0}));
  expectBounds(*piece, {-1, -2, -3}, {1, 2, 3});
}

TEST(Geometry, EllipsoidMayBeTurned) {
  const PiecePtr piece =
      pieceOf("<ellipsoid><origin>[0,0,0]</origin><v1>[2,2,0]</v1><v2>[-1,1,0]</v2><v3>[0,0,1]</v3></ellipsoid>");

  EXPECT_TRUE(piece->contains({1.9, 1.9, 0}));
  EXPECT_FALSE(piece->contains({-1.1, 1.1, 0}));
  expectBounds(*piece, {-std::sqrt(5), -std::sqrt(5), -1}, {std::sqrt(5), std::sqrt(5), 1});
}

TEST(Geometry, ParallelepipedIsSheared) {
  const PiecePtr piece =
      pieceOf("<parallelepiped><p1>[0,0,0]</p1><p2>[1,0,0]</p2><p3>[1,1,0]</p3><p4>[0,0,1]</p4></parallelepiped>");

  EXPECT_TRUE(piece->contains({1.2, 0.5, 0.5}));
  EXPECT_FALSE(piece->contains({0.2, 0.5, 0.5}));
  EXPECT_TRUE(piece->contains({1.5, 1, 1}));
  EXPECT_FALSE(piece->contains({0.5, 0.25, 0}));
  EXPECT_TRUE(piece->owns({0.5, 0.25, 0}));
  EXPECT_FALSE(piece->owns({1.5, 1, 1}));
  expectBounds(*piece, {0, 0, 0}, {2, 1, 1});
}

TEST(Geometry, TorusHasAHole) {
  const PiecePtr piece = pieceOf(
      "<torus><center>[0,0,0]</center><major_radius>2</major_radius><minor_radius>0.5</minor_radius><axis>z</axis></"
      "torus>");

  EXPECT_TRUE(piece->contains({0, 2.49, 0}));
  EXPECT_FALSE(piece->contains({0, 2.5, 0}));
  EXPECT_FALSE(piece->contains({0, 0, 0}));
  EXPECT_FALSE(piece->contains({2, 0, 0.6}));
  expectBounds(*piece, {-2.5, -2.5, -0.5}, {2.5, 2.5, 0.5});
}

TEST(Geometry, TorusTiltsByTheta) {
  const PiecePtr piece = pieceOf(
      "<torus><center>[0,0,0]</center><major_radius>2</major_radius><minor_radius>0.5</minor_radius><axis>z</axis>"
      "<theta>0.78539816339744831</theta></torus>");
  const double c = std::sqrt(0.5);

  EXPECT_TRUE(piece->contains(Vec3(2 * c, 0, 2 * c)));
  EXPECT_FALSE(piece->contains(Vec3(2 * c, 0, -2 * c)));
}

TEST(Geometry, DifferenceTakesTheSecondFromTheFirst) {
  const PiecePtr piece =
      pieceOf("<difference>" + box("[0,0,0]", "[2,2,2]") + box("[1,0,0]", "[3,2,2]") + "</difference>");

  EXPECT_TRUE(piece->contains({0.5, 1, 1}));
  EXPECT_FALSE(piece->contains({1.5, 1, 1}));
  EXPECT_FALSE(piece->contains({1, 1, 1}));
  EXPECT_TRUE(piece->contains({0.5, 2, 2}));
  EXPECT_FALSE(piece->owns({0.5, 2, 2}));
  expectBounds(*piece, {0, 0, 0}, {2, 2, 2});
}

TEST(Geometry, IntersectionIsWhatAllShare) {
  const PiecePtr piece =
      pieceOf("<intersection>" + box("[0,0,0]", "[2,2,2]") + box("[1,0,0]", "[3,2,2]") + "</intersection>");

  EXPECT_TRUE(piece->contains({1.5, 1, 1}));
  EXPECT_FALSE(piece->contains({0.5, 1, 1}));
  expectBounds(*piece, {1, 0, 0}, {2, 2, 2});
}

TEST(Geometry, UnionIsWhatAnyHolds) {
  const PiecePtr piece = pieceOf("<union>" + box("[0,0,0]", "[1,1,1]") + box("[2,0,0]", "[3,1,1]") + "</union>");

  EXPECT_TRUE(piece->contains({2.5, 0.5, 0.5}));
  EXPECT_FALSE(piece->contains({1.5, 0.5, 0.5}));
  expectBounds(*piece, {0, 0, 0}, {3, 1, 1});
}

TEST(Geometry, UnitesSeveralShapesOfOneObject) {
  const PiecePtr piece = pieceOf(box("[0,0,0]", "[1,1,1]") + "<res>[2,2,2]</res>" + box("[2,0,0]", "[3,1,1]"));

  EXPECT_TRUE(piece->contains({0.5, 0.5, 0.5}));
  EXPECT_TRUE(piece->contains({2.5, 0.5, 0.5}));
}

TEST(Geometry, FindsAShapeAgainByItsLabel) {
  const Document document =
      documentOf("<M><a><difference>" + box("[0,0,0]", "[2,2,2]") + box("[0,0,0]", "[1,1,1]", "gp3") +
                 "</difference></a><b><box label='gp3'/></b></M>");
  Diagnostics diagnostics;

  const PiecePtr piece = readGeometry(*document.root().child("M")->child("b"), diagnostics);

  ASSERT_NE(piece, nullptr);
  expectBounds(*piece, {0, 0, 0}, {1, 1, 1});
}

TEST(Geometry, FindsAShapeOfAnotherSectionWhereItsOwnHasNone) {
  // Two sections: M defines b and c; N refers to b, and its own c takes precedence over that of M.
  const Document document = documentOf(
      "<M><a>" + box("[0,0,0]", "[1,1,1]", "b") + "</a><a>" + box("[0,0,0]", "[1,1,1]", "c") + "</a></M><N><a>" +
      box("[0,0,0]", "[2,2,2]", "c") + "</a><d><box label='b'/></d><e><box label='c'/></e></N>");
  Diagnostics diagnostics;
  const Element section = *document.root().child("N");

  const PiecePtr other = readGeometry(*section.child("d"), diagnostics);
  const PiecePtr own = readGeometry(*section.child("e"), diagnostics);

  EXPECT_FALSE(diagnostics.any());
  ASSERT_NE(other, nullptr);
  ASSERT_NE(own, nullptr);
  expectBounds(*other, {0, 0, 0}, {1, 1, 1});
  expectBounds(*own, {0, 0, 0}, {2, 2, 2});
}

TEST(Geometry, SaysThatALabelIsUnknown) {
  EXPECT_EQ(problemsOf("<a>" + box("[0,0,0]", "[1,1,1]", "gp3") + "</a>\n<b><box label='gp4'/></b>"),
            Lines{"s.ups:3:5: M/b/box: there is no shape labelled 'gp4' above (did you mean 'gp3'?)"});
}

TEST(Geometry, SaysThatALabelIsOfAnotherKind) {
  EXPECT_EQ(problemsOf("<a>" + box("[0,0,0]", "[1,1,1]", "gp3") + "</a>\n<b><sphere label='gp3'/></b>"),
            Lines{"s.ups:3:5: M/b/sphere: 'gp3' is the <box> at s.ups:2:5, not a <sphere>"});
}

TEST(Geometry, NotesThatALabelIsTaken) {
  const Document document =
      documentOf("<M><a>" + box("[0,0,0]", "[1,1,1]", "g") + "</a>\n<b>" + box("[0,0,0]", "[2,2,2]", "g") + "</b></M>");
  Diagnostics diagnostics;

  const PiecePtr piece = readGeometry(*document.root().child("M")->child("b"), diagnostics);

  ASSERT_NE(piece, nullptr);
  expectBounds(*piece, {0, 0, 0}, {2, 2, 2});
  ASSERT_EQ(diagnostics.notes().size(), 1u);
  EXPECT_EQ(diagnostics.notes()[0].sentence,
            "the <box> at s.ups:1:30 also has the label 'g', so no tag can refer to either of them");
}

TEST(Geometry, SaysThatALabelIsOfTwoShapes) {
  EXPECT_EQ(problemsOf("<a>" + box("[0,0,0]", "[1,1,1]", "g") + "</a>\n<b>" + box("[0,0,0]", "[2,2,2]", "g") +
                       "</b>\n<c><box label='g'/></c>"),
            Lines{"s.ups:4:5: M/c/box: 'g' is the label of two shapes, at s.ups:2:5 and at s.ups:3:5; give them "
                  "different labels"});
}

TEST(Geometry, KeepsTheLabelsOfSectionsApart) {
  const Document document = documentOf("<M><a>" + box("[0,0,0]", "[1,1,1]", "g") + "</a></M><P><b>" +
                                       box("[0,0,0]", "[2,2,2]", "g") + "</b></P>");
  Diagnostics diagnostics;

  const PiecePtr piece = readGeometry(*document.root().child("P")->child("b"), diagnostics);

  ASSERT_NE(piece, nullptr);
  expectBounds(*piece, {0, 0, 0}, {2, 2, 2});
}

TEST(Geometry, FindsLabelsBelowInAPartThatIsReadFirst) {
  Document document =
      documentOf("<M><gas><box label='g'/></gas><bodies>" + box("[0,0,0]", "[2,2,2]", "g") + "</bodies></M>");
  const Element gas = *document.root().child("M")->child("gas");
  Diagnostics before, after;

  EXPECT_EQ(readGeometry(gas, before), nullptr);
  document.readFirst("M/bodies");
  const PiecePtr piece = readGeometry(gas, after);

  ASSERT_NE(piece, nullptr);
  expectBounds(*piece, {0, 0, 0}, {2, 2, 2});
}

TEST(Geometry, DoesNotFindAShapeWithinItself) {
  EXPECT_EQ(problemsOf("<a><union label='u'><union label='u'/></union></a>"),
            Lines{"s.ups:2:22: M/a/union/union: there is no shape labelled 'u' above"});
}

TEST(Geometry, TellsOfAWrongShapeOnlyOnce) {
  EXPECT_EQ(problemsOf("<a>" + box("[0,0,0]", "[1,1,x]", "g") + "</a><b><union><box label='g'/></union></b>"),
            Lines{"s.ups:2:38: M/a/box/max: in '[1,1,x]': found 'x', expected a number"});
}

TEST(Geometry, SaysThatThereIsNoShape) {
  EXPECT_EQ(
      problemsOf("<a><res>[1,1,1]</res></a>"),
      Lines{"s.ups:2:2: M/a: <a> has no shape; the shapes are: box, cylinder, sphere, cone, ellipsoid, "
            "parallelepiped, torus, null, tri, line_segment, polyhedron, smoothcyl, union, difference, intersection"});
}

TEST(Geometry, SaysThatAShapeIsUnknown) {
  const Document document = documentOf("<bx/>");
  Diagnostics diagnostics;

  readShape(*document.root().child("bx"), diagnostics);

  EXPECT_EQ(
      told(diagnostics),
      Lines{
          "s.ups:1:24: bx: unknown shape <bx> (did you mean 'box'?); the shapes are: box, cylinder, sphere, "
          "cone, ellipsoid, parallelepiped, torus, null, tri, line_segment, polyhedron, smoothcyl, union, difference, "
          "intersection"});
}

TEST(Geometry, SaysThatAShapeInAUnionIsUnknown) {
  EXPECT_EQ(
      problemsOf("<a><union>" + box("[0,0,0]", "[1,1,1]") + "<spere/></union></a>"),
      Lines{"s.ups:2:59: M/a/union/spere: unknown tag <spere> in <union> (did you mean 'sphere'?); allowed here: box, "
            "cylinder, sphere, cone, ellipsoid, parallelepiped, torus, null, tri, line_segment, polyhedron, smoothcyl, "
            "union, "
            "difference, intersection"});
}

TEST(Geometry, SaysHowManyShapesAreNeeded) {
  EXPECT_EQ(problemsOf("<a><difference>" + box("[0,0,0]", "[1,1,1]") + "</difference></a>"),
            Lines{"s.ups:2:5: M/a/difference: expected two shapes (the second is cut out of the first) in "
                  "<difference>, found 1"});
  EXPECT_EQ(problemsOf("<a><union/></a>"), Lines{"s.ups:2:5: M/a/union: expected a shape in <union>, found 0"});
}

TEST(Geometry, SaysThatABoxIsFlat) {
  EXPECT_EQ(problemsOf("<a>" + box("[0,0,0]", "[1,0,-2]") + "</a>"),
            (Lines{"s.ups:2:5: M/a/box: the box has no extent along y: max 0 is not above min 0",
                   "s.ups:2:5: M/a/box: the box has no extent along z: max -2 is not above min 0"}));
}

TEST(Geometry, SaysThatARadiusIsNotPositive) {
  EXPECT_EQ(problemsOf("<a><sphere><origin>[0,0,0]</origin><radius>0</radius></sphere></a>"),
            Lines{"s.ups:2:37: M/a/sphere/radius: found '0', expected a value greater than 0 m"});
}

TEST(Geometry, SaysThatACylinderHasNoHeight) {
  EXPECT_EQ(problemsOf("<a><cylinder><bottom>[0,0,1]</bottom><top>[0,0,1]</top><radius>1</radius></cylinder></a>"),
            Lines{"s.ups:2:5: M/a/cylinder: bottom and top are both [0,0,1], so the <cylinder> has no height"});
}

TEST(Geometry, SaysThatAConeHasNoVolume) {
  EXPECT_EQ(problemsOf("<a><cone><bottom>[0,0,0]</bottom><top>[0,0,1]</top><bottom_radius>0</bottom_radius>"
                       "<top_radius>0</top_radius></cone></a>"),
            Lines{"s.ups:2:5: M/a/cone: bottom_radius and top_radius are both 0, so the <cone> has no volume"});
}

TEST(Geometry, SaysThatAnEllipsoidIsGivenByHalves) {
  const std::string sentence = "s.ups:2:5: M/a/ellipsoid: expected either <rx>, <ry> and <rz> or <v1>, <v2> and <v3>";

  EXPECT_EQ(problemsOf("<a><ellipsoid><origin>[0,0,0]</origin><rx>1</rx></ellipsoid></a>"), Lines{sentence});
  EXPECT_EQ(problemsOf(
                "<a><ellipsoid><origin>[0,0,0]</origin><rx>1</rx><ry>1</ry><rz>1</rz><v1>[1,0,0]</v1></ellipsoid></a>"),
            Lines{sentence});
}

TEST(Geometry, SaysThatSemiAxesAreWrong) {
  EXPECT_EQ(
      problemsOf(
          "<a><ellipsoid><origin>[0,0,0]</origin><v1>[1,0,0]</v1><v2>[1,1,0]</v2><v3>[0,0,1]</v3></ellipsoid></a>"),
      Lines{"s.ups:2:5: M/a/ellipsoid: the semi-axes v1, v2 and v3 are not perpendicular to each other"});
  EXPECT_EQ(
      problemsOf(
          "<a><ellipsoid><origin>[0,0,0]</origin><v1>[1,0,0]</v1><v2>[0,0,0]</v2><v3>[0,0,1]</v3></ellipsoid></a>"),
      Lines{"s.ups:2:5: M/a/ellipsoid: one of the semi-axes v1, v2 and v3 is zero"});
}

TEST(Geometry, SaysThatAParallelepipedIsFlat) {
  EXPECT_EQ(
      problemsOf(
          "<a><parallelepiped><p1>[0,0,0]</p1><p2>[1,0,0]</p2><p3>[0,1,0]</p3><p4>[1,1,0]</p4></parallelepiped></a>"),
      Lines{
          "s.ups:2:5: M/a/parallelepiped: p1, p2, p3 and p4 lie in one plane, so the <parallelepiped> has no volume"});
}

TEST(Geometry, DescribesEveryShape) {
  std::ostringstream out;

  describeGeometry(out);

  for (const std::string& name : geometryNames()) EXPECT_NE(out.str().find("<" + name + ">: "), std::string::npos);
}

}  // namespace
}  // namespace tushar::input
