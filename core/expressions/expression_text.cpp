#include "core/expressions/expression_text.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <vector>

#include "core/text/suggestion.hpp"
#include "core/text/utf8.hpp"

namespace skein {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool begins_word(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool in_word(char c) { return begins_word(c) || is_digit(c); }

/// Number of bytes of the first letter of a text in UTF-8. A text that is not in UTF-8 has letters of one byte or more.
std::size_t letter_bytes(std::string_view text) {
  std::size_t bytes = 1;
  while (bytes < text.size() && bytes < 4 && continues_character(text[bytes])) ++bytes;
  return bytes;
}

/// Greatest length of an expression [bytes]. A chain of operators ("a or b or c ...") becomes a tree that is as deep as
/// the chain is long, and the functions that evaluate and destroy the tree are recursive.
constexpr std::size_t kLongestExpression = 4000;

}  // namespace

ExpressionText::ExpressionText(std::string_view text) : text_(text) {
  if (text.size() <= kLongestExpression) return;
  fail(kLongestExpression, "the expression is too long: it has " + std::to_string(text.size()) +
                               " letters, and may have " + std::to_string(kLongestExpression));
}

std::size_t ExpressionText::at() {
  while (next_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[next_])) != 0) ++next_;
  return next_;
}

std::string_view ExpressionText::peek_word() {
  const std::size_t begin = at();
  if (begin == text_.size() || !begins_word(text_[begin])) return {};
  const auto end = std::find_if_not(text_.begin() + static_cast<std::ptrdiff_t>(begin), text_.end(), in_word);
  return text_.substr(begin, static_cast<std::size_t>(end - text_.begin()) - begin);
}

bool ExpressionText::at_number() { return at() < text_.size() && (is_digit(text_[next_]) || text_[next_] == '.'); }

std::string ExpressionText::next_text() {
  if (at() == text_.size()) return "the end";
  const std::string_view word = peek_word();
  return "'" + std::string(word.empty() ? text_.substr(next_, letter_bytes(text_.substr(next_))) : word) + "'";
}

bool ExpressionText::accept_mark(std::string_view mark) {
  if (!text_.substr(at()).starts_with(mark)) return false;
  next_ += mark.size();
  return true;
}

bool ExpressionText::accept(std::string_view word) {
  if (peek_word() != word) return false;
  next_ += word.size();
  return true;
}

std::string ExpressionText::word(const std::string& what) {
  const std::string_view found = peek_word();
  if (found.empty()) fail(next_, "here must be " + what + ", not " + next_text());
  next_ += found.size();
  return std::string(found);
}

std::string ExpressionText::word_with(std::string_view marks, const std::string& what) {
  const std::size_t begin = at();
  const auto is_part = [&](char c) { return in_word(c) || marks.find(c) != marks.npos; };
  while (next_ < text_.size() && is_part(text_[next_])) ++next_;
  if (next_ == begin) fail(begin, "here must be " + what + ", not " + next_text());
  return std::string(text_.substr(begin, next_ - begin));
}

Quantity ExpressionText::number() {
  const std::size_t begin = at();
  Quantity number;
  const auto [end, error] = std::from_chars(text_.data() + begin, text_.data() + text_.size(), number.value);
  if (error != std::errc() || !std::isfinite(number.value)) fail(begin, "this is not a number");
  const auto digits_end = static_cast<std::size_t>(end - text_.data());
  next_ = digits_end;
  const std::string_view rest = text_.substr(at());
  for (const UnitName& unit : kUnitNames) {
    const bool ends = rest.size() <= unit.name.size() || !in_word(rest[unit.name.size()]);
    if (!rest.starts_with(unit.name) || !ends) continue;
    next_ += unit.name.size();
    return {number.value * unit.factor, unit.unit};
  }
  if (next_ == digits_end && !peek_word().empty()) {  // as in "20x"; in "20 x", x is the next word, not a unit
    std::vector<std::string> names;
    for (const UnitName& unit : kUnitNames) names.emplace_back(unit.name);
    fail(next_, "there is no unit " + next_text() + "; known are: " + joined(names));
  }
  return number;
}

void ExpressionText::expect(char mark) {
  if (accept_mark(std::string_view(&mark, 1))) return;
  fail(next_, "here must be '" + std::string(1, mark) + "', not " + next_text());
}

void ExpressionText::expect_end() {
  if (at() != text_.size()) fail(next_, "here must be the end, or 'and' or 'or', not " + next_text());
}

}  // namespace skein
