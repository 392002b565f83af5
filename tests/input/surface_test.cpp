#include "core/input/geometry/surface.hpp"

#include <cmath>
#include <cstring>
#include <sstream>

#include "core/input/geometry.hpp"
#include "tests/input/support.hpp"

namespace tushar::input {
namespace {

/// The eight corners of a cube with edges of length 1, and its twelve triangles.
const std::vector<Vec3> corners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
const std::vector<std::array<int, 3>> faces{{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                                            {2, 3, 7}, {2, 7, 6}, {1, 2, 6}, {1, 6, 5}, {3, 0, 4}, {3, 4, 7}};

Triangles cube() {
  const auto at = [](int corner) { return corners[corner]; };
  Triangles triangles;
  for (const auto& [a, b, c] : faces) triangles.push_back({at(a), at(b), at(c)});
  return triangles;
}

std::string textOf(const Triangles& triangles) {
  std::ostringstream text;
  text << "solid a part of two words\n";
  for (const auto& triangle : triangles) {
    text << " facet normal 0 0 0\n  outer loop\n";
    for (const Vec3& corner : triangle) text << "   vertex " << corner.transpose() << "\n";
    text << "  endloop\n endfacet\n";
  }
  text << "endsolid a part of two words\n";
  return text.str();
}

std::string bytesOf(const Triangles& triangles) {
  std::string bytes(84, ' ');
  const auto count = static_cast<std::uint32_t>(triangles.size());
  std::memcpy(bytes.data() + 80, &count, sizeof count);
  for (const auto& triangle : triangles) {
    std::array<float, 12> numbers{};
    for (std::size_t k = 0; k < 9; ++k) numbers[k + 3] = static_cast<float>(triangle[k / 3][static_cast<int>(k % 3)]);
    bytes.append(reinterpret_cast<const char*>(numbers.data()), sizeof numbers).append(2, '\0');
  }
  return bytes;
}

/// A sphere about (1, 2, 3), triangulated along meridians and parallels.
Triangles sphere(double radius, int parallels) {
  const int meridians = 2 * parallels;
  const auto at = [&](int i, int j) {
    const double polar = M_PI * i / parallels, around = 2 * M_PI * (j % meridians) / meridians;
    const double ring = i == 0 || i == parallels ? 0 : std::sin(polar);
    return Vec3(1 + radius * ring * std::cos(around), 2 + radius * ring * std::sin(around),
                3 + radius * std::cos(polar));
  };
  Triangles triangles;
  for (int i = 0; i < parallels; ++i)
    for (int j = 0; j < meridians; ++j) {
      if (i > 0) triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
      if (i + 1 < parallels) triangles.push_back({at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)});
    }
  return triangles;
}

class SurfaceFile : public testing::Test {
 protected:
  /// Returns the piece that `<tri>` makes from a file, and the messages about it.
  PiecePtr read(const std::string& name) {
    const Document document =
        documentOf("<geom_object><tri><name>" + test::temporaryFolder() + name + "</name></tri></geom_object>");
    Diagnostics diagnostics;
    PiecePtr piece = readGeometry(*document.root().child("geom_object"), diagnostics);
    problems_ = told(diagnostics);
    return piece;
  }
  void expectRefused(const std::string& name, const std::string& why) {
    EXPECT_EQ(read(name), nullptr);
    ASSERT_EQ(problems_.size(), 1u);
    EXPECT_NE(problems_[0].find(name), std::string::npos) << problems_[0];
    EXPECT_NE(problems_[0].find(why), std::string::npos) << problems_[0];
  }

