#include "core/input/expression.hpp"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <unordered_map>
#include <vector>

#include "core/input/text.hpp"
#include "core/input/values.hpp"

namespace tushar::input {

namespace {

/// A compiled formula and the variables that it reads, for one thread.
struct Compiled {
  explicit Compiled(const std::string& text) {
    parser.DefineVar("x", &at[0]);
    parser.DefineVar("y", &at[1]);
    parser.DefineVar("z", &at[2]);
    parser.DefineVar("t", &at[3]);
    parser.DefineConst("pi", std::numbers::pi);
    parser.DefineConst("e", std::numbers::e);
    parser.SetExpr(text);
  }
  Compiled(const Compiled&) = delete;
  Compiled& operator=(const Compiled&) = delete;

  std::array<double, 4> at{};
  mu::Parser parser;
};

/// The formulas compiled by this thread, by index of the program; they are kept until the thread ends.
std::unordered_map<std::uint64_t, Compiled>& compiledHere() {
  thread_local std::unordered_map<std::uint64_t, Compiled> programs;
  return programs;
}

std::string notAFormula(std::string_view text, const std::string& why) {
  return fmt::format("found '{}', expected a formula in x, y, z and t: {}", text, why);
}

/// Whether a formula contains a lone `=`, which would assign to a variable.
bool assigns(std::string_view text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '=') continue;
    const bool partOfComparison = (i > 0 && std::string_view("<>!=").find(text[i - 1]) != std::string_view::npos) ||
                                  (i + 1 < text.size() && text[i + 1] == '=');
    if (!partOfComparison) return true;
  }
  return false;
}

bool looksLikeNumber(const std::string& text) { return text.find_first_not_of("+-.0123456789eE") == std::string::npos; }

}  // namespace

/// Each thread compiles the formula when it first evaluates it.
struct Expression::Program {
  explicit Program(std::string formula) : text(std::move(formula)) {
    static std::atomic<std::uint64_t> made{0};
    number = made++;
  }

  Compiled& compiled() const { return compiledHere().try_emplace(number, text).first->second; }

  std::string text;
  std::uint64_t number;
};

Expression::Expression(double value) : text_(toText(value)), value_(value) {}
Expression::Expression(const Expression& other)
    : text_(other.text_),
      value_(other.value_),
      constant_(other.constant_),
      dependsOnTime_(other.dependsOnTime_),
      where_(other.where_),
      program_(constant_ ? nullptr : std::make_unique<Program>(text_)) {}
Expression::Expression(Expression&& other) noexcept = default;
Expression::~Expression() = default;

Expression& Expression::operator=(Expression other) noexcept {
  text_ = std::move(other.text_);
  value_ = other.value_;
  constant_ = other.constant_;
  dependsOnTime_ = other.dependsOnTime_;
  where_ = std::move(other.where_);
  program_ = std::move(other.program_);
  return *this;
}

Parsed<Expression> Expression::parse(std::string_view given) {
  Expression out;
  out.text_ = trimmed(given);
  if (out.text_.empty()) return Parsed<Expression>::wrong("found nothing, expected a number or a formula");
  if (const auto number = input::parse<double>(out.text_)) {
    out.value_ = *number;
    return Parsed<Expression>::ok(std::move(out));
  } else if (looksLikeNumber(out.text_)) {
    return Parsed<Expression>::wrong(number.problem);
  }
  if (assigns(out.text_)) return Parsed<Expression>::wrong(notAFormula(out.text_, "'=' would assign to a variable"));
  try {
    out.program_ = std::make_unique<Program>(out.text_);
    mu::Parser& parser = out.program_->compiled().parser;
    int results = 0;
    out.value_ = parser.Eval(results)[0];
    if (results != 1) return Parsed<Expression>::wrong(notAFormula(out.text_, "it has several results"));
    const auto& used = parser.GetUsedVar();
    out.constant_ = used.empty();
    out.dependsOnTime_ = used.count("t") > 0;
  } catch (const mu::ParserError& error) {
    return Parsed<Expression>::wrong(notAFormula(out.text_, trimmed(error.GetMsg())));
  }
  if (out.constant_ && !std::isfinite(out.value_)) {
    return Parsed<Expression>::wrong(fmt::format("found '{}', which is not a finite number", out.text_));
  }
  return Parsed<Expression>::ok(std::move(out));
}

double Expression::evaluate(const Vec3& x, double t) const {
  Compiled& compiled = program_->compiled();
  compiled.at = {x[0], x[1], x[2], t};
  return compiled.parser.Eval();
}

VectorExpression::VectorExpression(const Vec3& value) : components_{value[0], value[1], value[2]} {}

Parsed<VectorExpression> VectorExpression::parse(std::string_view given) {
  const std::string text = trimmed(given);
  const bool bracketed = text.size() >= 2 && text.front() == '[' && text.back() == ']';
  const auto parts = splitAtCommas(bracketed ? text.substr(1, text.size() - 2) : std::string());
  if (parts.size() != 3) {
    const std::string found = text.empty() ? "nothing" : "'" + text + "'";
    return Parsed<VectorExpression>::wrong(fmt::format("found {}, expected three formulas, such as [a,b,c]", found));
  }
  VectorExpression out;
  for (std::size_t d = 0; d < 3; ++d) {
    Parsed<Expression> component = Expression::parse(parts[d]);
    if (!component) return Parsed<VectorExpression>::wrong(fmt::format("in '{}': {}", text, component.problem));
    out.components_[d] = *std::move(component.value);
  }
  return Parsed<VectorExpression>::ok(std::move(out));
}

bool VectorExpression::isConstant() const {
  return std::all_of(components_.begin(), components_.end(), [](const Expression& c) { return c.isConstant(); });
}

bool VectorExpression::dependsOnTime() const {
  return std::any_of(components_.begin(), components_.end(), [](const Expression& c) { return c.dependsOnTime(); });
}

void VectorExpression::readAt(const Location& where) {
  for (Expression& component : components_) component.readAt(where);
}

std::string VectorExpression::text() const {
  return fmt::format("[{},{},{}]", components_[0].text(), components_[1].text(), components_[2].text());
}

}  // namespace tushar::input
