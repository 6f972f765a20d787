// Every CSV has a schema that says of its columns what they are: beside it or, of one of many,
// above.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "experiments/commands/commands.h"
#include "experiments/tables/csv_columns.h"
#include "experiments/tables/csv_writer.h"
#include "experiments/tables/run_folder.h"
#include "tests/experiments/child_process.h"
#include "tests/experiments/csv_schema_check.h"
#include "tests/experiments/made_once.h"
#include "tests/places.h"
#include "tests/temporary_folder.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;

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
    ExpectTheSchemaFits(place / file);
    EXPECT_EQ(SchemaOf(place / file).parent_path(), (place / file).parent_path());
    ++files;
  }
  EXPECT_EQ(files, (2 + 3 + 5 + 6) + (2 + 3) + 2 * 4);  // run, raw, comparisons
}

TEST(CsvSchema, CertifyWritesItAnew) {
  const TemporaryFolder place;
  MakeRaw(place);
  fs::remove(place / "raw/raw/certificate.schema.json");
  ASSERT_EQ(Halfstep(place.path(), {"certify", "raw", "--quiet"}).status, kSuccess);
  ExpectTheSchemaFits(place / "raw/raw/certificate.csv");
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