  Lines problems_;
};

void expectUnitCube(const PiecePtr& piece) {
  ASSERT_NE(piece, nullptr);
  EXPECT_TRUE(piece->contains({.5, .5, .5}));
  EXPECT_TRUE(piece->contains({.01, .99, .3}));
  EXPECT_FALSE(piece->contains({1.01, .5, .5}));
  EXPECT_FALSE(piece->contains({.5, -.01, .5}));
  EXPECT_EQ(piece->bounds().min, Vec3(0, 0, 0));
  EXPECT_EQ(piece->bounds().max, Vec3(1, 1, 1));
}

TEST_F(SurfaceFile, IsReadAsTextAsBinaryAndAsUintahsTwoFiles) {
  std::ostringstream points, numbers;
  for (const Vec3& corner : corners) points << corner.transpose() << "\n";
  for (const auto& [a, b, c] : faces) numbers << a << " " << b << " " << c << "\n";
  temporaryFile("text.stl", textOf(cube()));
  temporaryFile("binary.stl", bytesOf(cube()));
  temporaryFile("two.pts", points.str());
  temporaryFile("two.tri", numbers.str());

  for (const char* name : {"text.stl", "binary.stl", "two"}) {
    SCOPED_TRACE(name);
    expectUnitCube(read(name));
    EXPECT_EQ(problems_, Lines{});
  }
}

TEST_F(SurfaceFile, IsRefusedWithItsNameAndWhatIsWrong) {
  Triangles open = cube();
  open.pop_back();
  const std::string text = textOf(cube()), bytes = bytesOf(cube());
  temporaryFile("open.stl", textOf(open));
  temporaryFile("cut.stl", text.substr(0, text.find("endsolid")));
  temporaryFile("short.stl", bytes.substr(0, bytes.size() - 7));
  temporaryFile("word.stl", "solid\nfacet normal 0 0 0\nvertx 1 2 3\n");
  temporaryFile("number.stl", "solid\nfacet normal 0 0 0\nvertex 1 2 x\n");
  temporaryFile("facet.stl", "solid\nfacet normal 0 0 0\nvertex 1 2 3\nfacet normal 0 0 0\nvertex 1 2 3\n");
  temporaryFile("empty.stl", "solid nothing\nendsolid nothing\n");
  temporaryFile("points.pts", "0 0 0\n1 0 0\n0 1 0\n");
  temporaryFile("points.tri", "0 1 3\n");

  expectRefused("open.stl", "3 of its 18 edges belong to an odd number of triangles");
  expectRefused("cut.stl", "it ends before `endsolid`");
  expectRefused("short.stl", "a binary file of 12 triangles has 684 bytes, not 677");
  expectRefused("word.stl", "line 3: found 'vertx', expected solid");
  expectRefused("number.stl", "line 3: expected `vertex x y z`, found 'vertex 1 2 x'");
  expectRefused("facet.stl", "line 4: found a facet of 1 vertices, expected three");
  expectRefused("empty.stl", "it contains no triangles");
  expectRefused("points", ".tri: there is no point 3; points are numbered from 0 to 2");
  expectRefused("missing.stl", "there is no such file");
  expectRefused("missing", "there is no such file ending in .pts");
}

TEST_F(SurfaceFile, MayHaveSeams) {
  // The lower face has a corner in its middle, on which its neighbour's edges have none.
  Triangles seamed = cube();
  seamed.erase(seamed.begin());
  const Vec3 &a = corners[0], &b = corners[1], &c = corners[2], middle = 0.5 * (a + b);
  seamed.push_back({a, c, middle});
  seamed.push_back({middle, c, b});
  temporaryFile("seam.stl", textOf(seamed));
  const PiecePtr piece = read("seam.stl");
  expectUnitCube(piece);
  EXPECT_EQ(problems_, Lines{});
}

TEST(Surface, OfASphereHoldsThePointsThatTheSphereHolds) {
  const Surface surface(sphere(1, 40));
  const double flat = 1 - std::cos(M_PI / 40);  // how far a facet lies below the sphere, along either angle

  int inside = 0, outside = 0;
  for (int k = 0; k < 4000; ++k) {
    const Vec3 offset(std::sin(1.0 * k) * 1.1, std::sin(1.3 * k + 1) * 1.1, std::sin(1.7 * k + 2) * 1.1);
    const double r = offset.norm();
    if (r > 1 - 2 * flat && r < 1) continue;
    EXPECT_EQ(surface.contains(Vec3(1, 2, 3) + offset), r < 1) << r;
    ++(r < 1 ? inside : outside);
  }
  EXPECT_GT(std::min(inside, outside), 400);
}

TEST(Surface, HasNoGapsWhereLinesPassThroughItsEdgesAndCorners) {
  const Surface surface(sphere(1, 8));  // corners and edges at z = 3 and y = 2

  for (int i = -20; i <= 20; ++i)
    for (const Vec3& offset : {Vec3(0.04 * i, 0, 0), Vec3(0, 0.04 * i, 0), Vec3(0, 0, 0.04 * i)})
      EXPECT_TRUE(surface.contains(Vec3(1, 2, 3) + offset)) << offset.transpose();
  for (const Vec3& point : {Vec3(-1, 2, 3), Vec3(3, 2, 3), Vec3(1, 2, 4.1), Vec3(0.05, 2.9, 3)})
    EXPECT_FALSE(surface.contains(point)) << point.transpose();
}

TEST(Geometry, NullHoldsNothing) {
  const Document document = documentOf("<geom_object><null/></geom_object>");
  Diagnostics diagnostics;

  const PiecePtr piece = readGeometry(*document.root().child("geom_object"), diagnostics);

  EXPECT_EQ(told(diagnostics), Lines{});
  EXPECT_FALSE(piece->contains({0, 0, 0}));
}

}  // namespace
}  // namespace tushar::input
