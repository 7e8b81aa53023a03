// Whether JSON is as a JSON Schema wants it, and has nothing besides.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace skein::test {

/// @param schema  Its objects are taken to be closed: a key that it does not name is refused, unless it says itself
///   what such keys may hold.
/// @returns one line for each thing that does not fit; empty when `value` is as `schema` wants it.
std::vector<std::string> schema_errors(const nlohmann::json& value, nlohmann::json schema);

}  // namespace skein::test
