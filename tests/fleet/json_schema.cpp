#include "json_schema.hpp"

#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

namespace skein::test {
namespace {

using Json = nlohmann::json;

/// Forbids unknown keys. Readers of a published schema must tolerate keys of later versions; its own tests need not.
void close(Json& schema) {
  if (schema.contains("properties") && !schema.contains("additionalProperties")) schema["additionalProperties"] = false;
  for (Json& part : schema) {
    if (part.is_structured()) close(part);
  }
}

}  // namespace

std::vector<std::string> schema_errors(const Json& value, Json schema) {
  close(schema);
  valijson::Schema rules;
  valijson::SchemaParser().populateSchema(valijson::adapters::NlohmannJsonAdapter(schema), rules);
  // Strong types: a string that reads like an integer is not an integer.
  valijson::Validator validator(valijson::Validator::kStrongTypes);
  valijson::ValidationResults results;
  validator.validate(rules, valijson::adapters::NlohmannJsonAdapter(value), &results);
  std::vector<std::string> errors;
  for (const auto& error : results) {
    std::string place;
    for (const std::string& part : error.context) place += part;
    errors.push_back(place + ": " + error.description);
  }
  return errors;
}

}  // namespace skein::test
