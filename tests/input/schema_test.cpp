#include "core/input/schema.hpp"

#include <sstream>

#include "core/input/refuse.hpp"
#include "tests/input/support.hpp"

namespace tushar::input {
namespace {

enum class Model { cellShare, tracked };

struct Redistribute {
  int most = 0;
  std::optional<std::string> label;
};

struct Save {
  std::string label;
  Model model = Model::cellShare;
  double weight = 0;
};

struct Scale {
  double factor = 0;
  std::string kind;
};

struct Gas {
  double cfl = 0;
  double gamma = 0;
  std::optional<Expression> pressure;
  Vec3 velocity = Vec3::Zero();
  Index3 res;
  bool on = false;
  Model model = Model::cellShare;
  std::optional<Model> other;
  std::optional<Redistribute> redistribute;
  Redistribute defaults;
  std::vector<Save> saves;
  std::vector<double> times;
  std::optional<Scale> scale;
  int shapes = -1;
};

const Schema<Redistribute>& redistributeSchema() {
  static const Schema<Redistribute> schema =
      Schema<Redistribute>("redistribute", "Splits and merges.")
          .value("most", &Redistribute::most, 8, "1", "particles per cell", between(1, 64))
          .optionalAttribute("label", &Redistribute::label, "", "its name");
  return schema;
}

const Schema<Save>& saveSchema() {
  static const Schema<Save> schema =
      Schema<Save>("save", "A variable to save.")
          .requiredAttribute("label", &Save::label, "", "the variable")
          .choiceAttribute("model", &Save::model, {{"share", Model::cellShare}, {"tracked", Model::tracked}},
                           Model::tracked, "how")
          .attributeValue("weight", &Save::weight, 1.0, "kg", "its weight", positive());
  return schema;
}

const Schema<Scale>& scaleSchema() {
  static const Schema<Scale> schema = Schema<Scale>("scale", "A factor.")
                                          .text(&Scale::factor, "1", "the factor", nonNegative())
                                          .requiredAttribute("kind", &Scale::kind, "", "of what");
  return schema;
}

const Schema<Gas>& gasSchema() {
  static const Choices<Model> models{{"cell_share", Model::cellShare}, {"tracked", Model::tracked}};
  static const Schema<Gas> schema =
      Schema<Gas>("gas", "The gas method.")
          .value("cfl", &Gas::cfl, 0.2125, "1", "Courant number", positive(), lessThan(1))
          .ours()
          .required("gamma", &Gas::gamma, "1", "ratio of specific heats", greaterThan(1.0))
          .optional("pressure", &Gas::pressure, "Pa", "initial pressure", atLeast(0))
          .value("velocity", &Gas::velocity, Vec3(0, 0, 0), "m/s", "initial velocity", atMost(10))
          .value("res", &Gas::res, Index3::filled(2), "", "particles per cell", positive())
          .value("on", &Gas::on, true, "", "whether it runs")
          .choice("model", &Gas::model, models, Model::cellShare, "volume model")
          .optionalChoice("other", &Gas::other, models, "another model")
          .section("redistribute", &Gas::redistribute, redistributeSchema())
          .section("defaults", &Gas::defaults, redistributeSchema(), "the same by default")
          .list("save", &Gas::saves, saveSchema())
          .values("time", &Gas::times, "s", "an output time", 0, nonNegative())
          .section("scale", &Gas::scale, scaleSchema())
          .ignored("doing", "means nothing here")
          .custom(
              "shape", [](Gas& gas, const Element& e, Diagnostics&) { gas.shapes = int(e.children("box").size()); },
              {"box", "sphere"}, "its shapes")
          .check([](const Gas& gas, const Element& element, Diagnostics& diagnostics) {
            if (gas.cfl > gas.gamma / 2) diagnostics.error(element, "cfl is above gamma/2");
          });
  return schema;
}

Gas gasOf(const std::string& inside) {
  const Document document = documentOf("<gas>" + inside + "</gas>");
  Diagnostics diagnostics;
  Gas gas = gasSchema().read(*document.root().child("gas"), diagnostics);
  EXPECT_EQ(told(diagnostics), Lines{});
  return gas;
}

/// Returns the problems of `inside`, which starts on line 2, column 1, of an otherwise complete gas.
Lines problemsOf(const std::string& inside, const std::string& needed = "<gamma>1.4</gamma>",
                 const std::string& tag = "<gas>") {
  const Document document = documentOf(tag + needed + "\n" + inside + "</gas>");
  Diagnostics diagnostics;
  gasSchema().read(*document.root().child("gas"), diagnostics);
  return told(diagnostics);
}

TEST(Schema, GivesDefaults) {
  const Gas gas = gasOf("<gamma>1.4</gamma>");

  EXPECT_EQ(gas.cfl, 0.2125);
  EXPECT_EQ(gas.gamma, 1.4);
  EXPECT_FALSE(gas.pressure);
  EXPECT_EQ(gas.res, Index3::filled(2));
  EXPECT_TRUE(gas.on);
  EXPECT_FALSE(gas.redistribute);
  EXPECT_EQ(gas.defaults.most, 8);
  EXPECT_EQ(gas.shapes, 0);
}

TEST(Schema, ReadsWhatIsGiven) {
  const Gas gas = gasOf(
      "<gamma>2</gamma><pressure>x</pressure><velocity>[1,2,3]</velocity><on>false</on><model>tracked</model>"
      "<other>cell_share</other><redistribute label='r'><most>9</most></redistribute><save label='p.x'/>"
      "<save label='p.v' model='share' weight='2'/><time>1</time><time>2</time><scale kind='k'>3</scale>"
      "<doing><any/>thing</doing><box/><sphere/><box/>");

  EXPECT_EQ((*gas.pressure)(Vec3(5, 0, 0)), 5);
  EXPECT_EQ(gas.velocity, Vec3(1, 2, 3));
  EXPECT_FALSE(gas.on);
  EXPECT_EQ(gas.model, Model::tracked);
  EXPECT_EQ(gas.other, Model::cellShare);
  EXPECT_EQ(gas.redistribute->most, 9);
  EXPECT_EQ(gas.redistribute->label, "r");
  ASSERT_EQ(gas.saves.size(), 2u);
  EXPECT_EQ(gas.saves[0].model, Model::tracked);
  EXPECT_EQ(gas.saves[1].weight, 2);
  EXPECT_EQ(gas.times, (std::vector<double>{1, 2}));
  EXPECT_EQ(gas.scale->factor, 3);
  EXPECT_EQ(gas.shapes, 2);
}

TEST(Schema, SaysThatATagIsUnknown) {
  EXPECT_EQ(problemsOf("<gama/>"),
            Lines{"s.ups:2:2: gas/gama: unknown tag <gama> in <gas> (did you mean 'gamma'?); allowed here: cfl, gamma, "
                  "pressure, velocity, res, on, model, other, redistribute, defaults, save, time, scale, doing, box, "
                  "sphere"});
}

TEST(Schema, DoesNotCallATagAllowedThatItRefuses) {
  Schema<Redistribute> schema("gas", "Splits and merges.");
  schema.value("most", &Redistribute::most, 8, "1", "particles per cell");
  refuseTag(schema, "least", "there is most");
  Diagnostics diagnostics;
  const Document document = documentOf("<gas><leest/><least/></gas>");
  schema.read(*document.root().child("gas"), diagnostics);
  EXPECT_EQ(told(diagnostics), (Lines{"s.ups:1:29: gas/leest: unknown tag <leest> in <gas>; allowed here: most",
                                      "s.ups:1:37: gas/least: is not available; there is most"}));
}

TEST(Schema, SaysThatNoTagIsAllowed) {
  EXPECT_EQ(problemsOf("<save label='a'><b/></save>"),
            Lines{"s.ups:2:18: gas/save/b: unknown tag <b> in <save>; no tag is allowed here"});
}

TEST(Schema, SaysThatAnAttributeIsUnknown) {
  EXPECT_EQ(problemsOf("<save label='a' modell='share'/>"),
            Lines{"s.ups:2:2: gas/save: unknown attribute 'modell' of <save> (did you mean 'model'?); allowed here: "
                  "label, model, weight"});
  EXPECT_EQ(problemsOf("<cfl unit='1'>0.1</cfl>"),
            Lines{"s.ups:2:2: gas/cfl: unknown attribute 'unit' of <cfl>; no attribute is allowed here"});
}

TEST(Schema, SaysThatATagIsMissing) {
  EXPECT_EQ(problemsOf("", ""), Lines{"s.ups:1:24: gas: missing tag <gamma> in <gas> (ratio of specific heats)"});
}

TEST(Schema, SaysThatAnAttributeIsMissing) {
  EXPECT_EQ(problemsOf("<save/>"), Lines{"s.ups:2:2: gas/save: missing attribute 'label' of <save> (the variable)"});
}

TEST(Schema, SaysThatATagIsGivenTwice) {
  EXPECT_EQ(problemsOf("<cfl>0.1</cfl>\n\n<cfl>0.2</cfl>"),
            Lines{"s.ups:4:2: gas/cfl: tag <cfl> is given twice, on line 2 and on line 4; only one is allowed"});
}

TEST(Schema, SaysThatTextIsNotAllowed) {
  EXPECT_EQ(problemsOf("oops"), Lines{"s.ups:1:24: gas: found text 'oops' in <gas>, where only tags are allowed"});
  EXPECT_EQ(problemsOf("<save label='a'>oops</save>"),
            Lines{"s.ups:2:2: gas/save: found text 'oops' in <save>, where none is allowed"});
}

TEST(Schema, SaysThatATagIsNotAllowedInAValue) {
  EXPECT_EQ(problemsOf("<cfl><b/></cfl>"),
            Lines{"s.ups:2:7: gas/cfl/b: found tag <b> in <cfl>, where only a value is allowed"});
}

TEST(Schema, SaysThatAValueHasTheWrongForm) {
  EXPECT_EQ(problemsOf("<cfl>abc</cfl>"), Lines{"s.ups:2:2: gas/cfl: found 'abc', expected a number"});
  EXPECT_EQ(problemsOf("<on/>"), Lines{"s.ups:2:2: gas/on: found nothing, expected true or false"});
  EXPECT_EQ(problemsOf("<scale kind='k'>a</scale>"), Lines{"s.ups:2:2: gas/scale: found 'a', expected a number"});
  EXPECT_EQ(problemsOf("<save label='a' weight='b'/>"),
            Lines{"s.ups:2:2: gas/save: attribute 'weight': found 'b', expected a number"});
}

TEST(Schema, SaysWhatValuesAreAllowed) {
  EXPECT_EQ(problemsOf("<cfl>0</cfl>"), Lines{"s.ups:2:2: gas/cfl: found '0', expected a value greater than 0"});
  EXPECT_EQ(problemsOf("<cfl>1</cfl>"), Lines{"s.ups:2:2: gas/cfl: found '1', expected a value less than 1"});
  EXPECT_EQ(problemsOf("<pressure>-1</pressure>"),
            Lines{"s.ups:2:2: gas/pressure: found '-1', expected a value of at least 0 Pa"});
  EXPECT_EQ(problemsOf("<velocity>[1,2,11]</velocity>"),
            Lines{"s.ups:2:2: gas/velocity: found '[1,2,11]', expected a value of at most 10 m/s"});
  EXPECT_EQ(problemsOf("<res>[1,0,1]</res>"),
            Lines{"s.ups:2:2: gas/res: found '[1,0,1]', expected a value greater than 0"});
  EXPECT_EQ(problemsOf("<defaults><most>65</most></defaults>"),
            Lines{"s.ups:2:12: gas/defaults/most: found '65', expected a value from 1 to 64"});
  EXPECT_EQ(problemsOf("<save label='a' weight='0'/>"),
            Lines{"s.ups:2:2: gas/save: attribute 'weight': found '0', expected a value greater than 0 kg"});
}

TEST(Schema, SaysWhatWordsAreAllowed) {
  EXPECT_EQ(
      problemsOf("<model>trackd</model>"),
      Lines{"s.ups:2:2: gas/model: found 'trackd', expected 'cell_share' or 'tracked' (did you mean 'tracked'?)"});
  EXPECT_EQ(problemsOf("<model/>"), Lines{"s.ups:2:2: gas/model: found nothing, expected 'cell_share' or 'tracked'"});
  EXPECT_EQ(problemsOf("<save label='a' model='x'/>"),
            Lines{"s.ups:2:2: gas/save: attribute 'model': found 'x', expected 'share' or 'tracked'"});
}

TEST(Schema, SaysHowManyTagsAreNeeded) {
  struct Curve {
    std::vector<double> points;
  };
  const Schema<Curve> schema = std::move(Schema<Curve>("curve", "").values("point", &Curve::points, "s", "a time", 2));
  const Document document = documentOf("<curve><point>1</point></curve>");
  Diagnostics diagnostics;

  schema.read(*document.root().child("curve"), diagnostics);

  EXPECT_EQ(told(diagnostics), Lines{"s.ups:1:24: curve: <curve> needs at least 2 tags <point>, found 1 (a time)"});
}

TEST(Schema, RefusesWhatFunctionsDoNotLookAt) {
  struct Flow {};
  Schema<Flow> schema("flow", "");
  const auto readNothing = [](Flow&, const Element&, Diagnostics&) {};
  schema.custom("speed", readNothing, {"speed"}, "").forms({typeForm({"speed"}, "number")});
  schema.custom("model", readNothing, {"model"}, "").forms({anyForm({"model"}, {{"type", {"a"}}})});
  schema.custom("law", readNothing, {"law"}, "").forms({onceForm("law", [] { return std::vector<Alternative>(); })});
  const auto problemsOfFlow = [&](const std::string& inside) {
    const Document document = documentOf("<flow>" + inside + "</flow>");
    Diagnostics diagnostics;
    schema.read(*document.root().child("flow"), diagnostics);
    return told(diagnostics);
  };

  EXPECT_EQ(problemsOfFlow("<speed>1</speed><model type='a'><b/></model><law c='d'/>"), Lines{});
  EXPECT_EQ(problemsOfFlow("<speed unit='m'><b/></speed>").size(), 2u);
  EXPECT_EQ(problemsOfFlow("<speed>1</speed>\n<speed>1</speed>"),
            Lines{"s.ups:2:2: flow/speed: tag <speed> is given twice, on line 1 and on line 2; only one is allowed"});
  EXPECT_EQ(problemsOfFlow("<law/>\n<law/>"),
            Lines{"s.ups:2:2: flow/law: tag <law> is given twice, on line 1 and on line 2; only one is allowed"});
  ASSERT_EQ(problemsOfFlow("<model type='a' kind='b'/>").size(), 1u);
  EXPECT_NE(problemsOfFlow("<model type='a' kind='b'/>")[0].find("unknown attribute 'kind' of <model>"),
            std::string::npos);
}

TEST(Schema, MarksAllTagsOfASection) {
  struct Flow {
    double speed = 0;
  };
  Schema<Flow> schema("flow", "");
  schema.allOurs().value("speed", &Flow::speed, 1, "m/s", "how fast").ignored("colour", "means nothing");
  std::ostringstream out;
  schema.describe(out);
  EXPECT_EQ(out.str(),
            "<flow>: \n  <speed> — number in m/s, default 1: how fast [Tushar's own]\n"
            "  <colour> — ignored: means nothing [Tushar's own]\n");
}

TEST(Schema, SaysWhereAWordIsThatIsNotHere) {
  struct Steps {
    int order = 0;
  };
  const Schema<Steps> schema = std::move(Schema<Steps>("steps", "")
                                             .choice("order", &Steps::order, {{"first", 1}, {"second", 2}}, 1, "")
                                             .elsewhere("third", "the component fine has it"));
  for (const auto& [word, hint] : {std::pair{"third", ": the component fine has it"}, std::pair{"nine", ""}}) {
    const Document document = documentOf("<steps><order>" + std::string(word) + "</order></steps>");
    Diagnostics diagnostics;
    schema.read(*document.root().child("steps"), diagnostics);
    ASSERT_EQ(told(diagnostics).size(), 1u);
    EXPECT_TRUE(told(diagnostics)[0].ends_with("expected 'first' or 'second'" + std::string(hint)));
  }
}

TEST(Schema, ChecksValuesAgainstEachOther) {
  EXPECT_EQ(problemsOf("<cfl>0.9</cfl>"), Lines{"s.ups:1:24: gas: cfl is above gamma/2"});
}

TEST(Schema, ChecksNothingAfterAProblem) {
  EXPECT_EQ(problemsOf("<cfl>0.9</cfl><on>x</on>"), Lines{"s.ups:2:16: gas/on: found 'x', expected true or false"});
}

TEST(Schema, ReportsEveryProblemAtOnce) {
  const Lines lines = problemsOf("<cfl>a</cfl>\n<on>b</on>\n<redistribute><most>0</most></redistribute>\n<zzz/>", "");

  EXPECT_EQ(lines.size(), 5u);
}

TEST(Schema, PointsToTheOptionThatOverrides) {
  Document document = documentOf("<gas><gamma>1.4</gamma><save label='a'/></gas>");
  Diagnostics diagnostics;
  document.set("gas/cfl=-1", diagnostics);
  document.set("gas/save/@weight=0", diagnostics);
  document.set("gas/gama=2", diagnostics);

  gasSchema().read(*document.root().child("gas"), diagnostics);

  ASSERT_EQ(told(diagnostics).size(), 3u);
  EXPECT_EQ(told(diagnostics)[1], "--set gas/cfl=-1: gas/cfl: found '-1', expected a value greater than 0");
  EXPECT_EQ(told(diagnostics)[2],
            "--set gas/save/@weight=0: gas/save: attribute 'weight': found '0', expected a value greater than 0 kg");
}

TEST(Schema, DescribesItself) {
  std::ostringstream out;

  gasSchema().describe(out);

  EXPECT_EQ(out.str(),
            "<gas>: The gas method.\n"
            "  <cfl> — number, greater than 0 and less than 1, default 0.2125: Courant number [Tushar's own]\n"
            "  <gamma> — number, greater than 1, required: ratio of specific heats\n"
            "  <pressure> — formula in x, y, z, t in Pa, at least 0, optional: initial pressure\n"
            "  <velocity> — numbers [a,b,c] in m/s, at most 10, default [0,0,0]: initial velocity\n"
            "  <res> — integers [a,b,c], greater than 0, default [2,2,2]: particles per cell\n"
            "  <on> — true or false, default true: whether it runs\n"
            "  <model> — 'cell_share' or 'tracked', default cell_share: volume model\n"
            "  <other> — 'cell_share' or 'tracked', optional: another model\n"
            "  <redistribute> — optional: Splits and merges.\n"
            "    <most> — integer, from 1 to 64, default 8: particles per cell\n"
            "    label= — text, optional: its name\n"
            "  <defaults> — optional: the same by default\n"
            "    <most> — integer, from 1 to 64, default 8: particles per cell\n"
            "    label= — text, optional: its name\n"
            "  <save> — any number: A variable to save.\n"
            "    label= — text, required: the variable\n"
            "    model= — 'share' or 'tracked', default tracked: how\n"
            "    weight= — number in kg, greater than 0, default 1: its weight\n"
            "  <time> — number in s, at least 0, any number: an output time\n"
            "  <scale> — optional: A factor.\n"
            "    (text) — number, at least 0, required: the factor\n"
            "    kind= — text, required: of what\n"
            "  <doing> — ignored: means nothing here\n"
            "  <box>, <sphere>: its shapes\n");
}

}  // namespace
}  // namespace tushar::input
