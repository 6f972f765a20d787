#include "wpg/files/mesh_text.h"

#include <charconv>
#include <cmath>
#include <utility>

#include "wpg/files/input_error.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

bool IsBlank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

}  // namespace

void RefuseByte(const std::string& path, size_t byte, const std::string& what) {
  Complaints complaints;
  complaints.Add(path, 0, 0, "", "byte " + std::to_string(byte) + ": " + what);
  throw InputError(complaints.lines());
}

MeshText::MeshText(std::string path, std::string_view text) : path_(std::move(path)), text_(text) {
  if (text_.starts_with("\xEF\xBB\xBF")) at_ = line_start_ = 3;  // byte order mark
}

MeshWord MeshText::NextInLine() {
  while (at_ < text_.size() && IsBlank(text_[at_])) ++at_;
  const size_t start = at_;
  while (at_ < text_.size() && !IsBlank(text_[at_]) && text_[at_] != '\n') ++at_;
  return {text_.substr(start, at_ - start), line_, static_cast<int>(start - line_start_) + 1};
}

MeshWord MeshText::Next() {
  MeshWord word = NextInLine();
  while (word.text.empty() && at_ < text_.size()) {
    SkipLine();
    word = NextInLine();
  }
  return word;
}

void MeshText::SkipLine() {
  const size_t end = text_.find('\n', at_);
  if (end == std::string_view::npos) {
    at_ = text_.size();
    return;
  }
  at_ = line_start_ = end + 1;
  ++line_;
}

double MeshText::Number(const MeshWord& word) const {
  if (word.text.empty()) Fail(word, "a number is missing");
  std::string_view digits = word.text;
  if (digits.starts_with('+') && !digits.starts_with("+-")) digits.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const bool whole = end == digits.data() + digits.size();
  if (error == std::errc::invalid_argument || !whole) {
    Fail(word, Quote(word.text) + " is not a number");
  }
  // Out of range and yet a negative exponent: nearer to zero than any double.
  const bool out_of_range = error == std::errc::result_out_of_range;
  if (out_of_range && digits.find_first_of("eE") + 1 == digits.find("-", 1)) return 0.0;
  if (error != std::errc() || !(std::abs(value) <= kMaxMeshCoordinate)) {
    Fail(word, Quote(word.text) + " is not a finite coordinate (valid: -1e9 … 1e9)");
  }
  return value;
}

long MeshText::Integer(const MeshWord& word, std::string_view text) const {
  long value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) {
    Fail(word, Quote(word.text) + " is no corner of a face (valid: v, v/vt, v//vn, v/vt/vn)");
  }
  return value;
}

void MeshText::Fail(const MeshWord& word, const std::string& what) const {
  Complaints complaints;
  complaints.Add(path_, word.line, word.column, "", what);
  throw InputError(complaints.lines());
}

LoadedMesh MeshOf(const std::vector<double>& coordinates, const std::vector<int>& corners) {
  LoadedMesh mesh;
  mesh.vertices = Eigen::Map<const Eigen::Matrix3Xd>(
      coordinates.data(), 3, static_cast<Eigen::Index>(coordinates.size() / 3));
  mesh.triangles = Eigen::Map<const Eigen::Matrix3Xi>(
      corners.data(), 3, static_cast<Eigen::Index>(corners.size() / 3));
  return mesh;
}

}  // namespace halfstep
