#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace halfstep::verify {

/// Bytes of a file. Throws InputError when it cannot be read, is no regular file or exceeds 1 GiB.
std::string ReadBytes(const std::string& path);

/// A CSV table, strict: every line ends in \n, every row has as many cells as the header, cells may
/// be quoted as in RFC 4180 but hold no line breaks.
class CsvText {
 public:
  /// Throws InputError "path:line: …" for text that is no such table, or whose header is not
  /// `header`.
  CsvText(std::string path, const std::string& text, const std::vector<std::string>& header);
  /// Calls `read` with a few thousand rows after the other, so that not all are held at once; rows
  /// count from the first one of these. Throws as the constructor, after what `read` had before.
  static void InParts(std::string path, const std::string& text,
                      const std::vector<std::string>& header,
                      const std::function<void(const CsvText&)>& read);

  size_t size() const { return rows_.size(); }  ///< number of rows
  /// Text of a cell.
  const std::string& Cell(size_t row, size_t column) const { return rows_[row][column]; }
  /// A decimal number, inf, -inf or nan. Throws InputError.
  double Number(size_t row, size_t column) const;
  /// A whole number in [1, 1e9]. Throws InputError.
  int Positive(size_t row, size_t column) const { return Whole(row, column, 1); }
  /// A whole number in [least, 1e9]. Throws InputError.
  int Whole(size_t row, size_t column, int least) const;
  /// One of a few words. Throws InputError.
  const std::string& Word(size_t row, size_t column, const std::vector<std::string>& words) const;
  /// Throws InputError unless the first cell of a row is that number.
  void CheckFirst(size_t row, int number) const;
  /// Throws InputError about a cell.
  [[noreturn]] void Refuse(size_t row, size_t column, const std::string& what) const;

 private:
  CsvText() = default;
  // Calls `read`, if there is one, before rows are forgotten.
  void Parse(std::string_view text, const std::function<void(const CsvText&)>& read);

  std::string path_;
  std::vector<std::string> header_;
  std::vector<std::vector<std::string>> rows_;
  size_t before_ = 0;  // rows that are forgotten
};

}  // namespace halfstep::verify
