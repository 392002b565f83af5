#include "core/simulation/catalogue.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace tushar::simulation {

namespace {

ComponentKind component(const std::string& name) {
  ComponentKind kind;
  kind.name = name;
  return kind;
}

AnalysisKind analysis(const std::string& name) {
  AnalysisKind kind;
  kind.name = name;
  return kind;
}

/// A module that counts how often it is loaded.
std::function<Catalogue()> counting(int& loads, const Catalogue& brought) {
  return [&loads, brought] {
    ++loads;
    return brought;
  };
}

}  // namespace

TEST(Catalogue, LoadsAModuleOnceWhenOneOfItsNamesIsAskedFor) {
  int waves = 0, sands = 0;
  Catalogue catalogue;
  catalogue.addModule({"water", {"wave"}, {"crest"}}, counting(waves, {{component("wave")}, {analysis("crest")}}));
  catalogue.addModule({"ground", {"sand"}, {}}, counting(sands, {{component("sand")}, {}}));

  EXPECT_EQ(catalogue.componentNames(), (std::vector<std::string>{"sand", "wave"}));
  EXPECT_EQ(catalogue.analysisNames(), std::vector<std::string>{"crest"});
  EXPECT_EQ(catalogue.component("water"), nullptr);
  EXPECT_EQ(waves + sands, 0);

  EXPECT_EQ(catalogue.component("wave")->name, "wave");
  EXPECT_EQ(catalogue.analysis("crest")->name, "crest");
  EXPECT_EQ(catalogue.component("wave")->name, "wave");
  EXPECT_EQ(waves, 1);
  EXPECT_EQ(sands, 0);

  EXPECT_EQ(catalogue.components().size(), 2U);
  EXPECT_EQ(waves, 1);
  EXPECT_EQ(sands, 1);
}

TEST(Catalogue, KeepsWhatItGaveWhileOtherModulesAreLoaded) {
  int loads = 0;
  Catalogue catalogue({component("heat")}, {});
  catalogue.addModule({"water", {"wave"}, {}}, counting(loads, {{component("wave")}, {}}));

  const ComponentKind* heat = catalogue.component("heat");
  const ComponentKind* wave = catalogue.component("wave");
  catalogue.components();

  EXPECT_EQ(catalogue.component("heat"), heat);
  EXPECT_EQ(catalogue.component("wave"), wave);
}

TEST(Catalogue, RefusesANameThatIsTaken) {
  int loads = 0;
  const auto load = counting(loads, {});
  Catalogue catalogue({component("heat")}, {analysis("norm")});

  EXPECT_THROW(catalogue.add({{component("heat")}, {}}), std::invalid_argument);
  EXPECT_THROW(catalogue.add({{}, {analysis("norm")}}), std::invalid_argument);
  EXPECT_THROW(catalogue.addModule({"other", {"heat"}, {}}, load), std::invalid_argument);
  EXPECT_THROW(catalogue.addModule({"other", {"wave"}, {"norm"}}, load), std::invalid_argument);
  EXPECT_THROW(Catalogue({component("wave"), component("wave")}, {}), std::invalid_argument);
  EXPECT_EQ(loads, 0);
}

TEST(Catalogue, AddsToAModuleThatIsNotLoadedYet) {
  int loads = 0;
  Catalogue catalogue;
  catalogue.addModule({"water", {"wave"}, {}}, counting(loads, {{component("wave")}, {}}));

  catalogue.add({{component("sand")}, {}});
  EXPECT_THROW(catalogue.add({{component("wave")}, {}}), std::invalid_argument);

  EXPECT_EQ(loads, 0);
  EXPECT_EQ(catalogue.component("sand")->name, "sand");
}

TEST(Catalogue, SaysThatAModuleLacksWhatItShouldHave) {
  int loads = 0;
  Catalogue catalogue;
  catalogue.addModule({"water", {"wave"}, {"crest"}}, counting(loads, {{component("wave")}, {}}));

  try {
    catalogue.analysis("crest");
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "the module that should define 'crest' does not define it");
  }
}

}  // namespace tushar::simulation
