#include "core/input/values.hpp"

#include "tests/input/support.hpp"

namespace tushar::input {
namespace {

TEST(Values, ReadListsOfThreeIntegers) {
  using Triples = std::vector<Index3>;
  EXPECT_EQ(*parse<Triples>("[[8,8,1]]"), (Triples{{{8, 8, 1}}}));
  EXPECT_EQ(*parse<Triples>(" [ [8, 8,1] ,[4,4,1]] "), (Triples{{{8, 8, 1}}, {{4, 4, 1}}}));
  EXPECT_EQ(*parse<Triples>("[8,8,1]"), (Triples{{{8, 8, 1}}}));
  EXPECT_EQ(toText(Triples{{{8, 8, 1}}, {{4, 4, 1}}}), "[[8,8,1],[4,4,1]]");
  EXPECT_EQ(parse<Triples>("8").problem, "found '8', expected lists of three integers, such as [[1,2,3]]");
  EXPECT_EQ(parse<Triples>("[]").problem, "found '[]', expected lists of three integers, such as [[1,2,3]]");
  EXPECT_EQ(parse<Triples>("[[8,8]]").problem, "in '[[8,8]]': found '[8,8]', expected three integers, such as [1,2,3]");
  EXPECT_EQ(parse<Triples>("[[8,8,1],4]").problem,
            "in '[[8,8,1],4]': found '4', expected three integers, such as [1,2,3]");
}

TEST(Values, ReadBooleans) {
  EXPECT_TRUE(*parse<bool>(" true "));
  EXPECT_FALSE(*parse<bool>("false"));
  EXPECT_EQ(parse<bool>("yes").problem, "found 'yes', expected true or false");
}

TEST(Values, ReadIntegers) {
  EXPECT_EQ(*parse<int>("+10"), 10);
  EXPECT_EQ(*parse<int>("-2147483648"), -2147483647 - 1);
  EXPECT_EQ(*parse<std::int64_t>("9000000000"), 9000000000);
}

TEST(Values, RefuseWhatIsNoInteger) {
  EXPECT_EQ(parse<int>("2.0").value, 2);
  EXPECT_EQ(parse<int>("-4.").value, -4);
  EXPECT_EQ(parse<int>(".0").problem, "found '.0', expected an integer");
  EXPECT_EQ(parse<int>("10.5").problem, "found '10.5', expected an integer");
  EXPECT_EQ(parse<int>("+-1").problem, "found '+-1', expected an integer");
  EXPECT_EQ(parse<int>("").problem, "found nothing, expected an integer");
}

TEST(Values, NameIntegersThatDoNotFit) {
  EXPECT_EQ(parse<int>("3000000000").problem, "found '3000000000', which is above the largest integer, 2147483647");
  EXPECT_EQ(parse<int>("-3000000000").problem, "found '-3000000000', which is below the smallest integer, -2147483648");
}

TEST(Values, ReadNumbers) {
  EXPECT_EQ(*parse<double>("1e3"), 1000);
  EXPECT_EQ(*parse<double>(".5"), 0.5);
  EXPECT_EQ(*parse<double>(" +2. "), 2);
  EXPECT_EQ(*parse<double>("-1.0E-8"), -1e-8);
}

TEST(Values, RefuseWhatIsNoNumber) {
  EXPECT_EQ(parse<double>("abc").problem, "found 'abc', expected a number");
  EXPECT_EQ(parse<double>("1.5m").problem, "found '1.5m', expected a number");
  EXPECT_EQ(parse<double>("").problem, "found nothing, expected a number");
  EXPECT_EQ(parse<double>("nan").problem, "found 'nan', expected a finite number");
  EXPECT_EQ(parse<double>("-inf").problem, "found '-inf', expected a finite number");
  EXPECT_EQ(parse<double>("1e999").problem, "found '1e999', which is outside the range of a double");
}

TEST(Values, ReadText) {
  EXPECT_EQ(*parse<std::string>("  a b "), "a b");
  EXPECT_EQ(parse<std::string>(" ").problem, "found nothing, expected text");
}

TEST(Values, ReadVectorsWithBlanksAnywhere) {
  EXPECT_EQ(*parse<Vec3>(" [ 1 ,2.5,\n -3e1 ] "), Vec3(1, 2.5, -30));
  EXPECT_EQ(*parse<Index3>("[1, 2,3]"), (Index3{{1, 2, 3}}));
}

TEST(Values, RefuseWhatIsNoVector) {
  for (const std::string text : {"1,2,3", "[1,2]"})
    EXPECT_EQ(parse<Vec3>(text).problem, "found '" + text + "', expected three numbers, such as [1,2,3]");
  EXPECT_EQ(parse<Vec3>("[1,,3]").problem, "in '[1,,3]': found nothing, expected a number");
  EXPECT_EQ(parse<Vec3>("").problem, "found nothing, expected three numbers, such as [1,2,3]");
  EXPECT_EQ(parse<Index3>("[1,2.5,3]").problem, "in '[1,2.5,3]': found '2.5', expected an integer");
  EXPECT_EQ(parse<Index3>("[1]").problem, "found '[1]', expected three integers, such as [1,2,3]");
}

TEST(Values, ReadLists) {
  EXPECT_EQ(*parse<std::vector<double>>("[1, .5]"), (std::vector<double>{1, 0.5}));
  EXPECT_EQ(*parse<std::vector<int>>("[]"), std::vector<int>{});
  EXPECT_EQ(*parse<std::vector<std::string>>("[xminus, yplus]"), (std::vector<std::string>{"xminus", "yplus"}));
}

TEST(Values, ReadANumberWithoutBracketsAsAListOfOne) {
  EXPECT_EQ(*parse<std::vector<double>>(" .5 "), (std::vector<double>{0.5}));
  EXPECT_EQ(*parse<std::vector<int>>("0"), std::vector<int>{0});
}

TEST(Values, RefuseWhatIsNoList) {
  EXPECT_EQ(parse<std::vector<double>>("a").problem, "found 'a', expected numbers, as [1,2,3]");
  EXPECT_EQ(parse<std::vector<int>>("1,2").problem, "found '1,2', expected integers, as [1,2,3]");
  EXPECT_EQ(parse<std::vector<std::string>>("a").problem, "found 'a', expected words, as [a,b,c]");
}

TEST(Values, AreWrittenAsTheyAreRead) {
  EXPECT_EQ(toText(0.1), "0.1");
  EXPECT_EQ(toText(Vec3(1, 0.5, -2)), "[1,0.5,-2]");
  EXPECT_EQ(toText(Index3{{1, 2, 3}}), "[1,2,3]");
  EXPECT_EQ(toText(false), "false");
}

}  // namespace
}  // namespace tushar::input
