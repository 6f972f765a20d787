#include "experiments/export/npz_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>

#include "experiments/tables/csv_reader.h"
#include "wpg/files/input_error.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

constexpr std::uint64_t kMostZipBytes = std::numeric_limits<std::uint32_t>::max();
constexpr int kZipDate = (1 << 5) | 1;  // 1 January 1980, the first day that zip files know

// The lowest `bytes` bytes of a number, the least significant first.
void AppendNumber(std::uint64_t value, int bytes, std::string* out) {
  for (int i = 0; i < bytes; ++i) *out += static_cast<char>((value >> (8 * i)) & 0xff);
}

// CRC-32 of zip files: polynomial 0xEDB88320, reflected.
std::uint32_t Crc32(const std::string& bytes) {
  static const std::array<std::uint32_t, 256> table = [] {
    std::array<std::uint32_t, 256> entries{};
    for (std::uint32_t i = 0; i < 256; ++i) {
      std::uint32_t entry = i;
      for (int bit = 0; bit < 8; ++bit) entry = (entry >> 1) ^ ((entry & 1) ? 0xEDB88320u : 0u);
      entries[i] = entry;
    }
    return entries;
  }();
  std::uint32_t crc = 0xffffffffu;
  for (const char c : bytes) crc = table[(crc ^ static_cast<unsigned char>(c)) & 0xff] ^ (crc >> 8);
  return crc ^ 0xffffffffu;
}

// The header of a .npy file, padded so that the data begin at a multiple of 64 bytes.
std::string NpyHeader(const std::string& type, size_t rows) {
  std::string text = "{'descr': '" + type + "', 'fortran_order': False, 'shape': (" +
                     std::to_string(rows) + ",), }";
  while ((10 + text.size() + 1) % 64 != 0) text += ' ';
  text += '\n';
  std::string header("\x93NUMPY\x01\x00", 8);
  AppendNumber(text.size(), 2, &header);
  return header + text;
}

// UTF-8 as code points; bytes that are none stand for themselves.
std::u32string CodePoints(const std::string& text) {
  std::u32string points;
  for (size_t i = 0; i < text.size();) {
    const auto lead = static_cast<unsigned char>(text[i]);
    const size_t more = lead < 0xc0 ? 0 : lead < 0xe0 ? 1 : lead < 0xf0 ? 2 : 3;
    char32_t point = more == 0 ? lead : lead & (0x3f >> more);
    for (size_t k = 1; k <= more && i + k < text.size(); ++k) {
      point = (point << 6) | (static_cast<unsigned char>(text[i + k]) & 0x3f);
    }
    points += point;
    i += more + 1;
  }
  return points;
}

std::string TextArray(const std::vector<std::string>& cells) {
  std::vector<std::u32string> texts;
  size_t longest = 1;
  for (const std::string& cell : cells) {
    texts.push_back(CodePoints(cell));
    longest = std::max(longest, texts.back().size());
  }
  std::string array = NpyHeader("<U" + std::to_string(longest), cells.size());
  for (const std::u32string& text : texts) {
    for (size_t i = 0; i < longest; ++i) AppendNumber(i < text.size() ? text[i] : 0, 4, &array);
  }
  return array;
}

[[noreturn]] void RefuseCell(const std::string& path, size_t row, const std::string& column) {
  throw InputError(
      {path + ":" + std::to_string(row + 2) + ": " + column + ": is not of its column's type"});
}

template <typename Value>
Value ParseCell(const std::string& cell, const std::string& path, size_t row,
                const std::string& column) {
  Value value{};
  const char* const end = cell.data() + cell.size();
  const auto read = std::from_chars(cell.data(), end, value);
  if (read.ec != std::errc() || read.ptr != end) RefuseCell(path, row, column);
  return value;
}

std::string ArrayOf(const CsvColumn& column, const std::vector<std::string>& cells,
                    const std::string& path) {
  if (column.type == CsvType::kString) return TextArray(cells);
  const bool boolean = column.type == CsvType::kBoolean;
  const bool integer = column.type == CsvType::kInteger;
  std::string array = NpyHeader(boolean ? "|b1" : integer ? "<i8" : "<f8", cells.size());
  for (size_t row = 0; row < cells.size(); ++row) {
    const std::string& cell = cells[row];
    if (boolean) {
      if (cell != "true" && cell != "false") RefuseCell(path, row, column.name);
      array += static_cast<char>(cell == "true");
    } else if (integer) {
      const auto value = ParseCell<std::int64_t>(cell, path, row, column.name);
      AppendNumber(static_cast<std::uint64_t>(value), 8, &array);
    } else {
      const double value =
          cell.empty() ? std::nan("") : ParseCell<double>(cell, path, row, column.name);
      AppendNumber(std::bit_cast<std::uint64_t>(value), 8, &array);
    }
  }
  return array;
}

/// A zip file whose members are stored as they are.
class StoredZip {
 public:
  void Add(const std::string& name, const std::string& content) {
    // Version, flags, method 0, time and date, CRC, both sizes, lengths of name and extra field.
    std::string what;
    AppendNumber(20, 2, &what);
    AppendNumber(0, 2, &what);
    AppendNumber(0, 2, &what);
    AppendNumber(0, 2, &what);
    AppendNumber(kZipDate, 2, &what);
    AppendNumber(Crc32(content), 4, &what);
    AppendNumber(content.size(), 4, &what);
    AppendNumber(content.size(), 4, &what);
    AppendNumber(name.size(), 2, &what);
    AppendNumber(0, 2, &what);
    // Here also: comment, disk, two kinds of attributes, where the member begins.
    directory_ += std::string("PK\x01\x02", 4);
    AppendNumber(20, 2, &directory_);
    directory_ += what;
    AppendNumber(0, 2, &directory_);
    AppendNumber(0, 2, &directory_);
    AppendNumber(0, 2, &directory_);
    AppendNumber(0, 4, &directory_);
    AppendNumber(bytes_.size(), 4, &directory_);
    directory_ += name;
    bytes_ += std::string("PK\x03\x04", 4) + what + name + content;
    ++members_;
  }

  /// Of the finished file.
  std::uint64_t size() const { return bytes_.size() + directory_.size() + 22; }
  std::uint64_t members() const { return members_; }

  std::string Finished() const {
    std::string file = bytes_ + directory_ + std::string("PK\x05\x06", 4);
    AppendNumber(0, 4, &file);  // this disk, and that of the directory
    AppendNumber(members_, 2, &file);
    AppendNumber(members_, 2, &file);
    AppendNumber(directory_.size(), 4, &file);
    AppendNumber(bytes_.size(), 4, &file);
    AppendNumber(0, 2, &file);  // comment
    return file;
  }

 private:
  std::string bytes_, directory_;
  std::uint64_t members_ = 0;
};

}  // namespace

std::string NpzFile(const CsvFile& table, const std::string& path) {
  const CsvTable csv = ParseCsv(table.text, path);
  StoredZip zip;
  for (const CsvColumn& column : table.columns) {
    zip.Add(column.name + ".npy", ArrayOf(column, csv.Texts(column.name), path));
    if (zip.size() < kMostZipBytes && zip.members() < 0xffff) continue;
    throw InputError({path + ": is too large for an archive of 4 GiB (valid: a longer --period, "
                             "fewer --columns)"});
  }
  return zip.Finished();
}

}  // namespace halfstep
