#include "core/config/config_node.hpp"

#include <yaml-cpp/emitter.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <cctype>
#include <sstream>
#include <unordered_map>

#include "core/files/file_bytes.hpp"
#include "core/text/text.hpp"
#include "core/text/utf8.hpp"
#include "core/types.hpp"

namespace skein {
namespace {

/// Far above the size of any file of Skein. The limit keeps a hostile file from exhausting the memory.
constexpr std::uintmax_t kMostBytes = 16u << 20;
constexpr std::size_t kDeepest = 32;
constexpr std::size_t kLongestKey = 200;

std::string place(const std::string& origin, int line) {
  return line > 0 ? origin + ":" + std::to_string(line) : origin;
}

/// Builds the tree from yaml-cpp's events: unlike its nodes, they show duplicate keys, quotes and anchors.
class TreeBuilder final : public YAML::EventHandler {
 public:
  explicit TreeBuilder(const std::string& origin) : origin_(origin) {}

  ConfigNode take() { return std::move(root_); }

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnAnchor(const YAML::Mark& mark, const std::string&) override { refuse_anchor(mark); }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override { refuse_anchor(mark); }

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    if (anchor != 0) refuse_anchor(mark);
    ConfigNode node;
    // yaml-cpp gives the mark of the next token, which may be many lines below. So an empty value takes its key's line.
    const bool has_key = !stack_.empty() && stack_.back().has_key;
    node.line = has_key ? stack_.back().node.key_lines.back() : mark.line + 1;
    accept(std::move(node));
  }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    if (anchor != 0) refuse_anchor(mark);
    if (tag != "?" && tag != "!" && !tag.empty()) refuse_tag(mark, tag);
    const bool quoted = tag == "!";
    ConfigNode node;
    node.line = mark.line + 1;
    if (quoted || (value != "~" && value != "null" && !value.empty())) {
      node = ConfigNode::make_scalar(value, quoted);
      node.line = mark.line + 1;
    }
    node.column = mark.column + 1;
    accept(std::move(node));
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(mark, tag, anchor, ConfigNode::make_list());
  }
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(mark, tag, anchor, ConfigNode::make_map());
  }
  void OnMapEnd() override { close(); }

 private:
  struct Open {
    ConfigNode node;
    bool has_key = false;
    std::unordered_map<std::string, int> lines{};  ///< of a map: the line of each key
  };

  [[noreturn]] void fail(int line, const std::string& message) const {
    throw InputError(place(origin_, line) + ": " + message);
  }
  [[noreturn]] void refuse_anchor(const YAML::Mark& mark) const {
    fail(mark.line + 1, "anchors and aliases (& and *) are not supported: write the value out");
  }
  [[noreturn]] void refuse_tag(const YAML::Mark& mark, const std::string& tag) const {
    fail(mark.line + 1, "the tag '" + tag + "' is not supported: leave it out");
  }

  void open(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor, ConfigNode node) {
    if (anchor != 0) refuse_anchor(mark);
    if (tag != "?" && tag != "!" && !tag.empty()) refuse_tag(mark, tag);
    if (stack_.size() >= kDeepest) fail(mark.line + 1, "nested too deeply");
    node.line = mark.line + 1;
    if (!stack_.empty() && stack_.back().node.kind == ConfigNode::Kind::map && !stack_.back().has_key) {
      fail(node.line, "a key must be a plain word, not " + node.what_it_is());
    }
    stack_.push_back({std::move(node)});
  }

  void close() {
    ConfigNode node = std::move(stack_.back().node);
    stack_.pop_back();
    accept(std::move(node));
  }

  void accept(ConfigNode node) {
    if (stack_.empty()) {
      root_ = std::move(node);
      return;
    }
    Open& parent = stack_.back();
    if (parent.node.kind == ConfigNode::Kind::list) {
      parent.node.items.push_back(std::move(node));
    } else if (!parent.has_key) {
      take_key(parent, node);
    } else {
      parent.node.items.push_back(std::move(node));
      parent.has_key = false;
    }
  }

  void take_key(Open& parent, const ConfigNode& node) {
    if (node.kind != ConfigNode::Kind::scalar) fail(node.line, "a key must be a plain word");
    if (node.scalar.size() > kLongestKey || node.scalar.find('\n') != std::string::npos) {
      fail(node.line, "this key is too long to be one; is there a quote or a colon too many above?");
    }
    const auto [first, is_new] = parent.lines.emplace(node.scalar, node.line);
    if (!is_new) {
      fail(node.line, "duplicate key '" + node.scalar + "': it stands in line " + std::to_string(first->second) +
                          " already; keep one");
    }
    parent.node.keys.push_back(node.scalar);
    parent.node.key_lines.push_back(node.line);
    parent.has_key = true;
  }

  const std::string& origin_;
  std::vector<Open> stack_;
  ConfigNode root_;
};

