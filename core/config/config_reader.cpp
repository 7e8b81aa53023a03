#include "core/config/config_reader.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "core/text/suggestion.hpp"
#include "core/text/text.hpp"

namespace skein {
namespace {

/// A plain scalar's text without a leading '+', which YAML allows and from_chars does not.
std::string_view number_candidate(const ConfigNode& node) {
  if (node.kind != ConfigNode::Kind::scalar || node.quoted) return {};
  std::string_view text = node.scalar;
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  return text;
}

template <class T>
bool parse(std::string_view text, T& value) {
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  return !text.empty() && result.ec == std::errc() && result.ptr == text.data() + text.size();
}

std::string wanted(const std::string& what, const Bounds& bounds) {
  const std::string range = bounds.text();
  return range.empty() ? what : what + " " + range;
}

/// The key of a map with which a path "a.b[2].c" begins: the longest that fits, because a user's key may have dots
/// itself.
std::optional<std::size_t> key_at_beginning(const ConfigNode& map, std::string_view path) {
  std::optional<std::size_t> longest;
  for (std::size_t i = 0; i < map.keys.size(); ++i) {
    const std::string& key = map.keys[i];
    const bool ends =
        path.size() == key.size() || (path.size() > key.size() && (path[key.size()] == '.' || path[key.size()] == '['));
    if (!path.starts_with(key) || !ends) continue;
    if (!longest || key.size() > map.keys[*longest].size()) longest = i;
  }
  return longest;
}

}  // namespace

std::string Bounds::text() const {
  if (lo_open && std::isfinite(hi)) return "above " + shortest(lo) + " and at most " + shortest(hi);
  if (std::isfinite(lo) && std::isfinite(hi)) return "within [" + shortest(lo) + ", " + shortest(hi) + "]";
  if (std::isfinite(lo)) return (lo_open ? "above " : "of at least ") + shortest(lo);
  if (std::isfinite(hi)) return "of at most " + shortest(hi);
  return "";
}

void ConfigErrors::add(int line, const std::string& message) { errors_.push_back({{line, 0}, message}); }

void ConfigErrors::check(bool ok, const std::string& key_path, const std::string& what) {
  if (!ok) add(find(key_path).first, key_path + ": " + what);
}

void ConfigErrors::add_at(const std::string& key_path, std::size_t at, const std::string& what) {
  const ConfigNode& node = *find(key_path).second;
  const bool has_place = node.kind == ConfigNode::Kind::scalar && node.line > 0;
  errors_.push_back({has_place ? place_in(document_, node, at) : ConfigPlace{node.line, 0}, key_path + ": " + what});
}

void ConfigErrors::throw_if_any() const {
  if (errors_.empty()) return;
  constexpr std::size_t kShown = 10;
  auto sorted = errors_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Error& a, const Error& b) {
    return std::pair(a.place.line, a.place.column) < std::pair(b.place.line, b.place.column);
  });
  std::string text;
  for (std::size_t i = 0; i < std::min(sorted.size(), kShown); ++i) {
    if (i > 0) text += '\n';
    text += document_.origin;
    const auto& [place, message] = sorted[i];
    for (const int number : {place.line, place.column}) {
      if (number > 0) text.append(":").append(std::to_string(number));
    }
    text.append(": ").append(message);
  }
  if (sorted.size() > kShown) text += "\nand " + std::to_string(sorted.size() - kShown) + " more";
  throw InputError(text);
}

/// Walks "a.b[2].c" as far as it goes.
std::pair<int, const ConfigNode*> ConfigErrors::find(const std::string& key_path) const {
  const ConfigNode* node = &document_.root;
  int line = node->line;
  std::size_t at = 0;
  while (at < key_path.size()) {
    if (key_path[at] == '.') ++at;
    if (key_path[at] == '[') {
      std::size_t index = 0;
      const auto end = std::min(key_path.find(']', at), key_path.size());
      if (!parse(std::string_view(key_path).substr(at + 1, end - at - 1), index)) break;
      if (node->kind != ConfigNode::Kind::list || index >= node->items.size()) break;
      node = &node->items[index];
      line = node->line;
      at = end + 1;
    } else {
      const auto i = key_at_beginning(*node, std::string_view(key_path).substr(at));
      if (!i) break;
      at += node->keys[*i].size();
      line = node->key_lines[*i];
      node = &node->items[*i];
    }
  }
  return {line, node};
}

