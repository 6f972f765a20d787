#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "wpg/files/point_data.h"
#include "wpg/files/text.h"

namespace halfstep {

namespace {

struct PcdHeader {
  std::vector<PointField> fields;
  long width = -1, height = -1, count = -1;  // -1: not said
  MeshWord data;                             // the word DATA, with which the header ends
};

// One line of the header, whose first word is `word`.
void ReadPcdLine(const MeshWord& word, MeshText* text, PcdHeader* header) {
  const auto each = [&](const auto& take) {
    for (PointField& field : header->fields) take(text->NextInLine(), &field);
  };
  if (word.text == "VERSION" || word.text == "VIEWPOINT") return;
  if (word.text == "FIELDS") {
    header->fields.clear();
    for (MeshWord name = text->NextInLine(); !name.text.empty(); name = text->NextInLine()) {
      if (header->fields.size() == kMaxPointFields) text->Fail(name, "too many fields");
      header->fields.push_back({.name = std::string(name.text), .scalar = {}});
    }
  } else if (word.text == "SIZE") {
    each([&](const MeshWord& size, PointField* field) {
      const long of = PointCount(*text, size, 8);
      if (of != 1 && of != 2 && of != 4 && of != 8) text->Fail(size, "valid: 1, 2, 4 or 8");
      field->scalar.bytes = static_cast<size_t>(of);
    });
  } else if (word.text == "TYPE") {
    each([&](const MeshWord& type, PointField* field) {
      if (type.text != "F" && type.text != "I" && type.text != "U") {
        text->Fail(type, Quote(type.text) + " is no type (valid: F, I or U)");
      }
      field->scalar.kind = type.text[0];
    });
  } else if (word.text == "COUNT") {
    each([&](const MeshWord& of, PointField* field) {
      field->count = static_cast<size_t>(PointCount(*text, of, 1'000'000));
    });
  } else if (word.text == "WIDTH") {
    header->width = PointCount(*text, text->NextInLine(), kMaxPoints);
  } else if (word.text == "HEIGHT") {
    header->height = PointCount(*text, text->NextInLine(), kMaxPoints);
  } else if (word.text == "POINTS") {
    header->count = PointCount(*text, text->NextInLine(), kMaxPoints);
  } else {
    text->Fail(word, Quote(word.text) +
                         " (valid: VERSION, FIELDS, SIZE, TYPE, COUNT, WIDTH, HEIGHT, VIEWPOINT, "
                         "POINTS, DATA)");
  }
}

PcdHeader ReadPcdHeader(MeshText* text) {
  PcdHeader header;
  for (;; text->SkipLine()) {
    const MeshWord word = text->NextInLine();
    if (word.text.empty() && text->AtEnd()) {
      text->Fail(word, "the file ends within its header (valid: DATA ascii or binary)");
    }
    if (word.text.empty() || word.text[0] == '#') continue;
    header.data = word;
    if (word.text == "DATA") return header;
    ReadPcdLine(word, text, &header);
  }
}

// How many points there are, of a header that agrees with itself.
long CountOf(const PcdHeader& header, const MeshText& text) {
  for (const PointField& field : header.fields) {
    if (field.scalar.kind == 'F' && field.scalar.bytes < 4) {
      text.Fail(header.data, Quote(field.name) + " is a float of " +
                                 std::to_string(field.scalar.bytes) + " bytes (valid: 4 or 8)");
    }
  }
  long count = header.count;
  if (count < 0) count = header.width >= 0 ? header.width * std::max(header.height, 1L) : -1;
  if (count < 0) text.Fail(header.data, "the header says neither POINTS nor WIDTH");
  if (count > kMaxPoints) text.Fail(header.data, "too many points (valid: at most 20 million)");
  if (header.width >= 0 && header.height >= 0 && header.width * header.height != count) {
    text.Fail(header.data, "WIDTH times HEIGHT is not POINTS");
  }
  return count;
}

// A line with one point.
Eigen::Vector3d NextPoint(const std::vector<PointField>& fields, const std::array<size_t, 3>& axes,
                          MeshText* text) {
  Eigen::Vector3d p(0, 0, 0);
  for (size_t f = 0; f < fields.size(); ++f) {
    const auto axis = std::find(axes.begin(), axes.end(), f) - axes.begin();
    for (size_t k = 0; k < fields[f].count; ++k) {
      const MeshWord number = text->NextInLine();
      if (number.text.empty()) text->Fail(number, "a number is missing");
      if (axis < 3) p[axis] = PointNumber(*text, number);
    }
  }
  if (const MeshWord more = text->NextInLine(); !more.text.empty()) {
    text->Fail(more, "more numbers than fields");
  }
  text->SkipLine();
  return p;
}

}  // namespace

LoadedPoints ReadPcd(const std::string& path, std::string_view bytes) {
  MeshText text(path, bytes);
  const PcdHeader header = ReadPcdHeader(&text);
  const std::array<size_t, 3> axes = PointAxes(text, header.data, header.fields);
  const long count = CountOf(header, text);
  const MeshWord kind = text.NextInLine();
  text.SkipLine();
  PointList points;
  if (kind.text == "ascii") {
    for (long i = 0; i < count; ++i) points.Add(NextPoint(header.fields, axes, &text));
    return points.Take(path);
  }
  if (kind.text != "binary") {
    text.Fail(kind, Quote(kind.text) +
                        " data (valid: ascii or binary; `pcl_convert_pcd_ascii_binary` unpacks "
                        "binary_compressed)");
  }
  PointData data(path, bytes, text.offset(), false);
  for (long i = 0; i < count; ++i) {
    const size_t begin = data.at();
    const Eigen::Vector3d p = data.Element(header.fields, &axes);
    CheckPoint(path, begin, p);
    points.Add(p);
  }
  return points.Take(path);
}

}  // namespace halfstep
