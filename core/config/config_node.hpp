// A configuration document as a tree that remembers its lines. YAML comes in through here and nowhere else; the
// rest of Skein sees neither yaml-cpp nor text. Strict: one document, no duplicate keys, no anchors.
// Pure; safe from any thread.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace skein {

/// One value with the place where it stands.
struct ConfigNode {
  enum class Kind { null, scalar, list, map };

  Kind kind = Kind::null;
  int line = 0;                   ///< counted from 1; 0 means no place in a file
  int column = 0;                 ///< the same within the line
  bool quoted = false;            ///< a scalar in quotes: text, never a number
  std::string scalar;             ///< of a scalar
  std::vector<ConfigNode> items;  ///< of a list; of a map, the values in the file's order
  std::vector<std::string> keys;  ///< of a map, in the file's order
  std::vector<int> key_lines;     ///< of a map

  /// The value under `key`, or nullptr.
  const ConfigNode* find(std::string_view key) const;
  /// What the node is, for a message: "a list", "the text 'abc'".
  std::string what_it_is() const;

  static ConfigNode make_scalar(std::string text, bool quoted = false);
  static ConfigNode make_map() { return make(Kind::map); }
  static ConfigNode make_list() { return make(Kind::list); }
  /// Appends to a map.
  void add(std::string key, ConfigNode value);
  /// Forgets a key of a map, if it is there.
  void remove(std::string_view key);

 private:
  static ConfigNode make(Kind kind);
};

/// A tree and the name by which messages call it (a file's path, "--planner kios").
struct ConfigDocument {
  std::string origin;
  ConfigNode root;
  std::string text = {};  ///< that it was read from
};

/// Where something stands in a document's text, both counted from 1.
struct ConfigPlace {
  int line = 0, column = 0;
};
/// Where a letter of a scalar stands: in lines that YAML has joined, too.
/// @param at  counted from 0; the scalar's length: behind it
ConfigPlace place_in(const ConfigDocument& document, const ConfigNode& scalar, std::size_t at);

/// @throws InputError when the file cannot be read or is not YAML; the message names file and line.
ConfigDocument read_config_document(const std::filesystem::path& file);

/// @param origin names the text in messages.  @throws InputError as above.
ConfigDocument parse_config_document(const std::string& text, const std::string& origin);

/// A document from "key=value,key=value", as command lines have it; an empty text is an empty map. Values are plain
/// scalars.  @throws InputError when a part has no '=' or a key occurs twice.
ConfigDocument parse_assignments(const std::string& text, const std::string& origin);

/// The tree as YAML text that parse_config_document() reads back to an equal tree.
std::string to_yaml(const ConfigNode& node);

}  // namespace skein
