#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "wpg/files/point_data.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

PointScalar PlyScalar(const MeshText& text, const MeshWord& word) {
  struct Named {
    std::string_view name, other;
    PointScalar scalar;
  };
  static constexpr std::array<Named, 8> kTypes = {{{"char", "int8", {'I', 1}},
                                                   {"uchar", "uint8", {'U', 1}},
                                                   {"short", "int16", {'I', 2}},
                                                   {"ushort", "uint16", {'U', 2}},
                                                   {"int", "int32", {'I', 4}},
                                                   {"uint", "uint32", {'U', 4}},
                                                   {"float", "float32", {'F', 4}},
                                                   {"double", "float64", {'F', 8}}}};
  for (const Named& type : kTypes) {
    if (word.text == type.name || word.text == type.other) return type.scalar;
  }
  text.Fail(word, Quote(word.text) +
                      " is no type (valid: char, uchar, short, ushort, int, uint, float, double)");
}

// One line of the header, whose first word is `word`.
void ReadPlyLine(const MeshWord& word, MeshText* text, PlyHeader* header) {
  if (word.text == "comment" || word.text == "obj_info") return;
  if (word.text == "format") {
    const MeshWord kind = text->NextInLine(), version = text->NextInLine();
    const std::string& format = header->format = kind.text;
    if ((format != "ascii" && format != "binary_little_endian" && format != "binary_big_endian") ||
        version.text != "1.0") {
      text->Fail(kind,
                 "another format (valid: ascii, binary_little_endian or binary_big_endian, 1.0)");
    }
  } else if (word.text == "element") {
    const MeshWord name = text->NextInLine();
    header->elements.push_back(
        {std::string(name.text), PointCount(*text, text->NextInLine(), 1'000'000'000), {}});
  } else if (word.text == "property" && !header->elements.empty()) {
    std::vector<PointField>& fields = header->elements.back().fields;
    if (fields.size() == kMaxPointFields) text->Fail(word, "too many properties");
    PointField field;
    MeshWord type = text->NextInLine();
    if (type.text == "list") {
      field.list = PlyScalar(*text, text->NextInLine());
      type = text->NextInLine();
    }
    field.scalar = PlyScalar(*text, type);
    field.name = text->NextInLine().text;
    fields.push_back(std::move(field));
  } else {
    text->Fail(word, (word.text.empty() ? "an empty line" : Quote(word.text)) +
                         " (valid: comment, format, element, property, end_header)");
  }
}

// A line with one vertex.
Eigen::Vector3d NextVertex(const std::vector<PointField>& fields, const std::array<size_t, 3>& axes,
                           MeshText* text) {
  Eigen::Vector3d p(0, 0, 0);
  for (size_t f = 0; f < fields.size(); ++f) {
    const auto axis = std::find(axes.begin(), axes.end(), f) - axes.begin();
    const MeshWord number = text->NextInLine();
    if (number.text.empty()) text->Fail(number, "a number is missing");
    if (fields[f].list) break;  // and what is after it in this line
    if (axis < 3) p[axis] = PointNumber(*text, number);
  }
  text->SkipLine();
  return p;
}

// What stands before the vertices, a line each.
void SkipLines(long count, MeshText* text) {
  for (long i = 0; i < count; ++i) {
    if (text->AtEnd()) text->Fail(text->NextInLine(), "the file ends within its data");
    text->SkipLine();
  }
}

}  // namespace

const PlyElement* PlyHeader::Find(std::string_view name) const {
  const auto found = std::find_if(elements.begin(), elements.end(),
                                  [&](const PlyElement& e) { return e.name == name; });
  return found == elements.end() ? nullptr : &*found;
}

PlyHeader ReadPlyHeader(MeshText* text) {
  PlyHeader header;
  const MeshWord first = text->NextInLine();
  if (first.text != "ply") text->Fail(first, "the first line is not `ply`");
  for (;;) {
    text->SkipLine();
    const MeshWord word = text->NextInLine();
    header.end = word;
    if (word.text == "end_header") break;
    if (text->AtEnd()) text->Fail(word, "the file ends within its header (valid: end_header)");
    ReadPlyLine(word, text, &header);
  }
  text->SkipLine();
  if (header.format.empty()) text->Fail(header.end, "the header names no format");
  if (header.Find("vertex") == nullptr) {
    text->Fail(header.end, "the header names no `element vertex`");
  }
  return header;
}

LoadedPoints ReadPly(const std::string& path, std::string_view bytes) {
  MeshText text(path, bytes);
  const PlyHeader header = ReadPlyHeader(&text);
  const PlyElement* const vertices = header.Find("vertex");
  if (vertices->count > kMaxPoints) {
    text.Fail(header.end, "too many points (valid: at most 20 million)");
  }
  const std::array<size_t, 3> axes = PointAxes(text, header.end, vertices->fields);
  PointList points;
  if (header.format == "ascii") {
    for (const PlyElement* element = header.elements.data(); element != vertices; ++element) {
      SkipLines(element->count, &text);
    }
    for (long i = 0; i < vertices->count; ++i) {
      points.Add(NextVertex(vertices->fields, axes, &text));
    }
    return points.Take(path);
  }
  PointData data(path, bytes, text.offset(), header.format == "binary_big_endian");
  for (const PlyElement* element = header.elements.data(); element <= vertices; ++element) {
    for (long i = 0; i < element->count && !element->fields.empty(); ++i) {
      const size_t begin = data.at();
      const Eigen::Vector3d p =
          data.Element(element->fields, element == vertices ? &axes : nullptr);
      if (element != vertices) continue;
      CheckPoint(path, begin, p);
      points.Add(p);
    }
  }
  return points.Take(path);
}

}  // namespace halfstep
