#include "experiments/tables/csv_writer.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "experiments/tables/csv_reader.h"
#include "tests/experiments/parsed_csv.h"
#include "tests/refusal_of.h"
#include "tests/temporary_folder.h"
#include "wpg/files/input_error.h"

namespace halfstep {
namespace {

using enum CsvType;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(CsvWriter, WritesEachKindOfCell) {
  CsvWriter csv({{"a"}, {"b", kInteger}, {"c", kInteger}, {"d", kBoolean}, {"e", kString}, {"f"}});
  csv.Cell(0.1).Cell(7).Cell(-8L).Cell(true).Cell("x").Empty().EndRow();
  EXPECT_EQ(csv.text(), "a,b,c,d,e,f\n0.1,7,-8,true,x,\n");
  EXPECT_EQ(csv.file().text, csv.text());
}

// So that pandas takes a column of whole numbers for float64 too.
TEST(CsvWriter, ANumberLooksLikeOne) {
  CsvWriter csv({{"x"}});
  for (const double value : {2.0, -0.0, 1e22, 5e-324, 0.25}) csv.Cell(value).EndRow();
  EXPECT_EQ(csv.text(), "x\n2.0\n-0.0\n1e+22\n5e-324\n0.25\n");
}

TEST(CsvWriter, RefusesACellOfAnotherType) {
  const CsvColumns columns = {{"n"}, {"i", kInteger}, {"b", kBoolean}, {"s", kString}};
  EXPECT_THROW(CsvWriter(columns).Cell(1), std::logic_error);
  EXPECT_THROW(CsvWriter(columns).Cell(true), std::logic_error);
  EXPECT_THROW(CsvWriter(columns).Cell("1"), std::logic_error);
  EXPECT_THROW(CsvWriter(columns).Cell(1.0).Cell(1.0), std::logic_error);
  EXPECT_THROW(CsvWriter(columns).Cell(1.0).Empty(), std::logic_error);
  EXPECT_THROW(CsvWriter(columns).Cell(1.0).Cell(1).Empty(), std::logic_error);
  EXPECT_THROW(CsvWriter(columns).Cell(1.0).Cell(1).Cell(true).Cell(""), std::logic_error);
}

TEST(CsvWriter, WritesNumbersThatAreNone) {
  CsvWriter csv({{"a"}, {"b"}, {"c"}, {"d"}});
  csv.Cell(kInfinity).Cell(-kInfinity).Cell(std::nan("")).Cell(-std::nan("")).EndRow();
  EXPECT_EQ(csv.text(), "a,b,c,d\ninf,-inf,nan,nan\n");
}

TEST(CsvWriter, NumbersReadBackToTheSameBits) {
  std::mt19937_64 random(1);
  CsvWriter csv({{"x"}});
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
  const std::vector<std::string> texts = {"a,b", "say \"no\"", "two\nlines", "\r", "\"", "plain #"};
  CsvWriter csv({{"left, right", kString}, {"n", kInteger}});
  for (const std::string& text : texts) csv.Cell(std::string_view(text)).Cell(1).EndRow();
  EXPECT_TRUE(csv.text().starts_with("\"left, right\",n\n\"a,b\",1\n\"say \"\"no\"\"\",1\n"));
  const ParsedCsv table(csv.text());
  ASSERT_EQ(table.size(), texts.size());
  for (size_t i = 0; i < texts.size(); ++i) EXPECT_EQ(table.Text(i, "left, right"), texts[i]);
}

// What spreadsheets and Python's csv module write.
TEST(CsvReader, TakesLinesOfWindowsAndAByteOrderMark) {
  const CsvTable table = ParseCsv("\xEF\xBB\xBFt_s,knee\r\n0,\"a\r\nb\"\r\n1,\r\n", "t.csv");
  EXPECT_EQ(table.header, (std::vector<std::string>{"t_s", "knee"}));
  EXPECT_EQ(table.Texts("knee"), (std::vector<std::string>{"a\r\nb", ""}));
  EXPECT_EQ(table.Numbers("t_s"), (std::vector<double>{0.0, 1.0}));
  EXPECT_THROW((void)ParseCsv("t_s\r\n0\r", "t.csv"), InputError);
}

TEST(CsvWriter, RefusesARowOfAnotherLength) {
  CsvWriter csv({{"a", kInteger}, {"b", kInteger}});
  EXPECT_THROW(csv.EndRow(), std::logic_error);
  csv.Cell(1);
  EXPECT_THROW(csv.EndRow(), std::logic_error);
  csv.Cell(2);
  EXPECT_THROW(csv.Cell(3), std::logic_error);
}

// Of a file that is read in many parts: quotes and line breaks lie on every place of them.
TEST(CsvReader, HandsOnTheRowsOfATable) {
  CsvWriter csv({{"i", kInteger}, {"text", kString}});
  for (int i = 0; i < 20'000; ++i) {
    csv.Cell(i).Cell(std::string(static_cast<size_t>(i % 7), 'x') + "\"a\", \n\"\"b").EndRow();
  }
  const TemporaryFolder place;
  WriteText(place / "a.csv", csv.text());
  const std::string path = (place / "a.csv").string();
  const CsvTable table = ReadCsv(path);
  ASSERT_EQ(table.rows.size(), 20'000u);
  EXPECT_EQ(table.rows[8][1], "x\"a\", \n\"\"b");
  size_t next = 0;
  const auto look = [&](size_t most) {
    return [&, most](const auto& header, const auto& cells) {
      EXPECT_EQ(header, table.header);
      EXPECT_EQ(cells, table.rows.at(next));
      return ++next < most;
    };
  };
  EachCsvRow(path, look(30'000));
  EXPECT_EQ(next, table.rows.size());
  next = 0;
  EachCsvRow(path, look(3));
  EXPECT_EQ(next, 3u);
  WriteText(place / "a.csv", csv.text() + "1");
  next = 0;
  EXPECT_NE(RefusalOf([&] { EachCsvRow(path, look(30'000)); }).find("the last line is cut"),
            std::string::npos);
}

}  // namespace
}  // namespace halfstep
