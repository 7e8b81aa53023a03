// A configuration document as a tree whose nodes know their lines in the file. Only this module parses YAML; the rest
// of Skein uses neither yaml-cpp nor the text. Strict: one document, no duplicate keys, no anchors.
// Pure; safe from any thread.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace skein {

/// One value, with its position in the file.
struct ConfigNode {
  enum class Kind { null, scalar, list, map };

  Kind kind = Kind::null;
  int line = 0;                   ///< counted from 1; 0: not from a file
  int column = 0;                 ///< counted from 1; 0: not from a file
  bool quoted = false;            ///< a scalar in quotes: text, never a number
  std::string scalar;             ///< a scalar's text
  std::vector<ConfigNode> items;  ///< a list's items, or a map's values in the file's order
  std::vector<std::string> keys;  ///< a map's keys, in the file's order
  std::vector<int> key_lines;     ///< lines of a map's keys

  /// The value under `key`, or nullptr.
  const ConfigNode* find(std::string_view key) const;
  /// What the node is, for a message: "a list", "the text 'abc'".
  std::string what_it_is() const;

  static ConfigNode make_scalar(std::string text, bool quoted = false);
  static ConfigNode make_map() { return make(Kind::map); }
  static ConfigNode make_list() { return make(Kind::list); }
  /// Appends a key with its value to a map.
  void add(std::string key, ConfigNode value);
  /// Removes a key and its value from a map, if the map has it.
  void remove(std::string_view key);

 private:
  static ConfigNode make(Kind kind);
};

/// A tree, with its origin for error messages (a file's path, "--planner kios").
struct ConfigDocument {
  std::string origin;
  ConfigNode root;
  std::string text = {};  ///< the text from which the tree was read
};

/// A position in a document's text; line and column are counted from 1.
struct ConfigPlace {
  int line = 0, column = 0;
};
/// Position of a character of a scalar in the document's text, also if YAML joined several lines to this scalar.
/// @param at  index of the character in the scalar, from 0; the scalar's length: the position after its end
ConfigPlace place_in(const ConfigDocument& document, const ConfigNode& scalar, std::size_t at);

/// @throws InputError when the file cannot be read or is not YAML; the message names file and line.
ConfigDocument read_config_document(const std::filesystem::path& file);

/// @param origin names the text in messages.  @throws InputError as above.
ConfigDocument parse_config_document(const std::string& text, const std::string& origin);

/// Parses "key=value,key=value" from a command line; an empty text gives an empty map. Values are plain scalars.
/// @throws InputError if a part is empty or has no '=', or a key occurs twice.
ConfigDocument parse_assignments(const std::string& text, const std::string& origin);

/// The tree as YAML text that parse_config_document() reads back to an equal tree.
std::string to_yaml(const ConfigNode& node);

}  // namespace skein
