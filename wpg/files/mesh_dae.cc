// COLLADA: what its scene shows, as triangles.
// Source: [Collada14], chapter 5.

#include <tinyxml.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "wpg/files/input_error.h"
#include "wpg/files/mesh_text.h"
#include "wpg/files/text.h"
#include "wpg/files/xml_document.h"
#include "wpg/geometry/rotation.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

using Element = TiXmlElement;

constexpr int kMostNodes = 100'000;  // that are shown, with those that are instanced again

std::string AttributeOf(const Element& element, const char* name) {
  const char* value = element.Attribute(name);
  return value == nullptr ? "" : value;
}

class DaeReader {
 public:
  explicit DaeReader(const std::string& path) : path_(path) {}

  LoadedMesh Read(const Element& collada) {
    if (collada.ValueStr() != "COLLADA") Fail(collada, "the top element must be <COLLADA>");
    Register(collada);
    const Eigen::Affine3d X(Eigen::Scaling(UnitOf(collada)));
    if (const Element* scene = SceneOf(collada)) {
      ShowNode(*scene, X);
    } else {
      for (const auto& [id, geometry] : geometries_) ShowGeometry(*geometry, X);
    }
    LoadedMesh mesh = MeshOf(coordinates_, corners_);
    mesh.R_ZUp = UpOf(collada);
    return mesh;
  }

 private:
  [[noreturn]] void Fail(const Element& at, const std::string& what) const {
    Complaints complaints;
    complaints.Add(path_, at.Row(), at.Column(), at.ValueStr(), what);
    throw InputError(complaints.lines());
  }

  // Elements with an id, of the whole file and of each geometry, in the order of the file.
  void Register(const Element& collada) {
    std::vector<std::pair<const Element*, const Element*>> open = {{&collada, nullptr}};
    while (!open.empty()) {
      auto [element, geometry] = open.back();
      open.pop_back();
      const std::string id = AttributeOf(*element, "id"), &tag = element->ValueStr();
      if (tag == "geometry") geometries_.emplace(id, geometry = element);
      for (const Element* within : {static_cast<const Element*>(nullptr), geometry}) {
        if (id.empty()) break;
        const auto at = by_id_.try_emplace({within, tag, id}, element).first;
        if (at->second != element) at->second = nullptr;  // several have it
      }
      for (auto* e = element->LastChild(); e != nullptr; e = e->PreviousSibling()) {
        if (e->ToElement() != nullptr) open.emplace_back(e->ToElement(), geometry);
      }
    }
  }

  // What an attribute "#id" means: some exporters give the sources of all geometries the same ids.
  const Element& Referred(const Element& from, const char* attribute, const char* tag) const {
    const std::string url = AttributeOf(from, attribute);
    const auto find = [&](const Element* within) {
      return url.starts_with('#') ? by_id_.find({within, tag, url.substr(1)}) : by_id_.end();
    };
    const TiXmlNode* geometry = &from;
    while (geometry != nullptr && geometry->ValueStr() != "geometry") geometry = geometry->Parent();
    auto found = geometry == nullptr ? by_id_.end() : find(geometry->ToElement());
    if (found == by_id_.end()) found = find(nullptr);
    const std::string what = std::string(attribute) + "=" + Quote(url);
    if (found == by_id_.end()) Fail(from, what + " is no <" + tag + "> of this file");
    if (found->second == nullptr) Fail(from, what + " is more than one <" + tag + "> (valid: one)");
    return *found->second;
  }

  template <typename Number>
  std::vector<Number> Numbers(const Element& element) const {
    const char* text = element.GetText();
    std::vector<Number> numbers;
    if (text == nullptr) return numbers;
    const char* const end = text + std::char_traits<char>::length(text);
    for (const char* at = text;;) {
      while (at != end && static_cast<unsigned char>(*at) <= ' ') ++at;
      if (at == end) return numbers;
      Number value{};
      const auto [next, error] = std::from_chars(at, end, value);
      const bool ends = next == end || static_cast<unsigned char>(*next) <= ' ';
      if (error != std::errc() || !ends || !(std::abs(value) <= Number(kMaxMeshCoordinate))) {
        const char* const stop = std::find_if(at, end, [](char c) { return c <= ' '; });
        Fail(element, Quote(std::string(at, std::min<std::ptrdiff_t>(stop - at, 40))) +
                          " is not a finite number of at most 1e9");
      }
      numbers.push_back(value);
      at = next;
    }
  }

  std::vector<double> Exactly(const Element& element, size_t count) const {
    const std::vector<double> numbers = Numbers<double>(element);
    if (numbers.size() == count) return numbers;
    Fail(element, "has " + std::to_string(numbers.size()) +
                      " numbers (valid: " + std::to_string(count) + ")");
  }

