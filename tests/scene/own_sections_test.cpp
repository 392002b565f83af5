#include <algorithm>

#include "core/input/schema_base.hpp"
#include "core/scene/scene.hpp"
#include "tests/input/support.hpp"

namespace tushar::scene {

TEST(Regridder, TakesTheSectionOfAComponentOfOnesOwn) {
  simulation::ComponentKind flow;
  flow.name = "my_flow";
  flow.sections = {"MyFlow", "Tables"};
  flow.takesLevels = true;
  const auto problemsOf = [&](const std::string& section, const simulation::ComponentKind* kind) {
    input::Diagnostics diagnostics;
    const input::Document document =
        input::documentOf("<AMR><" + section + "><do_Refluxing>false</do_Refluxing></" + section + "></AMR>");
    const AmrSettings read = readAmr(*document.root().child("AMR"), kind, diagnostics);
    EXPECT_EQ(read.regrid.refluxes, diagnostics.any());
    return diagnostics.size();
  };

  EXPECT_EQ(problemsOf("MyFlow", &flow), 0u);
  EXPECT_EQ(problemsOf("MyFlow", nullptr), 0u) << "the component is not known: it may have such a section";
  EXPECT_EQ(problemsOf("Tables", &flow), 1u);
  EXPECT_EQ(problemsOf("ICE", &flow), 1u);
  flow.amrSections = {"ICE"};
  EXPECT_EQ(problemsOf("ICE", &flow), 0u);
  flow.amrSections = {"MyFlow"};
  EXPECT_EQ(problemsOf("MyFlow", &flow), 0u);
  const std::vector<std::string> tags = amrForm(flow).tagNames();
  EXPECT_EQ(std::count(tags.begin(), tags.end(), "MyFlow"), 1) << "the component has named its own section";
  flow.amrSections.clear();
  flow.takesLevels = false;
  EXPECT_EQ(problemsOf("MyFlow", &flow), 1u);
}

}  // namespace tushar::scene
