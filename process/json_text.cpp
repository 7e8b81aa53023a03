#include "process/json_text.hpp"

#include <algorithm>
#include <cstdint>

#include "core/files/file_bytes.hpp"
#include "core/text/sha256.hpp"
#include "core/types.hpp"

namespace skein {

Json value_or(const Json& object, const char* key, Json fallback) {
  if (!object.is_object()) return fallback;
  const auto found = object.find(key);
  if (found == object.end()) return fallback;
  const bool same_type = found->is_number() ? fallback.is_number() : found->type() == fallback.type();
  return same_type || fallback.is_null() ? *found : fallback;
}

std::optional<double> number_if_any(const Json& object, const char* key) {
  if (!object.is_object()) return std::nullopt;
  const auto found = object.find(key);
  return found != object.end() && found->is_number() ? std::optional(found->get<double>()) : std::nullopt;
}

double number_in(const Json& object, const char* key) { return number_if_any(object, key).value_or(0.0); }

std::string text_in(const Json& object, const char* key) {
  if (!object.is_object()) return "";
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

namespace {

constexpr int kDeepest = 32;

/// The greatest number of arrays and objects around a value; for text that is no JSON, any number.
int depth_of(const std::string& text) {
  int depth = 0, deepest = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted) {
      if (c == '\\') ++i;
      quoted = c != '"';
    } else if (c == '"') {
      quoted = true;
    } else if (c == '{' || c == '[') {
      deepest = std::max(deepest, ++depth);
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
  return deepest;
}

}  // namespace

std::vector<std::string> texts_in(const Json& object, const char* key) {
  std::vector<std::string> texts;
  for (const Json& text : value_or(object, key, Json::array())) {
    if (text.is_string()) texts.push_back(text.get<std::string>());
  }
  return texts;
}

Json parse_json(const std::string& text) {
  // With a callback, nlohmann's parser takes a time that grows with the square of an array's length.
  const auto shallow = [](int depth, Json::parse_event_t, const Json&) { return depth <= kDeepest; };
  const bool deep = depth_of(text) > kDeepest;
  Json json = deep ? Json::parse(text, shallow, false) : Json::parse(text, nullptr, false);
  return json.is_discarded() ? Json() : json;
}

std::string json_text(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

Json with_checksum(Json object) {
  object.erase(kChecksum);
  // The checksum must cover the values that a reader gets: invalid UTF-8 is replaced, numbers like NaN become null.
  object = parse_json(json_text(object));
  object[kChecksum] = Sha256().add(json_text(object)).hex();
  return object;
}

bool has_sound_checksum(const Json& object) {
  const Json told = value_or(object, kChecksum, nullptr);
  return told.is_null() || told == with_checksum(object)[kChecksum];
}

Json read_json(const std::filesystem::path& file) {
  constexpr std::uintmax_t kMostBytes = 256 << 20;
  try {
    return parse_json(read_file_bytes(file, kMostBytes));
  } catch (const InputError&) {
    return nullptr;
  }
}

}  // namespace skein
