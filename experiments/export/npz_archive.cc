#include "experiments/export/npz_archive.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <string_view>

#include "wpg/check.h"
#include "wpg/files/input_error.h"

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
std::string NpyHeader(const std::string& type, const NpzArchive::Shape& shape) {
  std::string text = "{'descr': '" + type + "', 'fortran_order': False, 'shape': (";
  for (size_t i = 0; i < shape.size(); ++i) {
    text += (i == 0 ? "" : ", ") + std::to_string(shape[i]);
  }
  text += shape.size() == 1 ? ",), }" : "), }";
  while ((10 + text.size() + 1) % 64 != 0) text += ' ';
  text += '\n';
  std::string header("\x93NUMPY\x01\x00", 8);
  AppendNumber(text.size(), 2, &header);
  return header + text;
}

// Numbers of eight bytes.
template <typename Number>
std::string ArrayOfNumbers(const char* type, const NpzArchive::Shape& shape,
                           const std::vector<Number>& values) {
  size_t elements = 1;
  for (const size_t length : shape) elements *= length;
  HALFSTEP_CHECK(elements == values.size(), values.size() << " values in an array of " << elements);
  std::string array = NpyHeader(type, shape);
  array.reserve(array.size() + 8 * values.size());
  for (const Number& value : values) {
    AppendNumber(std::bit_cast<std::uint64_t>(value), 8, &array);
  }
  return array;
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

}  // namespace

void NpzArchive::Add(const std::string& name, const Shape& shape,
                     const std::vector<double>& values) {
  AddMember(name, ArrayOfNumbers("<f8", shape, values));
}

void NpzArchive::Add(const std::string& name, const Shape& shape,
                     const std::vector<std::int64_t>& values) {
  AddMember(name, ArrayOfNumbers("<i8", shape, values));
}

void NpzArchive::Add(const std::string& name, const std::vector<bool>& values) {
  std::string array = NpyHeader("|b1", {values.size()});
  for (const bool value : values) array += value ? '\1' : '\0';
  AddMember(name, array);
}

void NpzArchive::Add(const std::string& name, const std::vector<std::string>& values) {
  std::vector<std::u32string> texts;
  size_t longest = 1;
  for (const std::string& value : values) {
    texts.push_back(CodePoints(value));
    longest = std::max(longest, texts.back().size());
  }
  std::string array = NpyHeader("<U" + std::to_string(longest), {values.size()});
  for (const std::u32string& text : texts) {
    for (size_t i = 0; i < longest; ++i) AppendNumber(i < text.size() ? text[i] : 0, 4, &array);
  }
  AddMember(name, array);
}

void NpzArchive::AddMember(const std::string& name, const std::string& content) {
  const std::string file = name + ".npy";
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
  AppendNumber(file.size(), 2, &what);
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
  directory_ += file;
  bytes_ += std::string("PK\x03\x04", 4) + what + file + content;
  ++members_;
  const std::uint64_t size = bytes_.size() + directory_.size() + 22;  // of the finished file
  if (size < kMostZipBytes && members_ < 0xffff) return;
  throw InputError({path_ + ": is too large for an archive of 4 GiB (valid: " + help_ + ")"});
}

std::string NpzArchive::Finished() const {
  std::string file = bytes_ + directory_ + std::string("PK\x05\x06", 4);
  AppendNumber(0, 4, &file);  // this disk, and that of the directory
  AppendNumber(members_, 2, &file);
  AppendNumber(members_, 2, &file);
  AppendNumber(directory_.size(), 4, &file);
  AppendNumber(bytes_.size(), 4, &file);
  AppendNumber(0, 2, &file);  // comment
  return file;
}

}  // namespace halfstep
