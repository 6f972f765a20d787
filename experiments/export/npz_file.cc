#include "experiments/export/npz_file.h"

#include <charconv>
#include <cmath>
#include <cstdint>

#include "experiments/export/npz_archive.h"
#include "experiments/tables/csv_reader.h"
#include "wpg/files/input_error.h"

namespace halfstep {
namespace {

// The cells of one column on their way into an array.
class ColumnCells {
 public:
  ColumnCells(const CsvColumn& column, std::vector<std::string> cells, const std::string& path)
      : column_(column), cells_(std::move(cells)), path_(path) {}

  void AddTo(NpzArchive* archive) const {
    switch (column_.type) {
      case CsvType::kString:
        return archive->Add(column_.name, cells_);
      case CsvType::kBoolean:
        return archive->Add(column_.name, Booleans());
      case CsvType::kInteger:
        return archive->Add(column_.name, {cells_.size()}, Numbers<std::int64_t>());
      case CsvType::kNumber:
        return archive->Add(column_.name, {cells_.size()}, Numbers<double>());
    }
  }

 private:
  [[noreturn]] void Refuse(size_t row) const {
    throw InputError({path_ + ":" + std::to_string(row + 2) + ": " + column_.name +
                      ": is not of its column's type"});
  }

  std::vector<bool> Booleans() const {
    std::vector<bool> values;
    for (size_t row = 0; row < cells_.size(); ++row) {
      if (cells_[row] != "true" && cells_[row] != "false") Refuse(row);
      values.push_back(cells_[row] == "true");
    }
    return values;
  }

  // An empty cell of a column of float64 is nan.
  template <typename Value>
  std::vector<Value> Numbers() const {
    std::vector<Value> values;
    for (size_t row = 0; row < cells_.size(); ++row) {
      const std::string& cell = cells_[row];
      Value value{};
      if (cell.empty() && std::is_floating_point_v<Value>) {
        value = static_cast<Value>(std::nan(""));
      } else {
        const char* const end = cell.data() + cell.size();
        const auto read = std::from_chars(cell.data(), end, value);
        if (read.ec != std::errc() || read.ptr != end) Refuse(row);
      }
      values.push_back(value);
    }
    return values;
  }

  const CsvColumn& column_;
  const std::vector<std::string> cells_;
  const std::string& path_;
};

}  // namespace

std::string NpzFile(const CsvFile& table, const std::string& path) {
  const CsvTable csv = ParseCsv(table.text, path);
  NpzArchive archive(path, "a longer --period, fewer --columns");
  for (const CsvColumn& column : table.columns) {
    ColumnCells(column, csv.Texts(column.name), path).AddTo(&archive);
  }
  return archive.Finished();
}

}  // namespace halfstep