  double UnitOf(const Element& collada) const {
    const Element* asset = collada.FirstChildElement("asset");
    const Element* unit = asset == nullptr ? nullptr : asset->FirstChildElement("unit");
    if (unit == nullptr || unit->Attribute("meter") == nullptr) return 1.0;
    double metres = 0.0;
    if (unit->QueryDoubleAttribute("meter", &metres) != TIXML_SUCCESS || !(metres > 0.0) ||
        !(metres <= 1e9)) {
      Fail(*unit, "meter=" + Quote(AttributeOf(*unit, "meter")) + " is no length (valid: > 0)");
    }
    return metres;
  }

  // right, up, in: Z_UP x, z, −y; Y_UP x, y, z; X_UP −y, x, z.
  Eigen::Matrix3d UpOf(const Element& collada) const {
    const Element* asset = collada.FirstChildElement("asset");
    const Element* up = asset == nullptr ? nullptr : asset->FirstChildElement("up_axis");
    const std::string text = up == nullptr || up->GetText() == nullptr ? "Y_UP" : up->GetText();
    Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
    if (text == "Y_UP") R << 1, 0, 0, 0, 0, -1, 0, 1, 0;
    if (text == "X_UP") R << 0, -1, 0, 0, 0, -1, 1, 0, 0;
    return R;
  }

  const Element* SceneOf(const Element& collada) const {
    const Element* scene = collada.FirstChildElement("scene");
    const Element* shown =
        scene == nullptr ? nullptr : scene->FirstChildElement("instance_visual_scene");
    return shown == nullptr ? nullptr : &Referred(*shown, "url", "visual_scene");
  }

  // A node, or the scene: its transforms in their order, then what it holds.
  void ShowNode(const Element& node, Eigen::Affine3d X) {
    if (++nodes_ > kMostNodes) Fail(node, "too many nodes (valid: at most 100,000)");
    if (!open_.insert(&node).second) Fail(node, "shows itself");
    for (auto* e = node.FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
      const std::string& kind = e->ValueStr();
      if (kind == "matrix") {
        const std::vector<double> m = Exactly(*e, 16);
        if (m[12] != 0.0 || m[13] != 0.0 || m[14] != 0.0 || m[15] != 1.0) {
          Fail(*e, "its last row is no 0 0 0 1 (valid: the numbers row by row)");
        }
        X = X * Eigen::Affine3d(
                    Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(m.data()));
      } else if (kind == "translate") {
        const std::vector<double> t = Exactly(*e, 3);
        X.translate(Eigen::Vector3d(t[0], t[1], t[2]));
      } else if (kind == "scale") {
        const std::vector<double> s = Exactly(*e, 3);
        X.scale(Eigen::Vector3d(s[0], s[1], s[2]));
      } else if (kind == "rotate") {
        const std::vector<double> r = Exactly(*e, 4);
        const Eigen::Vector3d axis(r[0], r[1], r[2]);
        if (axis.norm() < 1e-9) Fail(*e, "the axis has no direction");
        X.rotate(AxisRotation(r[3] * std::numbers::pi / 180.0, axis.normalized()));
      } else if (kind == "lookat" || kind == "skew" || kind == "instance_controller") {
        Fail(*e, "is not understood (export the mesh with plain transforms and no bones)");
      }
    }
    for (auto* e = node.FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
      const std::string& kind = e->ValueStr();
      if (kind == "node") ShowNode(*e, X);
      if (kind == "instance_node") ShowNode(Referred(*e, "url", "node"), X);
      if (kind == "instance_geometry") ShowGeometry(Referred(*e, "url", "geometry"), X);
    }
    open_.erase(&node);
  }

  void ShowGeometry(const Element& geometry, const Eigen::Affine3d& X) {
    const Element* mesh = geometry.FirstChildElement("mesh");
    if (mesh == nullptr)
      Fail(geometry, "holds no <mesh> (splines and the like are not understood)");
    const int first = static_cast<int>(coordinates_.size() / 3);
    int count = -1;
    for (auto* e = mesh->FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
      const std::string& kind = e->ValueStr();
      if (kind == "tristrips" || kind == "trifans") {
        Fail(*e, "is not understood (valid: triangles, polylist, polygons)");
      }
      if (kind != "triangles" && kind != "polylist" && kind != "polygons") continue;
      const Element* vertices = nullptr;
      const auto [offset, stride] = VertexInput(*e, &vertices);
      if (count < 0) count = AddVertices(*vertices, X);
      AddPolygons(*e, offset, stride, first, count);
    }
  }

  // Where among the indices of a corner its vertex stands, and how many a corner has.
  std::pair<int, int> VertexInput(const Element& polygons, const Element** vertices) const {
    int offset = 0, stride = 0;
    for (auto* e = polygons.FirstChildElement("input"); e != nullptr;
         e = e->NextSiblingElement("input")) {
      int at = 0;
      if (e->QueryIntAttribute("offset", &at) != TIXML_SUCCESS || at < 0 || at > 1000) {
        Fail(*e, "has no offset (valid: 0 to 1000)");
      }
      stride = std::max(stride, at + 1);
      if (AttributeOf(*e, "semantic") != "VERTEX") continue;
      offset = at;
      *vertices = &Referred(*e, "source", "vertices");
    }
    if (*vertices == nullptr) Fail(polygons, "has no <input> of the semantic VERTEX");
    return {offset, stride};
  }

