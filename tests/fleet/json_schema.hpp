// The part of JSON Schema that docs/result.schema.json uses.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace skein::test {

/// @returns one line for each thing that does not fit; empty when `value` is as `schema` wants it.
std::vector<std::string> schema_errors(const nlohmann::json& value, const nlohmann::json& schema,
                                       const std::string& path = "result");

}  // namespace skein::test
