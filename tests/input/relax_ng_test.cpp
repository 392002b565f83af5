#include "core/input/relax_ng.hpp"

#include <gtest/gtest.h>

#include <pugixml.hpp>
#include <regex>
#include <sstream>

#include "core/input/refuse.hpp"
#include "core/input/value_types.hpp"
#include "core/input/xml_schema.hpp"

namespace tushar::input {

namespace {

struct Gas {
  double gamma = 0;
  std::vector<Index3> res;
  int kind = 0;
};

const Schema<Gas>& gasSchema() {
  static const Schema<Gas> schema = [] {
    Schema<Gas> gas("gas", "A gas.");
    gas.required("gamma", &Gas::gamma, "1", "ratio of specific heats", greaterThan(1))
        .values("res", &Gas::res, "1", "particles per cell", 0)
        .choiceAttribute("kind", &Gas::kind, {{"air", 0}, {"water", 1}}, 0, "which");
    refuseTag(gas, "gone", "nothing");
    return gas;
  }();
  return schema;
}

TagForm gasForm() {
  return sectionForm({"gas"}, [] { return std::vector<Alternative>{{&gasSchema(), {{"kind", {"air"}}}}}; });
}

pugi::xml_document written(void (*write)(std::ostream&, const TagForm&, const std::string&)) {
  std::ostringstream out;
  write(out, gasForm(), " made for a test ");
  pugi::xml_document file;
  EXPECT_TRUE(file.load_string(out.str().c_str()));
  return file;
}

/// Whether the pattern of a type matches a text with collapsed white space.
bool takes(const std::string& type, const std::string& text) {
  return std::regex_match(text, std::regex(valueTypeOf(type).pattern));
}

}  // namespace

TEST(RelaxNg, DefinesATagWithWhatItsSchemaDeclares) {
  const pugi::xml_document file = written(writeRelaxNg);
  const auto element = file.select_node("//define[@name='gas-tag']/element").node();
  EXPECT_STREQ(element.select_node("attribute[@name='kind']/value").node().child_value(), "air");
  EXPECT_TRUE(element.select_node("choice/ref[@name='gamma-tag'] | choice/interleave/ref[@name='gamma-tag']"));
  EXPECT_TRUE(element.select_node("choice/interleave/zeroOrMore/ref[@name='res-tag']"));
  EXPECT_TRUE(element.select_node("choice/interleave[oneOrMore/ref/@name='include']/optional/ref[@name='gamma-tag']"));
  EXPECT_FALSE(file.select_node("//element[@name='gone']"));
  EXPECT_STREQ(file.select_node("//define[@name='gamma-tag']/element/a:documentation").node().child_value(),
               "number, greater than 1, required: ratio of specific heats");
}

TEST(XmlSchema, HasAllTagsInAnyOrder) {
  const pugi::xml_document file = written(writeXmlSchema);
  const auto type = file.select_node("//xs:complexType[@name='gas-tag']").node();
  EXPECT_STREQ(type.child("xs:choice").attribute("maxOccurs").value(), "unbounded");
  EXPECT_TRUE(type.select_node("xs:choice/xs:element[@name='gamma']"));
  EXPECT_TRUE(type.select_node("xs:attribute[@name='kind']//xs:enumeration[@value='air']"));
  EXPECT_FALSE(type.select_node("xs:choice/xs:element[@name='gone']"));
}

TEST(ValueTypes, TakeWhatIsReadAndNothingElse) {
  for (const char* text :
       {"1", "+1", "-1.5", ".5", "5.", "1e5", "1E-5", "-.5e+3", "", "1,5", "soon", "1e", "0x1", "--1"})
    EXPECT_EQ(takes("number", text), parse<double>(text).value.has_value()) << text;
  for (const char* text : {"1", "+1", "-1", "2.0", "2.", "2.5", "", "x", "1e3", ".0"})
    EXPECT_EQ(takes("integer", text), parse<int>(text).value.has_value()) << text;
  for (const char* text : {"[1,2,3]", "[ 1 , 2. , -3e1 ]", "[1,2]", "1,2,3", "[a,2,3]", "[1,2,3,4]"})
    EXPECT_EQ(takes("numbers [a,b,c]", text), parse<Vec3>(text).value.has_value()) << text;
  for (const char* text : {"[]", "[1]", "[1, 2]", "[1;2]", "1"})
    EXPECT_EQ(takes("numbers [a,b,…]", text), parse<std::vector<double>>(text).value.has_value()) << text;
  for (const char* text : {"true", "false", "yes", ""})
    EXPECT_EQ(takes("true or false", text), parse<bool>(text).value.has_value()) << text;
}

TEST(ValueTypes, TakeEveryFormula) {
  for (const char* text : {"1", "x", "sin(pi*x)+1", "x<0.5 ? 1 : 2", "1 + 2", "-(1)", "1e5*t", "1+", "[1,2,3]"})
    EXPECT_EQ(takes("formula in x, y, z, t", text), parse<Expression>(text).value.has_value()) << text;
  for (const char* text : {"[x,max(y,1),0]", "[0, 0, 0]"})
    EXPECT_EQ(takes("formulas [a,b,c] in x, y, z, t", text), parse<VectorExpression>(text).value.has_value()) << text;
}

}  // namespace tushar::input
