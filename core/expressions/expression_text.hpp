// The letters of an expression, read from the beginning to the end: words, marks, numbers with units.  Pure.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

#include "core/expressions/unit.hpp"

namespace skein {

/// What is wrong in an expression, where, and what would be right.
struct ExpressionError : std::runtime_error {
  ExpressionError(std::size_t at_, const std::string& what) : std::runtime_error(what), at(at_) {}

  std::size_t at;  ///< counted from 0, in the text
};

class ExpressionText {
 public:
  /// @param text  must outlive this.
  explicit ExpressionText(std::string_view text) : text_(text) {}

  /// Where the next thing begins.
  std::size_t at();
  /// The word that comes next; empty: none.
  std::string_view peek_word();
  /// Whether a digit or a point comes next.
  bool at_number();
  /// Takes this word, or this mark, if it comes next.
  bool accept(std::string_view word);
  bool accept_mark(std::string_view mark);
  /// A word, which need not be any that is known. @param what  it must be, for messages
  std::string word(const std::string& what);
  /// A word with these marks in it.
  std::string word_with(std::string_view marks, const std::string& what);
  /// A number with its unit: "20 s".
  Quantity number();
  /// Takes this mark. @throws when something else comes next.
  void expect(char mark);
  void expect_end();
  /// What comes next, for messages.
  std::string next_text();
  [[noreturn]] static void fail(std::size_t at, const std::string& message) { throw ExpressionError(at, message); }

 private:
  bool next_is(std::string_view marks);

  std::string_view text_;
  std::size_t next_ = 0;
};

}  // namespace skein