/// Refuses everything after the first document.
class NothingMore final : public YAML::EventHandler {
 public:
  explicit NothingMore(const std::string& origin) : origin_(origin) {}

  void OnDocumentStart(const YAML::Mark& mark) override {
    throw InputError(place(origin_, mark.line + 1) +
                     ": what follows from here is not part of the document above; "
                     "one file holds one document");
  }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
  void OnAlias(const YAML::Mark&, YAML::anchor_t) override {}
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t, const std::string&) override {}
  void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {}
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {}
  void OnMapEnd() override {}

 private:
  const std::string& origin_;
};

/// yaml-cpp would silently replace invalid bytes, so that a name would become a different name.
void refuse_other_encodings(const std::string& text, const std::string& origin) {
  if (is_utf8(text)) return;
  std::istringstream lines(text);
  int number = 1;
  for (std::string line; std::getline(lines, line) && is_utf8(line); ++number) {
  }
  throw InputError(place(origin, number) + ": not in UTF-8; convert the file, for example with iconv");
}

/// yaml-cpp would mistake some control characters for its own marks.
void refuse_binary(const std::string& text, const std::string& origin) {
  int line = 1;
  for (const char c : text) {
    if (c == '\n') ++line;
    const auto byte = static_cast<unsigned char>(c);
    if ((byte < 0x20 && c != '\n' && c != '\r' && c != '\t') || byte == 0x7f) {
      throw InputError(place(origin, line) + ": not a text file (control character)");
    }
  }
}

bool is_plain_word(const std::string& text) {
  const auto plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '/' || c == '.' || c == '-' || c == '+';
  };
  return text != "---" && text != "..." && std::all_of(text.begin(), text.end(), plain);
}

/// Quotes texts that are not plain words. Also quotes `quoted` texts, because a reader would take them for another kind
/// of value.
void emit_scalar(YAML::Emitter& out, const std::string& text, bool quoted) {
  if (quoted || !is_plain_word(text)) out << YAML::DoubleQuoted;
  out << text;
}

bool is_leaf(const ConfigNode& node) {
  return node.kind == ConfigNode::Kind::scalar || node.kind == ConfigNode::Kind::null;
}

/// Prints a list of leaves, and an empty list or map, on one line.
void emit(YAML::Emitter& out, const ConfigNode& node) {
  switch (node.kind) {
    case ConfigNode::Kind::null:
      out << YAML::Null;
      break;
    case ConfigNode::Kind::scalar:
      emit_scalar(out, node.scalar, node.quoted);
      break;
    case ConfigNode::Kind::list:
      if (std::all_of(node.items.begin(), node.items.end(), is_leaf)) out << YAML::Flow;
      out << YAML::BeginSeq;
      for (const ConfigNode& item : node.items) emit(out, item);
      out << YAML::EndSeq;
      break;
    case ConfigNode::Kind::map:
      if (node.items.empty()) out << YAML::Flow;
      out << YAML::BeginMap;
      for (std::size_t i = 0; i < node.items.size(); ++i) {
        out << YAML::Key;
        emit_scalar(out, node.keys[i], false);
        out << YAML::Value;
        emit(out, node.items[i]);
      }
      out << YAML::EndMap;
      break;
  }
}

}  // namespace

const ConfigNode* ConfigNode::find(std::string_view key) const {
  const auto it = std::find(keys.begin(), keys.end(), key);
  return it == keys.end() ? nullptr : &items[static_cast<std::size_t>(it - keys.begin())];
}

