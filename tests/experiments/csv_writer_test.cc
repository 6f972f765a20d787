#include "experiments/csv_writer.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <stdexcept>

#include "tests/experiments/parsed_csv.h"

namespace halfstep {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(CsvWriter, WritesEachKindOfCell) {
  CsvWriter csv({"a", "b", "c", "d", "e", "f"});
  csv.Cell(0.1).Cell(7).Cell(-8L).Cell(true).Cell("x").Empty().EndRow();
  EXPECT_EQ(csv.text(), "a,b,c,d,e,f\n0.1,7,-8,true,x,\n");
}

TEST(CsvWriter, WritesNumbersThatAreNone) {
  CsvWriter csv({"a", "b", "c", "d"});
  csv.Cell(kInfinity).Cell(-kInfinity).Cell(std::nan("")).Cell(-std::nan("")).EndRow();
  EXPECT_EQ(csv.text(), "a,b,c,d\ninf,-inf,nan,nan\n");
}

TEST(CsvWriter, NumbersReadBackToTheSameBits) {
  std::mt19937_64 random(1);
  CsvWriter csv({"x"});
  std::vector<double> values = {0.0, -0.0, 5e-324, std::numeric_limits<double>::max(), 1.0 / 3};
  while (values.size() < 2000) {
    const double value = std::bit_cast<double>(random());
    if (std::isfinite(value)) values.push_back(value);
  }
  for (const double value : values) csv.Cell(value).EndRow();
  const ParsedCsv table(csv.text());
  ASSERT_EQ(table.size(), values.size());
  for (size_t i = 0; i < values.size(); ++i) {
    EXPECT_EQ(std::bit_cast<std::uint64_t>(table.Number(i, "x")),
              std::bit_cast<std::uint64_t>(values[i]));
  }
}

TEST(CsvWriter, QuotesWhatWouldBreakATable) {
  const std::vector<std::string> texts = {"a,b", "say \"no\"", "two\nlines", "\r", "\"", "plain #",
                                          ""};
  CsvWriter csv({"left, right", "n"});
  for (const std::string& text : texts) csv.Cell(std::string_view(text)).Cell(1).EndRow();
  EXPECT_TRUE(csv.text().starts_with("\"left, right\",n\n\"a,b\",1\n\"say \"\"no\"\"\",1\n"));
  const ParsedCsv table(csv.text());
  ASSERT_EQ(table.size(), texts.size());
  for (size_t i = 0; i < texts.size(); ++i) EXPECT_EQ(table.Text(i, "left, right"), texts[i]);
}

TEST(CsvWriter, RefusesARowOfAnotherLength) {
  CsvWriter csv({"a", "b"});
  EXPECT_THROW(csv.EndRow(), std::logic_error);
  csv.Cell(1);
  EXPECT_THROW(csv.EndRow(), std::logic_error);
  csv.Cell(2).Cell(3);
  EXPECT_THROW(csv.EndRow(), std::logic_error);
}

}  // namespace
}  // namespace halfstep
