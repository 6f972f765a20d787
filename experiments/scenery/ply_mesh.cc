#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "experiments/scenery/scenery_readers.h"
#include "wpg/files/mesh_text.h"
#include "wpg/files/point_data.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

bool IsCorners(const PointField& field) {
  return field.list && (field.name == "vertex_indices" || field.name == "vertex_index");
}

// Vertices and triangles as they come; polygons are cut from their first corner.
class PlyMesh {
 public:
  PlyMesh(const std::string& path, long vertices) : path_(path), vertices_(vertices) {}

  void AddVertex(const Eigen::Vector3d& p, size_t byte) {
    CheckPoint(path_, byte, p);
    if (p.hasNaN()) RefuseByte(path_, byte, "a vertex is nan");
    coordinates_.insert(coordinates_.end(), {p.x(), p.y(), p.z()});
  }
  // Whether all is well with a polygon; "": yes.
  std::string AddPolygon(const std::vector<double>& corners) {
    if (corners.size() < 3) return "a face of fewer than three corners";
    for (const double c : corners) {
      if (!(c >= 0 && c < static_cast<double>(vertices_)) || c != std::floor(c)) {
        return Formatted("no vertex %g (valid: 0 … %ld)", c, vertices_ - 1);
      }
    }
    for (size_t i = 2; i < corners.size(); ++i) {
      if (std::ssize(corners_) == 3L * kMaxMeshTriangles) {
        return "too many triangles (valid: at most 5 million)";
      }
      for (const size_t k : {size_t{0}, i - 1, i}) corners_.push_back(static_cast<int>(corners[k]));
    }
    return "";
  }
  OwnMesh Take() const {
    LoadedMesh mesh = MeshOf(coordinates_, corners_);
    return {std::move(mesh.vertices), std::move(mesh.triangles)};
  }

 private:
  const std::string& path_;
  long vertices_;
  std::vector<double> coordinates_;
  std::vector<int> corners_;
};

constexpr size_t kMostCorners = 100'000;  // of a face

void ReadTextFaces(const PlyElement& faces, MeshText* text, PlyMesh* mesh) {
  for (long i = 0; i < faces.count; ++i, text->SkipLine()) {
    for (const PointField& field : faces.fields) {
      MeshWord word = text->NextInLine();
      if (!field.list) continue;
      const long length = PointCount(*text, word, static_cast<long>(kMostCorners));
      std::vector<double> corners;
      const MeshWord first = word;
      for (long k = 0; k < length; ++k) {
        word = text->NextInLine();
        corners.push_back(text->Number(word));
      }
      if (!IsCorners(field)) continue;
      const std::string mistake = mesh->AddPolygon(corners);
      if (!mistake.empty()) text->Fail(first, mistake);
    }
    if (text->AtEnd() && i + 1 < faces.count) {
      text->Fail(text->NextInLine(), "the file ends within its data");
    }
  }
}

void ReadBinaryFaces(const std::string& path, const PlyElement& faces, PointData* data,
                     PlyMesh* mesh) {
  for (long i = 0; i < faces.count; ++i) {
    const size_t begin = data->at();
    for (const PointField& field : faces.fields) {
      if (!field.list) {
        data->Skip(field.count, field.scalar.bytes);
        continue;
      }
      const size_t length = data->NextLength(*field.list);
      if (!IsCorners(field)) {
        data->Skip(length, field.scalar.bytes);
        continue;
      }
      if (length > kMostCorners) RefuseByte(path, begin, "a face of too many corners");
      std::vector<double> corners;
      for (size_t k = 0; k < length; ++k) corners.push_back(data->Next(field.scalar));
      const std::string mistake = mesh->AddPolygon(corners);
      if (!mistake.empty()) RefuseByte(path, begin, mistake);
    }
  }
}

}  // namespace

OwnMesh ReadPlyMesh(const std::string& path, const std::string& bytes) {
  MeshText text(path, bytes);
  const PlyHeader header = ReadPlyHeader(&text);
  const PlyElement& vertices = *header.Find("vertex");
  const PlyElement* const faces = header.Find("face");
  const bool has_corners =
      faces != nullptr && std::any_of(faces->fields.begin(), faces->fields.end(), IsCorners);
  if (!has_corners || faces->count == 0 || faces < &vertices) {
    text.Fail(header.end, "no faces after its vertices (valid: `element face` of vertex_indices)");
  }
  if (vertices.count > 3L * kMaxMeshTriangles || faces->count > kMaxMeshTriangles) {
    text.Fail(header.end, "too many vertices or faces (valid: at most 15 and 5 million)");
  }
  const std::array<size_t, 3> axes = PointAxes(text, header.end, vertices.fields);
  PlyMesh mesh(path, vertices.count);
  if (header.format == "ascii") {
    for (const PlyElement* element = header.elements.data(); element <= faces; ++element) {
      if (element == faces) {
        ReadTextFaces(*faces, &text, &mesh);
        continue;
      }
      for (long i = 0; i < element->count; ++i, text.SkipLine()) {
        if (text.AtEnd()) text.Fail(text.NextInLine(), "the file ends within its data");
        if (element != &vertices) continue;
        Eigen::Vector3d p(0, 0, 0);
        for (size_t f = 0; f < element->fields.size() && !element->fields[f].list; ++f) {
          const MeshWord word = text.NextInLine();
          const auto axis = std::find(axes.begin(), axes.end(), f) - axes.begin();
          if (axis < 3) p[axis] = text.Number(word);
        }
        mesh.AddVertex(p, text.offset());
      }
    }
    return mesh.Take();
  }
  PointData data(path, bytes, text.offset(), header.format == "binary_big_endian");
  for (const PlyElement* element = header.elements.data(); element <= faces; ++element) {
    if (element == faces) {
      ReadBinaryFaces(path, *faces, &data, &mesh);
      continue;
    }
    for (long i = 0; i < element->count && !element->fields.empty(); ++i) {
      const size_t begin = data.at();
      const Eigen::Vector3d p =
          data.Element(element->fields, element == &vertices ? &axes : nullptr);
      if (element == &vertices) mesh.AddVertex(p, begin);
    }
  }
  return mesh.Take();
}

}  // namespace halfstep