std::string ConfigNode::what_it_is() const {
  switch (kind) {
    case Kind::null:
      return "nothing";
    case Kind::list:
      return "a list";
    case Kind::map:
      return "a map of keys";
    case Kind::scalar:
      break;
  }
  constexpr std::size_t kShown = 40;
  return (quoted ? "the text '" : "'") + (scalar.size() > kShown ? scalar.substr(0, kShown) + "..." : scalar) + "'";
}

ConfigNode ConfigNode::make(Kind kind) {
  ConfigNode node;
  node.kind = kind;
  return node;
}

ConfigNode ConfigNode::make_scalar(std::string text, bool quoted) {
  ConfigNode node = make(Kind::scalar);
  node.scalar = std::move(text);
  node.quoted = quoted;
  return node;
}

void ConfigNode::add(std::string key, ConfigNode value) {
  keys.push_back(std::move(key));
  key_lines.push_back(value.line);
  items.push_back(std::move(value));
}

void ConfigNode::remove(std::string_view key) {
  const auto found = std::find(keys.begin(), keys.end(), key);
  if (found == keys.end()) return;
  const auto i = found - keys.begin();
  items.erase(items.begin() + i);
  key_lines.erase(key_lines.begin() + i);
  keys.erase(found);
}

// Apart from escapes, a scalar differs from the file's text only in its blanks. So the function counts the characters
// that are not blank: their number is the same in both.
ConfigPlace place_in(const ConfigDocument& document, const ConfigNode& scalar, std::size_t at) {
  const std::string& text = document.text;
  const auto is_blank = [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; };
  std::size_t begin = 0;
  for (int line = 1; line < scalar.line && begin < text.size(); ++begin) line += text[begin] == '\n';
  begin += static_cast<std::size_t>(std::max(0, scalar.column - 1));
  if (begin >= text.size()) return {scalar.line, scalar.column};
  if (scalar.quoted && (text[begin] == '|' || text[begin] == '>'))
    begin = std::min(text.find('\n', begin), text.size());
  if (scalar.quoted && begin < text.size() && (text[begin] == '"' || text[begin] == '\'')) ++begin;
  const bool at_end = at >= scalar.scalar.size();
  auto letters = std::count_if(scalar.scalar.begin(),
                               scalar.scalar.begin() + static_cast<std::ptrdiff_t>(std::min(at, scalar.scalar.size())),
                               [&](char c) { return !is_blank(c); });
  std::size_t place = begin;
  for (; place < text.size(); ++place) {
    if (letters == 0 && (at_end || !is_blank(text[place]))) break;
    if (!is_blank(text[place])) --letters;
  }
  const std::size_t line_begin = place == 0 ? 0 : text.rfind('\n', place - 1) + 1;
  const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(line_begin), '\n');
  return {static_cast<int>(line), static_cast<int>(place - line_begin) + 1};
}

ConfigDocument parse_config_document(const std::string& text, const std::string& origin) {
  refuse_binary(text, origin);
  refuse_other_encodings(text, origin);
  std::istringstream stream(text);
  try {
    YAML::Parser parser(stream);
    TreeBuilder builder(origin);
    parser.HandleNextDocument(builder);
    NothingMore nothing_more(origin);
    parser.HandleNextDocument(nothing_more);
    return {origin, builder.take(), text};
  } catch (const YAML::Exception& error) {
    throw InputError(place(origin, error.mark.line + 1) + ": not valid YAML: " + error.msg);
  }
}

ConfigDocument read_config_document(const std::filesystem::path& file) {
  return parse_config_document(read_file_bytes(file, kMostBytes), file.string());
}

ConfigDocument parse_assignments(const std::string& text, const std::string& origin) {
  ConfigDocument document{origin, ConfigNode::make_map()};
  if (text.empty()) return document;
  for (const std::string& part : split(text)) {
    const auto equals = part.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == part.size()) {
      throw InputError(origin + ": '" + part + "' is not of the form key=value");
    }
    const std::string key = part.substr(0, equals);
    if (document.root.find(key)) throw InputError(origin + ": '" + key + "' is given twice");
    document.root.add(key, ConfigNode::make_scalar(part.substr(equals + 1)));
  }
  return document;
}

std::string to_yaml(const ConfigNode& node) {
  YAML::Emitter out;
  emit(out, node);
  return out.c_str() + std::string("\n");
}

}  // namespace skein