  int AddVertices(const Element& vertices, const Eigen::Affine3d& X) {
    const Element* source = nullptr;
    for (auto* e = vertices.FirstChildElement("input"); e != nullptr;
         e = e->NextSiblingElement("input")) {
      if (AttributeOf(*e, "semantic") == "POSITION") source = &Referred(*e, "source", "source");
    }
    if (source == nullptr) Fail(vertices, "has no <input> of the semantic POSITION");
    const Element* array = source->FirstChildElement("float_array");
    if (array == nullptr) Fail(*source, "has no <float_array>");
    const std::vector<double> numbers = Numbers<double>(*array);
    size_t stride = 3, first = 0, count = numbers.size() / 3;
    if (const Element* technique = source->FirstChildElement("technique_common")) {
      if (const Element* accessor = technique->FirstChildElement("accessor")) {
        stride = Count(*accessor, "stride", 1);
        first = Count(*accessor, "offset", 0);
        count = Count(*accessor, "count", 0);
      }
    }
    if (stride < 3 || (count > 0 && first + (count - 1) * stride + 3 > numbers.size())) {
      Fail(*array, "has fewer numbers than its accessor reads, or points of fewer than three");
    }
    for (size_t i = 0; i < count; ++i) {
      const double* p = &numbers[first + i * stride];
      const Eigen::Vector3d point = X * Eigen::Vector3d(p[0], p[1], p[2]);
      if (!(point.cwiseAbs().maxCoeff() <= kMaxMeshCoordinate)) {
        Fail(*array, "a point is not within 1e9 once it is placed");
      }
      coordinates_.insert(coordinates_.end(), {point.x(), point.y(), point.z()});
    }
    return static_cast<int>(count);
  }

  size_t Count(const Element& element, const char* attribute, int otherwise) const {
    int value = otherwise;
    const int found = element.QueryIntAttribute(attribute, &value);
    if (found == TIXML_WRONG_TYPE || value < 0) {
      Fail(element,
           std::string(attribute) + "=" + Quote(AttributeOf(element, attribute)) + " is no count");
    }
    return static_cast<size_t>(value);
  }

  void AddPolygons(const Element& polygons, int offset, int stride, int first, int count) {
    const std::string& kind = polygons.ValueStr();
    std::vector<int> corners_of;
    if (kind == "polylist") {
      if (const Element* vcount = polygons.FirstChildElement("vcount")) {
        corners_of = Numbers<int>(*vcount);
      }
    }
    for (auto* p = polygons.FirstChildElement("p"); p != nullptr; p = p->NextSiblingElement("p")) {
      const std::vector<int> indices = Numbers<int>(*p);
      const std::ptrdiff_t corners = std::ssize(indices) / stride;
      const auto corner = [&](std::ptrdiff_t i) {
        const int index = Nth(indices, i * stride + offset);
        if (index >= 0 && index < count) return first + index;
        Fail(*p, Formatted("index %d: there are %d points", index, count));
      };
      if (kind == "triangles") corners_of.assign(static_cast<size_t>(corners) / 3, 3);
      if (kind == "polygons") corners_of.assign(1, static_cast<int>(corners));
      std::ptrdiff_t at = 0;
      for (const int number : corners_of) {
        if (number < 3 || number > corners - at) {
          Fail(*p, "a polygon of fewer than three corners, or of more than are listed");
        }
        for (int i = 2; i < number; ++i) {
          if (std::ssize(corners_) == 3 * kMaxMeshTriangles) {
            Fail(*p, "too many triangles (valid: at most 5 million)");
          }
          corners_.insert(corners_.end(), {corner(at), corner(at + i - 1), corner(at + i)});
        }
        at += number;
      }
      if (at * stride != std::ssize(indices)) Fail(*p, "does not end with a whole polygon");
    }
  }

  const std::string& path_;
  // By the geometry that it is within (nullptr: the file), tag and id; nullptr: several elements.
  std::map<std::tuple<const Element*, std::string, std::string>, const Element*> by_id_;
  std::multimap<std::string, const Element*> geometries_;  // by their ids
  std::set<const Element*> open_;                          // nodes that are being shown
  int nodes_ = 0;
  std::vector<double> coordinates_;
  std::vector<int> corners_;
};

}  // namespace

LoadedMesh ReadDae(const std::string& path, const std::string& text) {
  TiXmlDocument document;
  ParseXml(path, text, &document);
  return DaeReader(path).Read(*document.RootElement());
}

}  // namespace halfstep
