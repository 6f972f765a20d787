#pragma once

#include <string>
#include <vector>

#include "experiments/tables/csv_columns.h"
#include "smoothing/margins/margin.h"
#include "smoothing/walk/parameter_family.h"
#include "wpg/files/key_description.h"

namespace halfstep {

/// A CSV that a command writes.
struct TableSchema {
  std::string name;    ///< what writes it, and its file without extension: "run/overlaps"
  CsvColumns columns;  ///< all that it may have, in their order
};

/// A kind of YAML file that people write.
struct FileSchema {
  std::string name;                  ///< "config"
  std::vector<KeyDescription> keys;  ///< in the order of their declaration
};

/// Every name that files and pages may use, as the tables of the code have them. Columns of a leg's
/// joint are those of a joint called JOINT.
struct Schema {
  std::vector<ParameterFamily> parameters;  ///< in the order of programs and files
  std::vector<MarginFamily> margins;        ///< in the order of certificates
  std::vector<TableSchema> tables;          ///< of runs, comparisons, sweeps, episodes, replays
  std::vector<FileSchema> files;            ///< configs, sweeps, episodes, robots
};

/// The schema of this build.
Schema MakeSchema();

/// The schema as JSON: the rows of families, the columns of tables as Table Schemas, the keys of
/// files with the texts of their Markdown table.
std::string SchemaText(const Schema& schema);

}  // namespace halfstep
