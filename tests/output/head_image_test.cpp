#include "core/output/head_image.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "core/output/archive_hdf5_input.hpp"
#include "core/output/shared_hdf5.hpp"
#include "tests/output/snapshots.hpp"

namespace tushar::output {

namespace {

/// What a file contains: numbers, a text and an array of its own.
struct Contents {
  int step;
  double time;
  std::string text;
  std::vector<double> values;

  double same() const { return step < 100 ? 1.5 : 2.5; }
};

void write(const std::filesystem::path& file, const Contents& of) {
  const auto header = [&](Hdf5File& out) {
    out.attribute("/", "step", of.step);
    out.attribute("/", "time", of.time);
    out.text("/notes/text", of.text);
    out.dataset("/notes/same", {"same", "1", "", 1, std::vector<double>{of.same()}}, {1});
  };
  writeTogether({}, file, {}, header, {{"/a", {"a", "m", "an array", 1, of.values}, {of.values.size()}}});
}

void expectHeld(const std::filesystem::path& file, const Contents& of) {
  const Hdf5Input in(file);
  EXPECT_EQ(in.integer("/", "step"), of.step);
  EXPECT_EQ(in.real("/", "time"), of.time);
  EXPECT_EQ(in.text("/notes/text"), of.text);
  EXPECT_EQ(std::get<std::vector<double>>(in.dataset("/notes/same")).front(), of.same());
  EXPECT_EQ(std::get<std::vector<double>>(in.dataset("/a")), of.values);
  EXPECT_EQ(in.text("/a", "unit"), "m");
}

}  // namespace

TEST(HeadImage, GivesEachFileItsOwnNumbersAndTexts) {
  const TemporaryFolder here;
  const std::string text = "a text of thirty-one characters", other = "another one with as many of them";
  const std::vector<std::pair<std::string, Contents>> files{
      {"a.h5", {1, 0.25, text, {1, 2, 3}}},    {"b.h5", {2, -1e300, other.substr(0, text.size()), {4, 5, 6}}},
      {"shape.h5", {3, 0.5, text, {7}}},       {"text.h5", {4, 0.5, "short", {8, 9, 10}}},
      {"none.h5", {5, 0.5, "", {}}},           {"same.h5", {100, 0.5, text, {1, 2, 3}}},
      {"again.h5", {1, 0.25, text, {1, 2, 3}}}};
  for (const auto& [file, contents] : files) write(here / file, contents);

  for (const auto& [file, contents] : files) expectHeld(here / file, contents);
  EXPECT_EQ(read(here / "again.h5"), read(here / "a.h5"));
}

TEST(HeadImage, IsRefusedWhereAMarkIsNotThereOnce) {
  const TemporaryFolder here;
  std::ofstream(here / "zero") << "HDF5...." << '\0' << "mark, twice, twice";
  std::ofstream(here / "newer") << "HDF5...." << '\2' << "mark";

  EXPECT_TRUE(HeadImage::of(here / "zero", {"mark"}, {}).has_value());
  EXPECT_FALSE(HeadImage::of(here / "zero", {"mark", "twice"}, {}).has_value());
  EXPECT_FALSE(HeadImage::of(here / "zero", {"nowhere"}, {}).has_value());
  EXPECT_FALSE(HeadImage::of(here / "newer", {"mark"}, {}).has_value()) << "later formats have checksums";
  EXPECT_FALSE(HeadImage::of(here / "gone", {}, {}).has_value());
}

TEST(HeadImage, IsForgottenForNewerForms) {
  HeadImages images;
  for (const char* form : {"a", "b", "c", "d", "e"}) images.keep(form, HeadImage{});

  EXPECT_EQ(images.find("a"), nullptr);
  EXPECT_NE(images.find("b"), nullptr);
  EXPECT_NE(images.find("e"), nullptr);
}

}  // namespace tushar::output
