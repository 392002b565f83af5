#include "components/mpm/solid/listed_particles.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/LU>

#include <algorithm>
#include <cstring>

#include "components/mpm/solid/material.hpp"
#include "tests/input/support.hpp"
#include "tests/support/levels.hpp"
#include "tests/support/temporary.hpp"

// Bodies whose particles a file lists.

namespace tushar::mpm::solid {
namespace {

using input::Diagnostics;
using input::Lines;

std::shared_ptr<const ListedParticles> listOf(const std::string& content, const std::string& tags,
                                              Diagnostics& diagnostics) {
  input::temporaryFile("particles.pts", content);
  const input::Document document =
      input::documentOf("<file><name>" + test::temporaryFolder() + "particles.pts</name>" + tags + "</file>");
  return readListedParticles(*document.root().child("file"), diagnostics);
}

Lines problemsOf(const std::string& content, const std::string& tags = "") {
  Diagnostics diagnostics;
  EXPECT_EQ(listOf(content, tags, diagnostics), nullptr);
  Lines lines;
  for (const InputProblem& problem : diagnostics.sorted())
    lines.push_back(std::to_string(problem.where.line) + ": " + problem.sentence);
  return lines;
}

grid::Level sheet() { return grid::Level(test::sheet()); }

Body bodyOf(const std::string& content, const std::string& tags) {
  Diagnostics diagnostics;
  Body body;
  body.shape = body.list = listOf(content, tags, diagnostics);
  EXPECT_EQ(diagnostics.size(), 0u);
  body.particlesPerCell = {{2, 2, 1}};
  return body;
}

/// The seeds of a body in the order of its cells.
std::vector<Seed> seedsOf(Body& body) {
  std::vector<Body> bodies{body};
  placeParticles(sheet(), bodies);
  body = bodies.front();
  std::vector<Seed> all;
  for (const auto& [cell, seeds] : *body.seeds) all.insert(all.end(), seeds.begin(), seeds.end());
  return all;
}

constexpr const char* everything = "<var>p.velocity</var><var>p.volume</var><var>p.color</var><var>p.temperature</var>";

TEST(ListedParticles, AreReadWithTheirVariablesInTheOrderOfTheTags) {
  Diagnostics diagnostics;
  const auto list = listOf("0 1 2 10 20 30 .5 7 300\n\n 1e-1\t-1 2 11 21 31 .25 8 310\r\n", everything, diagnostics);

  ASSERT_NE(list, nullptr);

  EXPECT_EQ(list->at, (std::vector<Vec3>{{0, 1, 2}, {0.1, -1, 2}}));
  EXPECT_EQ(list->velocity, (std::vector<Vec3>{{10, 20, 30}, {11, 21, 31}}));
  EXPECT_EQ(list->volume, (std::vector<double>{.5, .25}));
  EXPECT_EQ(list->color, (std::vector<double>{7, 8}));
  EXPECT_EQ(list->temperature, (std::vector<double>{300, 310}));
  EXPECT_TRUE(list->edges.empty());
  EXPECT_EQ(list->bounds().min, Vec3(0, -1, 2));
  EXPECT_EQ(list->bounds().max, Vec3(0.1, 1, 2));
}

TEST(ListedParticles, AreTheSameInBinaryFilesOfEitherByteOrder) {
  const std::vector<double> numbers{0, 1, 2, .5, -.1, -1, 2, .25};
  for (const bool little : {true, false}) {
    std::string bytes;
    for (const double number : numbers) {
      std::string eight(sizeof number, '\0');
      std::memcpy(eight.data(), &number, sizeof number);
      if (little != (std::endian::native == std::endian::little)) std::reverse(eight.begin(), eight.end());
      bytes += eight;
    }
    Diagnostics diagnostics;
    const auto list =
        listOf(bytes, fmt::format("<format>{}</format><var>p.volume</var>", little ? "lsb" : "msb"), diagnostics);
    ASSERT_NE(list, nullptr);
    EXPECT_EQ(list->at, (std::vector<Vec3>{{0, 1, 2}, {-.1, -1, 2}}));
    EXPECT_EQ(list->volume, (std::vector<double>{.5, .25}));
    EXPECT_EQ(problemsOf(bytes, "<format>lsb</format>"),
              (Lines{"0: has 64 bytes, which is not a multiple of 24: 3 numbers of 8 bytes per particle (x y z)"}));
  }
}

TEST(ListedParticles, RefuseLinesThatAreNoParticles) {
  EXPECT_EQ(problemsOf("0 1 2 3\n0 east 2\n0 1 2\n"),
            (Lines{"1: found 4 numbers, expected 3: x y z", "2: found 'east', expected a number"}));
  EXPECT_EQ(problemsOf("0 1 2 0\n", "<var>p.volume</var>"),
            (Lines{"1: p.volume: found 0, expected a positive number"}));
  EXPECT_EQ(problemsOf("0 1 2 -1\n", "<var>p.temperature</var>"),
            (Lines{"1: p.temperature: found -1, expected a number that is not negative"}));
  EXPECT_EQ(problemsOf("0 1 2 1 0 0 2 0 0 0 0 1\n", "<var>p.rvec1</var><var>p.rvec2</var><var>p.rvec3</var>"),
            (Lines{"1: p.rvec1, p.rvec2, p.rvec3: the particle has no volume"}));
  EXPECT_EQ(problemsOf("0 1\n", "<var>p.color</var><var>p.velocity</var>"),
            (Lines{"1: found 2 numbers, expected 7: x y z p.color p.velocity (3 numbers)"}));
  std::string many;
  for (int k = 0; k < 100; ++k) many += "0\n";
  EXPECT_EQ(problemsOf(many).size(), 10u) << "of one file, the first ten";
}

TEST(ListedParticles, RefuseUnknownVariablesAndLoneEdges) {
  EXPECT_EQ(problemsOf("0 0 0\n", "<var>p.volum</var>"),
            (Lines{"1: found 'p.volum', expected 'p.volume', 'p.temperature', 'p.color', 'p.velocity', 'p.rvec1', "
                   "'p.rvec2' or 'p.rvec3' (did you mean 'p.volume'?)"}));
  EXPECT_EQ(problemsOf("0 0 0 1 1\n", "<var>p.color</var><var>p.color</var>"), (Lines{"1: 'p.color' is given twice"}));
  EXPECT_EQ(problemsOf("0 0 0 1 1 1\n", "<var>p.rvec2</var>"),
            (Lines{"1: the edges of a particle are p.rvec1, p.rvec2 and p.rvec3; give all three"}));
}

TEST(ListedParticles, HaveTheSizeOfTheScene) {
  Body body = bodyOf("-.9 -.9 .05\n.9 .9 .05\n", "");
  const std::vector<Seed> seeds = seedsOf(body);

  ASSERT_EQ(seeds.size(), 2u);

  EXPECT_EQ(seeds[1].at, Vec3(.9, .9, .05));
  EXPECT_EQ(seeds[1].listed, 1u);
  EXPECT_EQ(seeds[1].volume, .25);
  EXPECT_EQ(seeds[1].domain.diagonal(), Vec3(.5, .5, 1));
}

TEST(ListedParticles, AreCubesOfTheirVolume) {
  Body body = bodyOf("0 0 .05 .001\n", "<var>p.volume</var>");
  const Seed seed = seedsOf(body).front();

  EXPECT_NEAR(seed.volume, .001 / (.25 * .5 * .1), 1e-15);
  EXPECT_NEAR(seed.domain(0, 0) * .25, .1, 1e-15) << "m";
  EXPECT_NEAR(seed.domain(1, 1) * .5, .1, 1e-15) << "m";
  EXPECT_NEAR(seed.domain(2, 2) * .1, .1, 1e-15) << "m";
}

TEST(ListedParticles, HaveTheirOwnEdgesOfEitherOrder) {
  for (const char* edges : {".1 .05 0 0 .2 0 0 0 .1", ".1 .05 0 0 0 .1 0 .2 0"}) {
    Body body =
        bodyOf(std::string("0 0 .05 ") + edges + "\n", "<var>p.rvec1</var><var>p.rvec2</var><var>p.rvec3</var>");
    const Seed seed = seedsOf(body).front();

    EXPECT_NEAR(seed.volume, .002 / (.25 * .5 * .1), 1e-15);
    EXPECT_NEAR((seed.domain.col(0) - Vec3(.4, .1, 0)).norm(), 0, 1e-15);
    EXPECT_NEAR((seed.domain.col(1) - Vec3(0, .4, 0)).norm(), 0, 1e-15);
  }
}

TEST(ListedParticles, AreTheShapeOfTheirBody) {
  std::string square;  // of 3 x 3 particles, .375 x .75 m
  for (int i = -1; i <= 1; ++i)
    for (int j = -1; j <= 1; ++j) square += fmt::format("{} {} .05\n", .125 * i, .25 * j);
  Body body = bodyOf(square, "");
  seedsOf(body);

  EXPECT_TRUE(body.shape->contains({.18, -.37, .05}));
  EXPECT_FALSE(body.shape->contains({.18, -.37, 7}));
  EXPECT_FALSE(body.shape->contains({.19, -.37, .05}));
  EXPECT_FALSE(body.shape->contains({.18, -.38, .05}));
}

TEST(ListedParticles, HaveTheSpacingOfTheirBoxes) {
  Body body = bodyOf("0 0 .05 .001\n.5 0 .05 .008\n", "<var>p.volume</var>");
  seedsOf(body);

  ASSERT_NE(body.list->halfAt({0, .04, .05}), nullptr);
  EXPECT_NEAR((*body.list->halfAt({0, .04, .05}))[0], .05, 1e-15);
  EXPECT_NEAR((*body.list->halfAt({.45, .04, .05}))[1], .1, 1e-15);
  EXPECT_EQ(body.list->halfAt({.1, 0, .05}), nullptr);
}

TEST(ListedParticles, RefuseParticlesOutsideTheGrid) {
  for (const char* place : {"1.1 0 .05\n", "0 0 .2\n"}) {
    Body body = bodyOf(place, "");
    EXPECT_THROW(seedsOf(body), InputError) << place;
  }
}

}  // namespace
}  // namespace tushar::mpm::solid
