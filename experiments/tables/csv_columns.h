#pragma once

#include <string>
#include <vector>

namespace halfstep {

class RunFolder;

/// What a cell of a column can be. pandas reads them as int64, float64, bool and object.
enum class CsvType { kInteger, kNumber, kBoolean, kString };

/// What a column says between its rows.
enum class CsvInterpolation {
  kNone,               ///< nothing
  kPiecewiseConstant,  ///< its value until the next row
  kLinear              ///< linear between rows
};

/// What a column of a CSV is. The header and the schema beside the file both come from here.
struct CsvColumn {
  std::string name;                                          ///< ends in its unit where it has one
  CsvType type = CsvType::kNumber;                           ///< what a cell holds
  std::string unit = {};                                     ///< "m", "rad/s"; "": without
  std::string description = {};                              ///< a phrase
  std::string frame = {};                                    ///< "W": expressed in it; "": in none
  CsvInterpolation interpolation = CsvInterpolation::kNone;  ///< how values between rows are found
};
/// The columns of a table, in their order.
using CsvColumns = std::vector<CsvColumn>;

/// A table in memory: its columns and the whole text.
struct CsvFile {
  CsvColumns columns;  ///< in their order
  std::string text;    ///< header and rows
};

/// The columns as a Table Schema, with `unit`, `frame` and `interpolation` as properties of our
/// own. Source: [FrictionlessTableSchema].
std::string SchemaJson(const CsvColumns& columns);

/// Writes NAME.csv and NAME.schema.json: `name` is "dichotomy/overlaps". Throws as RunFolder.
void WriteCsv(const std::string& name, const CsvFile& file, RunFolder* folder);

/// The same of "walks/007/overlaps", one of many: the schema of the first of them is that of all,
/// walks/overlaps.schema.json. Beside a table one stands where its columns are others.
void WriteCsvOfMany(const std::string& name, const CsvFile& file, RunFolder* folder);

}  // namespace halfstep
