// JSON that another process wrote, who may be of another version, damaged or a user's: whatever it holds, reading it
// never throws.   Threads: any.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace skein {

/// Keeps its keys in the order in which they were set.
using Json = nlohmann::ordered_json;

/// The value under `key` when it is there and of the same kind as `fallback`, else `fallback`. A null `fallback` takes
/// any kind. Never throws.
Json value_or(const Json& object, const char* key, Json fallback);

/// Of any JSON: 0, an empty text where there is nothing of the kind.
double number_in(const Json& object, const char* key);
std::optional<double> number_if_any(const Json& object, const char* key);
std::string text_in(const Json& object, const char* key);

/// Parses what a program wrote. @returns null when it is not JSON. What is nested deeper than anything of ours is left
/// out: copying it would take the stack.
Json parse_json(const std::string& text);

/// Parses a JSON file. @returns null when it is not there, not a plain file of a sensible size, or not JSON.
Json read_json(const std::filesystem::path& file);

}  // namespace skein
