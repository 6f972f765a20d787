// Every CSV has a schema that says of its columns what they are: beside it or, of one of many,
// above.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "experiments/commands/commands.h"
#include "experiments/tables/csv_columns.h"
#include "experiments/tables/csv_writer.h"
#include "experiments/tables/run_folder.h"
#include "tests/experiments/child_process.h"
#include "tests/experiments/made_once.h"
#include "tests/experiments/parsed_csv.h"
#include "tests/places.h"
#include "tests/temporary_folder.h"

namespace halfstep {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

// Unit that a column's name ends in.
std::string UnitInName(const std::string& name) {
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

bool Parses(const std::string& cell, const std::string& type) {
  if (type == "string") return !cell.empty();
  if (type == "boolean") return cell == "true" || cell == "false";
  if (type == "integer") return cell.find_first_not_of("-0123456789") == std::string::npos;
  if (cell.empty() || cell == "nan" || cell == "inf" || cell == "-inf") return type == "number";
  char* end = nullptr;
  return std::isfinite(std::strtod(cell.c_str(), &end)) && *end == '\0' &&
         cell.find_first_of(".e") != std::string::npos;
}

void CheckSchema(const fs::path& path) {
  SCOPED_TRACE(path.string());
  const ParsedCsv table(ReadText(path));
  const json schema = json::parse(ReadText(fs::path(path).replace_extension("schema.json")));
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

void MakeRaw(const TemporaryFolder& place) {
  CopyMadeOnce(place.path(), {"run", ShippedConfig("fig3_two_half_steps"), "--out", "raw",
                              "--quiet", "--set", "smoothing.methods=[]"});
}

// A run with every table that there is, and a comparison of it.
void MakeTables(const TemporaryFolder& place) {
  CopyMadeOnce(place.path(), {"run", ShippedConfig("fig3_two_half_steps"), "--out", "run",
                              "--quiet", "--set", "smoothing.methods=[dichotomy, halfstep/barrier]",
                              "--set", "smoothing.optimizer.program=pareto", "--set",
                              "smoothing.optimizer.pareto_points=2", "--set",
                              "smoothing.optimizer.rounds=2", "--set", "output.period_s=0.02"});
  MakeRaw(place);
  for (const std::string name : {"run", "raw"}) {
    const Outcome compared =
        Halfstep(place.path(), {"compare", name, "--out", "compared-" + name, "--quiet"});
    ASSERT_EQ(compared.status, kSuccess) << compared.err;
  }
}

TEST(CsvSchema, StandsBesideEveryCsvAndFitsIt) {
  const TemporaryFolder place;
  MakeTables(place);
  int files = 0;
  for (const std::string& file : FilesBelow(place.path())) {
    if (!file.ends_with(".csv")) continue;
    CheckSchema(place / file);
    ++files;
  }
  EXPECT_EQ(files, (2 + 3 + 5 + 6) + (2 + 3) + 2 * 4);  // run, raw, comparisons
}

TEST(CsvSchema, CertifyWritesItAnew) {
  const TemporaryFolder place;
  MakeRaw(place);
  fs::remove(place / "raw/raw/certificate.schema.json");
  ASSERT_EQ(Halfstep(place.path(), {"certify", "raw", "--quiet"}).status, kSuccess);
  CheckSchema(place / "raw/raw/certificate.csv");
}

TEST(CsvSchema, OfOneThatHasOtherColumnsStandsBesideIt) {
  const TemporaryFolder place;
  RunFolder folder(place / "run", false);
  const auto write = [&](const std::string& name, const std::string& column) {
    CsvWriter csv({{column, CsvType::kInteger, "", "a number"}});
    WriteCsvOfMany(name, csv.Cell(1).file(), &folder);
  };
  write("walks/000/half_steps", "a");
  write("walks/001/half_steps", "a");
  write("walks/002/half_steps", "b");
  write("walks/003/half_steps", "a");
  std::vector<std::string> schemas;
  for (const auto& [name, file] : folder.written()) {
    if (name.ends_with(".schema.json")) schemas.push_back(name);
  }
  EXPECT_THAT(schemas, testing::ElementsAre("walks/002/half_steps.schema.json",
                                            "walks/half_steps.schema.json"));
}

// With the Python that has pandas, in one plain read_csv.
TEST(CsvSchema, PandasGivesEveryColumnItsType) {
  std::string python;
  for (const std::string candidate : {"/usr/bin/python3", "python3"}) {
    const std::string look = candidate + " -c 'import pandas' >/dev/null 2>&1";
    if (python.empty() && std::system(look.c_str()) == 0) python = candidate;
  }
  if (python.empty()) GTEST_SKIP() << "no Python with pandas";
  const TemporaryFolder place;
  MakeTables(place);
  const std::string check = python + " " + InSources("tests/experiments/check_types.py ") +
                            place.path().string() + " >" + (place / "said").string() + " 2>&1";
  EXPECT_EQ(std::system(check.c_str()), 0) << ReadText(place / "said");
}

}  // namespace
}  // namespace halfstep
