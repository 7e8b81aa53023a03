#include "core/expressions/expression_parser.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "core/text/suggestion.hpp"
#include "core/topics.hpp"

namespace skein {
namespace {

using Op = Expression::Op;

constexpr int kDeepestPart = 64;

std::string of_unit(const Unit& unit) {
  return unit == kPlainNumber ? std::string("a plain number") : "in " + unit_text(unit);
}

void expect_number(const Expression& part, const std::string& where) {
  if (part.is_condition) ExpressionParser::fail(part.at, where + " must be a number, and this is a condition");
}

void expect_condition(const Expression& part, const std::string& where) {
  if (part.is_condition) return;
  ExpressionParser::fail(part.at, where + " must be a condition, and this is a number; compare it: '... > 0'");
}

/// "m, cm or km"; empty: numbers of this unit cannot be written.
std::string names_of(const Unit& unit) {
  std::vector<std::string> names;
  for (const UnitName& name : kUnitNames) {
    if (name.unit == unit) names.emplace_back(name.name);
  }
  if (names.empty()) return "";
  const std::string last = names.back();
  names.pop_back();
  return names.empty() ? last : joined(names) + " or " + last;
}

/// The message has a hint for the most common mistake, a number without its unit.
void expect_same_unit(const Expression& a, const Expression& b) {
  if (a.unit == b.unit) return;
  std::string message = "units do not fit: the left side is " + of_unit(a.unit) + ", the right side " + of_unit(b.unit);
  const std::string names = names_of(a.unit);
  if (b.op == Op::number && b.unit == kPlainNumber && !names.empty()) {
    message += "; write a unit behind the number: " + names;
  }
  ExpressionParser::fail(b.at, message);
}

Expression combined(Op op, Expression a, Expression b) {
  Expression result{.op = op, .unit = a.unit, .at = a.at};
  result.parts.push_back(std::move(a));
  result.parts.push_back(std::move(b));
  return result;
}

Expression joined_conditions(Op op, const char* word, Expression a, Expression b) {
  const std::string where = "each side of '" + std::string(word) + "'";
  expect_condition(a, where);
  expect_condition(b, where);
  const bool certain = a.is_certain && b.is_certain;
  const Unit unit = a.is_certain ? b.unit : b.is_certain || a.unit == b.unit ? a.unit : kPlainNumber;
  Expression result = combined(op, std::move(a), std::move(b));
  result.is_condition = true;
  result.is_certain = certain;
  result.unit = unit;
  return result;
}

struct Comparison {
  std::string_view mark;
  Op op;
};
/// Longer marks come first, because a search for "<" would also match "<=".
constexpr std::array kComparisons = {Comparison{"<=", Op::at_most}, Comparison{">=", Op::at_least},
                                     Comparison{"==", Op::equal},   Comparison{"!=", Op::unequal},
                                     Comparison{"<", Op::less},     Comparison{">", Op::more}};

struct Function {
  std::string_view name;
  Op op;
  std::size_t arguments;
};
constexpr std::array kFunctions = {Function{"min", Op::least, 2},    Function{"max", Op::greatest, 2},
                                   Function{"abs", Op::absolute, 1}, Function{"gain", Op::gain, 1},
                                   Function{"rises", Op::rises, 1},  Function{"falls", Op::falls, 1}};

bool looks_back(Op op) { return op == Op::gain || op == Op::rises || op == Op::falls; }

}  // namespace

// ---- operators, from the loosest to the tightest ----------------------------------------------------------------

Expression ExpressionParser::condition() {
  const std::size_t begin = at();
  Expression result = disjunction();
  if (!result.is_condition) {
    fail(at(), "the number that begins at letter " + std::to_string(begin + 1) +
                   " must be compared here: with <, <=, >, >=, == or !=, not " + next_text());
  }
  return result;
}

Expression ExpressionParser::disjunction() {
  Expression left = conjunction();
  while (accept("or")) left = joined_conditions(Op::disjunction, "or", std::move(left), conjunction());
  return left;
}

/// Limits the depth, because the parser is recursive and a hostile file could overflow its stack.
Expression ExpressionParser::nested(Expression (ExpressionParser::*part)()) {
  if (++depth_ > kDeepestPart) fail(at(), "nested too deeply");
  Expression inside = (this->*part)();
  --depth_;
  return inside;
}

Expression ExpressionParser::conjunction() {
  Expression left = negation();
  while (accept("and")) left = joined_conditions(Op::conjunction, "and", std::move(left), negation());
  return left;
}

Expression ExpressionParser::negation() {
  const std::size_t begin = at();
  if (!accept("not")) return comparison();
  Expression part = nested(&ExpressionParser::negation);
  expect_condition(part, "what follows 'not'");
  Expression result{
      .op = Op::negation, .unit = part.unit, .is_condition = true, .is_certain = part.is_certain, .at = begin};
  result.parts.push_back(std::move(part));
  return result;
}

Expression ExpressionParser::comparison() {
  Expression left = sum();
  for (const auto& [mark, op] : kComparisons) {
    if (!accept_mark(mark)) continue;
    expect_number(left, "the left side of '" + std::string(mark) + "'");
    Expression right = sum();
    expect_number(right, "the right side of '" + std::string(mark) + "'");
    expect_same_unit(left, right);
    Expression result = combined(op, std::move(left), std::move(right));
    result.is_condition = true;
    const std::size_t next = at();
    if (accept_mark("<") || accept_mark(">") || accept_mark("=")) {
      fail(next, "one comparison at a time: write 'a < b and b < c'");
    }
    return result;
  }
  const std::size_t next = at();
  if (accept_mark("=")) fail(next, "one '=' compares nothing; write '=='");
  return left;
}

Expression ExpressionParser::sum() {
  Expression left = product();
  for (;;) {
    const bool plus = accept_mark("+");
    if (!plus && !accept_mark("-")) return left;
    expect_number(left, "each term of a sum");
    Expression right = product();
    expect_number(right, "each term of a sum");
    expect_same_unit(left, right);
    left = combined(plus ? Op::add : Op::subtract, std::move(left), std::move(right));
  }
}

Expression ExpressionParser::product() {
  Expression left = signed_number();
  for (;;) {
    const bool times = accept_mark("*");
    if (!times && !accept_mark("/")) return left;
    expect_number(left, "each factor of a product");
    Expression right = signed_number();
    expect_number(right, "each factor of a product");
    if (!times && is_constant(right) && number_at(right, {}) == 0.0) fail(right.at, "nothing can be divided by 0");
    const Unit unit = times ? left.unit * right.unit : left.unit / right.unit;
    left = combined(times ? Op::multiply : Op::divide, std::move(left), std::move(right));
    left.unit = unit;
  }
}

Expression ExpressionParser::signed_number() {
  const std::size_t begin = at();
  if (!accept_mark("-")) return primary();
  Expression part = nested(&ExpressionParser::signed_number);
  expect_number(part, "what follows '-'");
  Expression result{.op = Op::negate, .unit = part.unit, .at = begin};
  result.parts.push_back(std::move(part));
  return result;
}

Expression ExpressionParser::primary() {
  const std::size_t begin = at();
  if (accept_mark("(")) {
    Expression inside = nested(&ExpressionParser::disjunction);
    expect(')');
    return inside;
  }
  if (at_number()) {
    const Quantity given = number();
    return {.op = Op::number, .number = given.value, .unit = given.unit, .at = begin};
  }
  const std::string name = word("a " + std::string(scope_.signal_word) + ", a number or '('");
  for (const Function& known : kFunctions) {
    if (name == known.name) return function(known.op, begin, name);
  }
  if (const auto parameter = scope_.parameters.find(name); parameter != scope_.parameters.end()) {
    return {.op = Op::number, .number = parameter->second.value, .unit = parameter->second.unit, .at = begin};
  }
  return signal(begin, name);
}

Expression ExpressionParser::function(Op op, std::size_t at, const std::string& name) {
  if (scope_.live_only && looks_back(op)) {
    fail(at, "'" + name + "' looks back, which only properties can");
  }
  Expression result{.op = op, .at = at};
  expect('(');
  result.parts.push_back(nested(&ExpressionParser::disjunction));
  const bool two = op == Op::least || op == Op::greatest;
  if (two) {
    expect(',');
    result.parts.push_back(nested(&ExpressionParser::disjunction));
  }
  expect(')');
  result.is_condition = result.is_certain = op == Op::rises || op == Op::falls;
  if (result.is_condition) return result;
  for (const Expression& part : result.parts) expect_number(part, "each argument of '" + name + "'");
  if (two) expect_same_unit(result.parts[0], result.parts[1]);
  result.unit = result.parts[0].unit;
  return result;
}

// ---- signals ----------------------------------------------------------------------------------------------------

const SignalInfo& ExpressionParser::signal_named(std::size_t at, const std::string& name) const {
  std::vector<std::string> known;
  for (const SignalInfo& info : *scope_.signals) {
    if (info.name == name && scope_.live_only && !info.is_live) {
      fail(at, "'" + name + "' is known only after the run, so that nothing can wait for it");
    }
    if (info.name == name) return info;
    if (info.is_live || !scope_.live_only) known.emplace_back(info.name);
  }
  for (const auto& [parameter, value] : scope_.parameters) known.push_back(parameter);
  fail(at, "there is no " + std::string(scope_.signal_word) + " '" + name + "'; " + suggestion(name, known));
}

Expression ExpressionParser::signal(std::size_t at, const std::string& name) {
  const SignalInfo& info = signal_named(at, name);
  SignalUse use{&info, {}};
  if (accept_mark("(")) {
    std::string_view before;  // as written, because a variable may happen to stand for the UAV of the other argument
    do {
      if (use.arguments.size() == info.arguments.size()) {
        fail(this->at(), "too many names: the signal is " + info.text());
      }
      refuse_same(info, use.arguments.size(), before);
      before = peek_word();
      const bool may_be_all = use.arguments.size() >= info.required;
      use.arguments.push_back(may_be_all && accept("all") ? "" : argument(info.arguments[use.arguments.size()]));
    } while (accept_mark(","));
    expect(')');
  }
  if (use.arguments.size() < info.required) fail(at, "names are missing: the signal is " + info.text());
  Expression result{
      .op = Op::signal, .unit = info.unit, .is_condition = info.is_boolean, .is_certain = info.is_boolean, .at = at};
  if (use.is("result")) result.unit = unit_of_result(use.arguments[0]).unit;
  result.signal = slot_of(std::move(use));
  return result;
}

/// No node has a link to itself, and no UAV a distance from itself.
void ExpressionParser::refuse_same(const SignalInfo& info, std::size_t place, std::string_view before) {
  const std::string_view next = peek_word();
  const bool of_one_kind = place > 0 && info.arguments[place] == info.arguments[place - 1];
  if (!of_one_kind || next != before || next.empty() || next == "all") return;
  fail(at(), "'" + std::string(next) + "' is named twice: " + info.text() + " is about two different ones");
}

std::size_t ExpressionParser::slot_of(SignalUse use) {
  const auto found = std::find(signals_.begin(), signals_.end(), use);
  if (found != signals_.end()) return static_cast<std::size_t>(found - signals_.begin());
  signals_.push_back(std::move(use));
  return signals_.size() - 1;
}

std::string ExpressionParser::argument(SignalArgument kind) {
  const std::size_t begin = at();
  switch (kind) {
    case SignalArgument::uav:
      return known(word("the name of a UAV"), begin, scope_.names.uavs, "UAV");
    case SignalArgument::node:
      return known(word("the name of a UAV, or gcs"), begin, scope_.names.nodes, "node");
    case SignalArgument::program:
      return known(word("the name of a program"), begin, scope_.names.programs, "program");
    case SignalArgument::topic:
      if (const std::string topic = word_with("/", "a topic like '/plan'"); is_topic_name(topic)) return topic;
      fail(begin, "here must be a topic like '/plan'");
    case SignalArgument::path:
      return word_with(".", "a key of result.json like 'radio.sent'");
    case SignalArgument::word:
      return word("a name");
  }
  return {};
}

std::string ExpressionParser::known(const std::string& name, std::size_t at, const std::vector<std::string>& names,
                                    const std::string& what) const {
  if (const auto variable = scope_.variables.find(name); variable != scope_.variables.end()) return variable->second;
  if (std::find(names.begin(), names.end(), name) != names.end()) return name;
  std::vector<std::string> all = names;
  for (const auto& [variable, value] : scope_.variables) all.push_back(variable);
  fail(at, "there is no " + what + " '" + name + "'; " + suggestion(name, all));
}

// ---- whole texts ------------------------------------------------------------------------------------------------

double ExpressionParser::constant(const Unit& unit, const std::string& what) {
  const std::size_t begin = at();
  const Expression expression = sum();
  expect_number(expression, what);
  if (!is_constant(expression)) fail(begin, what + " must be a number, not a signal");
  if (expression.unit != unit) {
    fail(begin, what + " must be " + of_unit(unit) + ", and this is " + of_unit(expression.unit));
  }
  return number_at(expression, {});
}

Expression parse_condition(std::string_view text, const ExpressionScope& scope, std::vector<SignalUse>& signals) {
  ExpressionParser parser(text, scope, signals);
  Expression result = parser.condition();
  parser.expect_end();
  return result;
}

}  // namespace skein
