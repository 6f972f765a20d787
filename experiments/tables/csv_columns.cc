#include "experiments/tables/csv_columns.h"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "experiments/tables/run_folder.h"
#include "wpg/files/sha256.h"

namespace halfstep {
namespace {

const char* Name(CsvType type) {
  switch (type) {
    case CsvType::kInteger:
      return "integer";
    case CsvType::kNumber:
      return "number";
    case CsvType::kBoolean:
      return "boolean";
    case CsvType::kString:
      return "string";
  }
  return "";
}

const char* Name(CsvInterpolation interpolation) {
  switch (interpolation) {
    case CsvInterpolation::kNone:
      return "none";
    case CsvInterpolation::kPiecewiseConstant:
      return "piecewise constant";
    case CsvInterpolation::kLinear:
      return "linear";
  }
  return "";
}

}  // namespace

std::string SchemaJson(const CsvColumns& columns) {
  nlohmann::ordered_json schema;
  schema["fields"] = nlohmann::ordered_json::array();
  for (const CsvColumn& column : columns) {
    nlohmann::ordered_json field = {{"name", column.name}, {"type", Name(column.type)}};
    if (!column.unit.empty()) field["unit"] = column.unit;
    field["description"] = column.description;
    if (!column.frame.empty()) field["frame"] = column.frame;
    field["interpolation"] = Name(column.interpolation);
    schema["fields"].push_back(field);
  }
  schema["missingValues"] = {""};
  return schema.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

void WriteCsv(const std::string& name, const CsvFile& file, RunFolder* folder) {
  folder->Write(name + ".csv", file.text);
  folder->Write(name + ".schema.json", SchemaJson(file.columns));
}

void WriteCsvOfMany(const std::string& name, const CsvFile& file, RunFolder* folder) {
  folder->Write(name + ".csv", file.text);
  const std::filesystem::path path = name + ".schema.json";
  const std::string of_all = (path.parent_path().parent_path() / path.filename()).string();
  const std::string schema = SchemaJson(file.columns);
  const auto there = folder->written().find(of_all);
  if (there == folder->written().end()) {
    folder->Write(of_all, schema);
  } else if (there->second.sha256 != Sha256(schema)) {
    folder->Write(path.string(), schema);
  }
}

}  // namespace halfstep
