// A CSV against the schema that says of its columns what they are.
#ifndef HALFSTEP_TESTS_EXPERIMENTS_CSV_SCHEMA_CHECK_H_
#define HALFSTEP_TESTS_EXPERIMENTS_CSV_SCHEMA_CHECK_H_

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tests/experiments/parsed_csv.h"
#include "tests/temporary_folder.h"

namespace halfstep {

// Unit that a column's name ends in.
inline std::string UnitInName(const std::string& name) {
  for (const auto& [ending, unit] :
       std::vector<std::pair<std::string, std::string>>{{"_n_m", "N m"},
                                                        {"_m_s2", "m/s2"},
                                                        {"_rad_s", "rad/s"},
                                                        {"_m_s", "m/s"},
                                                        {"_rad", "rad"},
                                                        {"_m", "m"},
                                                        {"_s", "s"}}) {
    if (name.ends_with(ending)) return unit;
  }
  return "";
}

inline bool Parses(const std::string& cell, const std::string& type) {
  if (type == "string") return !cell.empty();
  if (type == "boolean") return cell == "true" || cell == "false";
  if (type == "integer") return cell.find_first_not_of("-0123456789") == std::string::npos;
  if (cell.empty() || cell == "nan" || cell == "inf" || cell == "-inf") return type == "number";
  char* end = nullptr;
  return std::isfinite(std::strtod(cell.c_str(), &end)) && *end == '\0' &&
         cell.find_first_of(".e") != std::string::npos;
}

// Its schema: beside it, or of one of many above their folders.
inline std::filesystem::path SchemaOf(const std::filesystem::path& csv) {
  std::filesystem::path schema = csv;
  schema.replace_extension("schema.json");
  if (std::filesystem::exists(schema)) return schema;
  return csv.parent_path().parent_path() / schema.filename();
}

inline void ExpectTheSchemaFits(const std::filesystem::path& csv) {
  using nlohmann::json;
  SCOPED_TRACE(csv.string());
  const ParsedCsv table(ReadText(csv));
  const json schema = json::parse(ReadText(SchemaOf(csv)));
  EXPECT_EQ(schema["missingValues"], json::array({""}));
  std::vector<std::string> names;
  for (const json& field : schema["fields"]) {
    const std::string name = field["name"], type = field["type"];
    names.push_back(name);
    EXPECT_NE(field["description"], "") << name;
    EXPECT_THAT(field["interpolation"], testing::AnyOf("none", "linear", "piecewise constant"));
    if (const std::string unit = UnitInName(name); !unit.empty()) {
      EXPECT_EQ(field["unit"], unit) << name;
    }
    for (size_t row = 0; row < table.size(); ++row) {
      ASSERT_TRUE(Parses(table.Text(row, name), type))
          << name << ": '" << table.Text(row, name) << "' is no " << type;
    }
  }
  EXPECT_EQ(names, table.header());
}

}  // namespace halfstep

#endif  // HALFSTEP_TESTS_EXPERIMENTS_CSV_SCHEMA_CHECK_H_