ConfigReader::ConfigReader(const ConfigNode& map, std::string path, ConfigErrors& errors)
    : map_(map), path_(std::move(path)), errors_(errors), errors_before_(errors.count()) {}

void ConfigReader::check(bool ok, const std::string& key, const std::string& what) {
  if (errors_.count() == errors_before_) errors_.check(ok, path_of(key), what);
}

void ConfigReader::refuse_unknown_keys() {
  for (std::size_t i = 0; i < map_.keys.size(); ++i) {
    const std::string& key = map_.keys[i];
    if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
    errors_.add(map_.key_lines[i], "unknown key '" + path_of(key) + "'; " + suggestion(key, known_));
  }
}

namespace config_detail {

void Place::refuse(const std::string& what) const {
  errors.add(node.line, (path.empty() ? "the document" : path) + ": must be " + what + ", not " + node.what_it_is());
}

void read_bool(const Place& place, bool& value) {
  const ConfigNode& node = place.node;
  const bool is_bool =
      node.kind == ConfigNode::Kind::scalar && !node.quoted && (node.scalar == "true" || node.scalar == "false");
  if (!is_bool) return place.refuse("true or false");
  value = node.scalar == "true";
}

void read_double(const Place& place, double& value, const Bounds& bounds) {
  const std::optional<double> read = parse_number(number_candidate(place.node));
  if (!read || !bounds.contain(*read)) return place.refuse(wanted("a number", bounds));
  value = *read;
}

void read_integer(const Place& place, std::int64_t& value, const Bounds& bounds) {
  std::int64_t read = 0;
  const bool ok = parse(number_candidate(place.node), read) && bounds.contain(static_cast<double>(read));
  if (!ok) return place.refuse(wanted("a whole number", bounds));
  value = read;
}

void read_unsigned(const Place& place, std::uint64_t& value, const Bounds& bounds) {
  std::uint64_t read = 0;
  const bool ok = parse(number_candidate(place.node), read) && bounds.contain(static_cast<double>(read));
  Bounds shown = bounds;
  shown.lo = std::max(shown.lo, 0.0);
  if (!ok) return place.refuse(wanted("a whole number", shown));
  value = read;
}

void read_text(const Place& place, std::string& value) {
  if (place.node.kind != ConfigNode::Kind::scalar) return place.refuse("a text");
  value = place.node.scalar;
}

std::optional<std::size_t> read_name(const Place& place, const std::vector<std::string>& names) {
  if (place.node.kind == ConfigNode::Kind::scalar) {
    const auto it = std::find(names.begin(), names.end(), place.node.scalar);
    if (it != names.end()) return static_cast<std::size_t>(it - names.begin());
  }
  place.refuse("one of " + joined(names));
  return std::nullopt;
}

bool expect_list(const Place& place) {
  if (place.node.kind == ConfigNode::Kind::list) return true;
  place.refuse("a list");
  return false;
}

bool expect_numbers(const Place& place, std::size_t count) {
  if (place.node.kind == ConfigNode::Kind::list && place.node.items.size() == count) return true;
  const std::string what = "a list of " + std::to_string(count) + " numbers";
  if (place.node.kind != ConfigNode::Kind::list) {
    place.refuse(what);
  } else {
    place.errors.add(place.node.line,
                     place.path + ": must be " + what + ", not of " + std::to_string(place.node.items.size()));
  }
  return false;
}

bool expect_map(const Place& place) {
  // An empty file is read as a map without keys, so that the errors name the missing keys.
  const bool empty_document = place.path.empty() && place.node.kind == ConfigNode::Kind::null;
  if (place.node.kind == ConfigNode::Kind::map || empty_document) return true;
  place.refuse("a map of keys");
  return false;
}

}  // namespace config_detail
}  // namespace skein
