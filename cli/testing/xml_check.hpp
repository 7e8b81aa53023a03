// For tests: whether a text is well-formed XML of the kind that we write, and what is in it.
#pragma once

#include <cctype>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace skein::cli {

struct XmlElement {
  std::string name;
  std::map<std::string, std::string> attributes;
};

/// A strict reader of elements, attributes in double quotes, entities and one doctype; no comments or CDATA.
/// @returns all elements in document order. @throws std::runtime_error where the text is not well-formed.
class XmlCheck {
 public:
  static std::vector<XmlElement> elements(const std::string& text) { return XmlCheck(text).read(); }

 private:
  explicit XmlCheck(const std::string& text) : text_(text) {}

  std::vector<XmlElement> read() {
    if (text_.starts_with("<!DOCTYPE html>")) at_ = 15;
    while (at_ < text_.size()) {
      if (text_[at_] == '<') {
        read_tag();
      } else {
        read_character();
      }
    }
    if (!open_.empty()) fail("'" + open_.back() + "' is not closed");
    if (elements_.empty()) fail("there is no element");
    return elements_;
  }

  void read_tag() {
    ++at_;
    if (peek() == '/') {
      ++at_;
      const std::string name = read_name();
      if (open_.empty() || open_.back() != name) fail("closes '" + name + "', which is not open");
      open_.pop_back();
      return expect('>');
    }
    XmlElement element{read_name(), {}};
    if (open_.empty() && !elements_.empty()) fail("a second root");
    for (;;) {
      const bool space = std::isspace(static_cast<unsigned char>(peek())) != 0;
      while (std::isspace(static_cast<unsigned char>(peek())) != 0) ++at_;
      if (peek() == '>' || peek() == '/') break;
      if (!space) fail("no space before an attribute");
      const std::string name = read_name();
      expect('=');
      expect('"');
      const std::size_t begin = at_;
      while (peek() != '"') read_character();
      if (!element.attributes.emplace(name, text_.substr(begin, at_ - begin)).second) fail("'" + name + "' twice");
      ++at_;
    }
    const bool empty = peek() == '/';
    if (empty) ++at_;
    expect('>');
    if (!empty) open_.push_back(element.name);
    elements_.push_back(element);
  }

  void read_character() {
    const char c = peek();
    if (c == '<') fail("'<' in a text");
    if (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t') fail("a control character");
    if (c == '&') {
      const std::string entity = text_.substr(at_, text_.find(';', at_) - at_ + 1);
      static const std::vector<std::string> kKnown = {"&amp;", "&lt;", "&gt;", "&quot;", "&#39;"};
      bool known = false;
      for (const std::string& name : kKnown) known = known || name == entity;
      if (!known) fail("a bare '&'");
    }
    ++at_;
  }

  std::string read_name() {
    const std::size_t begin = at_;
    while (std::isalnum(static_cast<unsigned char>(peek())) != 0 || peek() == '-' || peek() == ':') ++at_;
    if (at_ == begin) fail("a name is missing");
    return text_.substr(begin, at_ - begin);
  }

  char peek() const {
    if (at_ >= text_.size()) fail("ends too early");
    return text_[at_];
  }

  void expect(char c) {
    if (peek() != c) fail(std::string("'") + c + "' is missing");
    ++at_;
  }

  [[noreturn]] void fail(const std::string& what) const {
    const std::size_t begin = at_ < 60 ? 0 : at_ - 60;
    throw std::runtime_error(what + " near: " + text_.substr(begin, 120));
  }

  const std::string& text_;
  std::size_t at_ = 0;
  std::vector<std::string> open_;
  std::vector<XmlElement> elements_;
};

}  // namespace skein::cli
