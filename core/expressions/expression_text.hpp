// Tokenizer for expressions: reads words, marks (operators, parentheses) and numbers with units in order.  Pure.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

#include "core/expressions/unit.hpp"

namespace skein {

/// An error in an expression: the message says what is wrong and what would be right.
struct ExpressionError : std::runtime_error {
  ExpressionError(std::size_t at_, const std::string& what) : std::runtime_error(what), at(at_) {}

  std::size_t at;  ///< index in the text, from 0
};

class ExpressionText {
 public:
  /// @param text  must outlive this. @throws ExpressionError if it is longer than any sensible expression.
  explicit ExpressionText(std::string_view text);

  /// Index in the text at which the next token begins.
  std::size_t at();
  /// The next token if it is a word, otherwise empty. Does not consume it.
  std::string_view peek_word();
  /// Whether the next character is a digit or a decimal point.
  bool at_number();
  /// Consumes this word, or this mark, if it comes next. @returns whether it did.
  bool accept(std::string_view word);
  bool accept_mark(std::string_view mark);
  /// Consumes any word. @param what  what the word must be, for messages. @throws ExpressionError if there is none.
  std::string word(const std::string& what);
  /// Consumes a word that may also contain these characters.
  std::string word_with(std::string_view marks, const std::string& what);
  /// Consumes a number with its unit: "20 s".
  Quantity number();
  /// Consumes this mark. @throws ExpressionError if another token comes next.
  void expect(char mark);
  void expect_end();
  /// The next token, for messages.
  std::string next_text();
  [[noreturn]] static void fail(std::size_t at, const std::string& message) { throw ExpressionError(at, message); }

 private:
  std::string_view text_;
  std::size_t next_ = 0;
};

}  // namespace skein
