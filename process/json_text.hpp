// Reads JSON that another process wrote. It may be damaged, or come from another version of Skein or from a user's
// program: reading never throws, whatever the JSON contains. Writes JSON.   Threads: any.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace skein {

/// JSON whose objects keep their keys in the order in which they were set.
using Json = nlohmann::ordered_json;

/// The value under `key` if it exists and has the same kind as `fallback`, else `fallback`. If `fallback` is null, a
/// value of any kind is returned. Never throws.
Json value_or(const Json& object, const char* key, Json fallback);

/// The number or text under `key` of any JSON. If there is none: 0, nullopt, or an empty text.
double number_in(const Json& object, const char* key);
std::optional<double> number_if_any(const Json& object, const char* key);
std::string text_in(const Json& object, const char* key);
/// The texts of a list under `key`; leaves out its elements of other kinds. Empty if there is no list.
std::vector<std::string> texts_in(const Json& object, const char* key);

/// Parses JSON. @returns null if the text is not JSON. Leaves out values that are nested deeper than any that Skein
/// writes: copying them could overflow the stack.
Json parse_json(const std::string& text);

/// The text of JSON on one line or, with `indent` >= 0, on several. Replaces bytes that are not UTF-8, which a text may
/// have if it comes from a user's program: they must not end a run or a study.
std::string json_text(const Json& json, int indent = -1);

/// Key of the checksum of an object in a file: a SHA-256 over all other keys and values, in their order, regardless of
/// white space.
inline constexpr const char* kChecksum = "checksum";
/// The object as a reader of its text gets it, with the right checksum.
Json with_checksum(Json object);
/// Whether an object has the right checksum, or none, as from an earlier version or another program.
bool has_sound_checksum(const Json& object);

/// Parses a JSON file. @returns null if the file does not exist, is not a regular file, is too large, or is not JSON.
Json read_json(const std::filesystem::path& file);

}  // namespace skein
