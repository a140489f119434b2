// A JSON Schema of protocol/schemas, as a judge of documents.
#pragma once

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

namespace spacetime {

inline nlohmann::json load_schema(const std::string& name) {
  std::ifstream file(std::filesystem::path(SPACETIME_SOURCE_DIR) / "protocol/schemas" / name);
  if (!file) throw std::runtime_error("there is no schema " + name);
  return nlohmann::json::parse(file);
}

class Schema {
 public:
  explicit Schema(const std::string& name) {
    const auto document = load_schema(name);
    const auto fetch = [](const std::string& other) { return new nlohmann::json(load_schema(other)); };
    valijson::SchemaParser(valijson::SchemaParser::kDraft7)
        .populateSchema<valijson::adapters::NlohmannJsonAdapter>(valijson::adapters::NlohmannJsonAdapter(document),
                                                                 schema_, fetch,
                                                                 [](const nlohmann::json* fetched) { delete fetched; });
  }
  bool accepts(const nlohmann::json& document) const {
    valijson::Validator validator(valijson::Validator::kStrongTypes);
    return validator.validate(schema_, valijson::adapters::NlohmannJsonAdapter(document), nullptr);
  }

 private:
  valijson::Schema schema_;
};

}  // namespace spacetime
