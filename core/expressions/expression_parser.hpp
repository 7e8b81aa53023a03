// Reads expressions (expression.hpp). The grammar, from the loosest to the tightest:
//   condition or condition
//   condition and condition
//   not condition
//   number < number                also <=, >, >=, ==, !=
//   number + number                also -
//   number * number                also /
//   -number
//   20 m  80 %  0.5 m/s            a number, followed by its unit (core/expressions/unit.hpp)
//   separation  link(jurong, gcs)  a signal (core/expressions/signal_table.hpp)
//   min(a, b)  max(a, b)  abs(a)  gain(a)  rises(a)  falls(a)
//   (condition or number)
// Units must match: an expression may only compare or add numbers of the same dimension. The parser of a language
// that contains expressions (signals/properties/property_parser.hpp) also uses this class to read the words of that
// language.   Pure.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/expressions/expression.hpp"
#include "core/expressions/expression_text.hpp"
#include "core/expressions/signal_table.hpp"

namespace skein {

/// The names that an expression may use.
struct ExpressionScope {
  const SignalNames& names;
  bool live_only = false;  ///< allows only signals known during a run, and no operators on past values
  std::map<std::string, std::string> variables = {};  ///< name of the UAV that each variable stands for
  std::map<std::string, Quantity> parameters = {};
  const std::vector<SignalInfo>* signals = &signal_table();  ///< the parser looks names up here
  std::string_view signal_word = "signal";                   ///< the word for such a name in messages
};

/// Parses a text part by part. All member functions throw ExpressionError.
class ExpressionParser : public ExpressionText {
 public:
  /// @param scope, text  must outlive the parser.
  /// @param signals  receives each signal that an expression uses, once; the expression refers to it by its index.
  ///   Must outlive the parser.
  ExpressionParser(std::string_view text, const ExpressionScope& scope, std::vector<SignalUse>& signals)
      : ExpressionText(text), scope_(scope), signals_(signals) {}

  /// Parses one condition and stops after it; more text may follow.
  Expression condition();
  /// Reads a constant with this unit: "20 s". @param what  names the constant's purpose in error messages
  double constant(const Unit& unit, const std::string& what);

 private:
  Expression disjunction();
  Expression conjunction();
  Expression negation();
  Expression comparison();
  Expression sum();
  Expression product();
  Expression signed_number();
  Expression primary();
  Expression nested(Expression (ExpressionParser::*part)());
  Expression function(Expression::Op op, std::size_t at, const std::string& name);
  Expression signal(std::size_t at, const std::string& name);
  const SignalInfo& signal_named(std::size_t at, const std::string& name) const;
  std::string argument(SignalArgument kind);
  /// Returns a name, or the UAV for which a variable of this name stands. Throws if there is neither.
  std::string known(const std::string& name, std::size_t at, const std::vector<std::string>& names,
                    const std::string& what) const;
  /// Throws if the next argument, number `place`, equals the previous one (`before`) and is of the same kind, as in
  /// link(a, a).
  void refuse_same(const SignalInfo& info, std::size_t place, std::string_view before);
  std::size_t slot_of(SignalUse use);

  const ExpressionScope& scope_;
  std::vector<SignalUse>& signals_;
  int depth_ = 0;
};

/// Reads the whole text as one condition. @throws ExpressionError, also if other text follows the condition.
Expression parse_condition(std::string_view text, const ExpressionScope& scope, std::vector<SignalUse>& signals);

}  // namespace skein
