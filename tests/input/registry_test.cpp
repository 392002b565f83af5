#include "core/input/registry.hpp"

#include <sstream>

#include "tests/input/support.hpp"

namespace tushar::input {
namespace {

struct Contact {
  double mu = 0;
};

Registry<Contact, double> contacts() {
  Registry<Contact, double> registry;
  registry.add("null", "No contact.", [](double) { return std::make_unique<Contact>(); });
  registry.add(
      "friction", "Coulomb's law.", [](double mu) { return std::make_unique<Contact>(Contact{mu}); },
      [](std::ostream& out, int indent) { out << std::string(static_cast<std::size_t>(indent), ' ') << "<mu>\n"; });
  return registry;
}

TEST(Registry, PassesTheArgumentsOn) {
  const auto registry = contacts();

  EXPECT_EQ(registry.find("friction")->create(0.3)->mu, 0.3);
  EXPECT_EQ(registry.names(), (Lines{"friction", "null"}));
}

TEST(Registry, SaysWhatIsKnown) {
  const auto registry = contacts();

  EXPECT_EQ(registry.find("fricton"), nullptr);
  EXPECT_EQ(registry.unknown("contact", "fricton"),
            "unknown contact 'fricton', expected 'friction' or 'null' (did you mean 'friction'?)");
  EXPECT_EQ(Registry<Contact>().unknown("contact", "x"), "unknown contact 'x'; none is known");
}

TEST(Registry, DescribesAllOfThem) {
  std::ostringstream out;

  contacts().describe(out, 1);

  EXPECT_EQ(out.str(), " friction: Coulomb's law.\n   <mu>\n null: No contact.\n");
}

}  // namespace
}  // namespace tushar::input
