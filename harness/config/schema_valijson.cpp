// The one source file that knows valijson, which is slow to compile.
#include "harness/config/json_source.h"
#include "harness/config/schema.h"

#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

namespace hybray {
namespace {

// valijson gives the way to a value as "<root>", "[key]" or "[0]".
std::string pointer_of(const std::vector<std::string>& context) {
  std::string pointer;
  for (const std::string& step : context) {
    if (step.size() >= 2 && step.front() == '[')
      pointer = child_pointer(pointer, step.substr(1, step.size() - 2));
  }
  return pointer;
}

}  // namespace

std::vector<SchemaViolation> schema_violations(const nlohmann::ordered_json& schema,
                                               const nlohmann::ordered_json& document) {
  const nlohmann::json plain_schema = schema, plain_document = document;
  valijson::Schema parsed;
  valijson::SchemaParser(valijson::SchemaParser::kDraft7)
      .populateSchema(valijson::adapters::NlohmannJsonAdapter(plain_schema), parsed);
  valijson::Validator validator(valijson::Validator::kStrongTypes);
  valijson::ValidationResults results;
  std::vector<SchemaViolation> violations;
  if (validator.validate(parsed, valijson::adapters::NlohmannJsonAdapter(plain_document), &results))
    return violations;
  for (const auto& error : results) violations.push_back({pointer_of(error.context), error.description});
  if (violations.empty()) violations.push_back({"", "the document does not match the schema"});
  return violations;
}

}  // namespace hybray
