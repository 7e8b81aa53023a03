#include "process/json_text.hpp"

#include <cstdint>

#include "core/files/file_bytes.hpp"
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

Json parse_json(const std::string& text) {
  constexpr int kDeepest = 32;
  const auto shallow = [](int depth, Json::parse_event_t, const Json&) { return depth <= kDeepest; };
  Json json = Json::parse(text, shallow, false);
  return json.is_discarded() ? Json() : json;
}

std::string json_text(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
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
