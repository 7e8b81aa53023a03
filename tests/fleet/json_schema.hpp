// Checks that JSON conforms to a JSON Schema and has no further keys.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace skein::test {

/// @param schema  Its objects count as closed: keys that it does not name are errors, unless it has
///   "additionalProperties". @returns one line for each error; empty when `value` conforms.
std::vector<std::string> schema_errors(const nlohmann::json& value, nlohmann::json schema);

}  // namespace skein::test
