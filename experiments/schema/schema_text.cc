#include <cmath>
#include <nlohmann/json.hpp>

#include "experiments/config/key_tables.h"
#include "experiments/schema/schema.h"
#include "experiments/tables/margin_columns.h"
#include "smoothing/margins/family_traits.h"
#include "smoothing/walk/parameter_families.h"

namespace halfstep {
namespace {

using nlohmann::ordered_json;

ordered_json ParameterJson(ParameterFamily family) {
  const ParameterFamilyTraits& traits = Traits(family);
  ordered_json bounds = ordered_json::array();
  for (const ParameterBoundKey& bound : traits.bounds()) bounds.push_back(bound.key);
  const bool bounded = std::isfinite(traits.most);
  return {{"name", traits.name},
          {"values", PluralOf(traits)},
          {"unit", traits.unit},
          {"of", Name(traits.of)},
          {"least", traits.least},
          {"least_itself", traits.least_itself},
          {"most", bounded ? ordered_json(traits.most) : ordered_json()},
          {"table", traits.table()},
          {"column", traits.column},
          {"meaning", traits.meaning},
          {"key", traits.key},
          {"bounds", bounds}};
}

ordered_json MarginJson(MarginFamily family) {
  const FamilyTraits& traits = Traits(family);
  ordered_json row = {{"name", traits.name},
                      {"unit", traits.unit},
                      {"scale", traits.scale},
                      {"demanded", traits.demanded == kNotDemanded ? ordered_json()
                                                                   : ordered_json(traits.demanded)},
                      {"may_be_none", traits.may_be_none},
                      {"raised", traits.raised},
                      {"key", traits.key},
                      {"meaning", traits.meaning}};
  if (const auto column = TrajectoryColumnOf(family)) row["column"] = *column;
  return row;
}

void AddKeys(const std::vector<KeyDescription>& keys, ordered_json* rows) {
  for (const KeyDescription& key : keys) {
    rows->push_back({{"name", key.path}, {"row", KeyRow(key)}});
    AddKeys(key.keys, rows);
  }
}

}  // namespace

std::string SchemaText(const Schema& schema) {
  ordered_json json = {{"parameters", ordered_json::array()},
                       {"margins", ordered_json::array()},
                       {"tables", ordered_json::object()},
                       {"keys", ordered_json::object()}};
  for (const ParameterFamily family : schema.parameters) {
    json["parameters"].push_back(ParameterJson(family));
  }
  for (const MarginFamily family : schema.margins) json["margins"].push_back(MarginJson(family));
  for (const TableSchema& table : schema.tables) {
    json["tables"][table.name] = ordered_json::parse(SchemaJson(table.columns))["fields"];
  }
  for (const FileSchema& file : schema.files) {
    ordered_json& rows = json["keys"][file.name] = ordered_json::array();
    AddKeys(file.keys, &rows);
  }
  return json.dump(1) + "\n";
}

}  // namespace halfstep
