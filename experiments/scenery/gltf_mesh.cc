// glTF 2.0: the triangles that its scene shows. Source: [Gltf2].

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "experiments/scenery/scenery_readers.h"
#include "experiments/scenery/scenery_shapes.h"
#include "wpg/files/input_error.h"
#include "wpg/files/mesh_text.h"
#include "wpg/files/nesting.h"
#include "wpg/files/regular_file.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

using nlohmann::json;

constexpr int kMostGltfNodes = 100'000;
constexpr double kMostIndex = 1e9;

std::uint32_t Word(const std::string& bytes, size_t at) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + at, sizeof(word));
  return word;
}

class GltfReader {
 public:
  GltfReader(const std::string& path, std::vector<std::string>* told) : path_(path), told_(told) {}

  OwnMesh Read(const std::string& bytes) {
    Open(bytes);
    for (const json& used : List("extensionsRequired")) {
      Refuse("needs the extension " + (used.is_string() ? Quote(used.get<std::string>()) : "?") +
             ", which is not understood (export it without compression)");
    }
    if (!List("animations").empty()) Tell("animations are left out: everything is as it begins");
    if (!List("skins").empty()) Tell("skins are left out: meshes are as they were modelled");
    const std::vector<json>& scenes = List("scenes");
    if (scenes.empty()) {
      for (size_t i = 0; i < List("meshes").size(); ++i) ShowMesh(i, Eigen::Affine3d::Identity());
    } else {
      const json& scene = Item("scenes", root_.value("scene", json(0u)));
      for (const json& node : ListOf(scene, "nodes")) ShowNode(node, Eigen::Affine3d::Identity());
    }
    if (corners_.empty()) Refuse("shows no triangle");
    LoadedMesh mesh = MeshOf(coordinates_, corners_);
    // x stays, y is up.
    const Eigen::Matrix3Xd turned =
        (Eigen::Matrix3d() << 1, 0, 0, 0, 0, -1, 0, 1, 0).finished() * mesh.vertices;
    return {turned, std::move(mesh.triangles)};
  }

 private:
  [[noreturn]] void Refuse(const std::string& what) const {
    throw InputError({path_ + ": " + what});
  }
  void Tell(const std::string& what) {
    if (said_.insert(what).second) told_->push_back(what);
  }

  void Open(const std::string& bytes) {
    std::string text = bytes;
    if (bytes.starts_with("glTF")) {
      if (bytes.size() < 20) RefuseByte(path_, bytes.size(), "the file ends within its header");
      if (Word(bytes, 4) != 2) RefuseByte(path_, 4, "another version (valid: 2)");
      if (Word(bytes, 8) != bytes.size()) {
        RefuseByte(
            path_, 8,
            Formatted("it says that it has %u bytes, and has %zu", Word(bytes, 8), bytes.size()));
      }
      size_t at = 12;
      for (int chunk = 0; at < bytes.size(); ++chunk) {
        if (bytes.size() - at < 8 || Word(bytes, at) > bytes.size() - at - 8) {
          RefuseByte(path_, at, "a chunk that is longer than the file");
        }
        const std::uint32_t length = Word(bytes, at), kind = Word(bytes, at + 4);
        if (chunk == 0 && kind != 0x4E4F534A) RefuseByte(path_, at, "the first chunk is no JSON");
        if (chunk == 0) text = bytes.substr(at + 8, length);
        if (chunk == 1 && kind == 0x004E4942) binary_ = bytes.substr(at + 8, length);
        at += 8 + std::size_t{length};
      }
    }
    if (JsonDepth(text) > kMostJsonLevels) Refuse("nests too deeply (valid: at most 64 levels)");
    if (text.size() > (std::size_t{64} << 20)) Refuse("its JSON is too long (valid: 64 MiB)");
    root_ = json::parse(text, nullptr, /*allow_exceptions=*/false);
    if (!root_.is_object()) Refuse("is no JSON object");
  }

  static const std::vector<json>& ListOf(const json& object, const char* key) {
    static const std::vector<json> kNone;
    const auto found = object.is_object() ? object.find(key) : object.end();
    return found == object.end() || !found->is_array() ? kNone
                                                       : found->get_ref<const json::array_t&>();
  }
  const std::vector<json>& List(const char* key) const { return ListOf(root_, key); }

  size_t Whole(const json& value, const std::string& what) const {
    if (!value.is_number_unsigned()) Refuse(what + " is no whole number");
    const auto whole = value.get<std::uint64_t>();
    if (static_cast<double>(whole) > kMostIndex)
      Refuse(what + " is too large (valid: at most 1e9)");
    return static_cast<size_t>(whole);
  }
  size_t WholeOf(const json& object, const char* key, std::optional<size_t> otherwise) const {
    const auto found = object.is_object() ? object.find(key) : object.end();
    if (!object.is_object() || found == object.end()) {
      if (otherwise) return *otherwise;
      Refuse(std::string(key) + " is missing");
    }
    return Whole(*found, key);
  }
  const json& Item(const char* list, const json& index) const {
    const size_t i = Whole(index, list);
    if (i >= List(list).size() || !List(list)[i].is_object()) {
      Refuse(std::string(list) + " has no item " + std::to_string(i));
    }
    return List(list)[i];
  }

  std::vector<double> Numbers(const json& node, const char* key, size_t count) const {
    const std::vector<json>& list = ListOf(node, key);
    std::vector<double> numbers;
    for (const json& value : list) {
      const double number = value.is_number() ? value.get<double>() : std::nan("");
      if (!(std::abs(number) <= kMaxMeshCoordinate)) {
        Refuse(std::string(key) + " of a node has no finite number of at most 1e9");
      }
      numbers.push_back(number);
    }
    if (!numbers.empty() && numbers.size() != count) {
      Refuse(std::string(key) + " of a node has " + std::to_string(numbers.size()) +
             " numbers (valid: " + std::to_string(count) + ")");
    }
    return numbers;
  }

  Eigen::Affine3d PoseOfNode(const json& node) const {
    Eigen::Affine3d X = Eigen::Affine3d::Identity();
    if (const auto m = Numbers(node, "matrix", 16); !m.empty()) {
      X.matrix() = Eigen::Map<const Eigen::Matrix4d>(m.data());  // column by column
      X.makeAffine();
    }
    if (const auto t = Numbers(node, "translation", 3); !t.empty()) {
      X.translate(Eigen::Vector3d(t[0], t[1], t[2]));
    }
    if (const auto r = Numbers(node, "rotation", 4); !r.empty()) {
      const auto turn = PoseOf({0, 0, 0}, {r[0], r[1], r[2], r[3]});
      if (!turn) Refuse("rotation of a node: " + std::string(kNoTurn));
      X.rotate(turn->linear());
    }
    if (const auto s = Numbers(node, "scale", 3); !s.empty()) {
      X.scale(Eigen::Vector3d(s[0], s[1], s[2]));
    }
    return X;
  }

  void ShowNode(const json& index, const Eigen::Affine3d& X_WParent) {
    const json& node = Item("nodes", index);
    if (++nodes_ > kMostGltfNodes) Refuse("too many nodes (valid: at most 100,000)");
    if (open_.size() >= 256 || !open_.insert(&node).second) {
      Refuse("its nodes are a circle, or more than 256 deep");
    }
    const Eigen::Affine3d X = X_WParent * PoseOfNode(node);
    if (node.contains("mesh")) ShowMesh(Whole(node["mesh"], "mesh"), X);
    for (const json& child : ListOf(node, "children")) ShowNode(child, X);
    open_.erase(&node);
  }

  void ShowMesh(size_t index, const Eigen::Affine3d& X) {
    for (const json& primitive : ListOf(Item("meshes", json(index)), "primitives")) {
      const size_t mode = WholeOf(primitive, "mode", 4);
      if (mode < 4) {
        Tell("points and lines are left out");
        continue;
      }
      if (mode > 6) Refuse("a primitive of mode " + std::to_string(mode) + " (valid: 0 … 6)");
      if (primitive.contains("targets")) Tell("morph targets are left out");
      const auto attributes = primitive.find("attributes");
      if (attributes == primitive.end() || !attributes->contains("POSITION")) {
        Tell("a primitive without POSITION is left out");
        continue;
      }
      const std::vector<double> points = Accessor((*attributes)["POSITION"], "VEC3", 3);
      std::vector<double> indices;
      if (primitive.contains("indices")) {
        indices = Accessor(primitive["indices"], "SCALAR", 1);
      } else {
        for (size_t i = 0; i < points.size() / 3; ++i) indices.push_back(static_cast<double>(i));
      }
      const int first = static_cast<int>(coordinates_.size() / 3);
      if (coordinates_.size() + points.size() > 9ul * kMaxMeshTriangles) {
        Refuse("too many vertices (valid: at most 15 million)");
      }
      for (size_t i = 0; i + 2 < points.size(); i += 3) {
        const Eigen::Vector3d p = X * Eigen::Vector3d(points[i], points[i + 1], points[i + 2]);
        if (!(p.cwiseAbs().maxCoeff() <= kMaxMeshCoordinate)) {
          Refuse("a vertex is not within 1e9 once it is placed");
        }
        coordinates_.insert(coordinates_.end(), {p.x(), p.y(), p.z()});
      }
      const size_t step = mode == 4 ? 3 : 1;
      for (size_t i = 0; i + 2 < indices.size(); i += step) {
        const bool turned = mode == 5 && i % 2 == 1;
        const size_t of[3] = {mode == 6 ? 0 : i, turned ? i + 2 : i + 1, turned ? i + 1 : i + 2};
        if (corners_.size() == 3ul * kMaxMeshTriangles) {
          Refuse("too many triangles (valid: at most 5 million)");
        }
        for (const size_t k : of) {
          if (!(indices[k] < static_cast<double>(points.size() / 3))) {
            Refuse(Formatted("index %g: there are %zu vertices", indices[k], points.size() / 3));
          }
          corners_.push_back(first + static_cast<int>(indices[k]));
        }
      }
    }
  }

  // The numbers of an accessor, `width` each.
  std::vector<double> Accessor(const json& index, const char* type, size_t width) {
    const json& accessor = Item("accessors", index);
    if (accessor.contains("sparse")) Refuse("a sparse accessor is not understood");
    if (accessor.value("type", json()) != type) {
      Refuse(std::string("an accessor is no ") + type);
    }
    const size_t kind = WholeOf(accessor, "componentType", std::nullopt);
    const size_t each = kind == 5121 ? 1 : kind == 5123 ? 2 : kind == 5125 || kind == 5126 ? 4 : 0;
    if (each == 0 || (width == 3) != (kind == 5126)) {
      Refuse("a component type of " + std::to_string(kind) +
             " (valid: 5126 of positions; 5121, 5123, 5125 of indices)");
    }
    const size_t count = WholeOf(accessor, "count", std::nullopt);
    const json& view =
        Item("bufferViews", accessor.value("bufferView", json(List("bufferViews").size())));
    const std::string& buffer = Buffer(WholeOf(view, "buffer", std::nullopt));
    const size_t stride = WholeOf(view, "byteStride", width * each);
    const size_t length = WholeOf(view, "byteLength", std::nullopt);
    const size_t view_at = WholeOf(view, "byteOffset", 0);
    const size_t offset = WholeOf(accessor, "byteOffset", 0);
    // All of these are at most 1e9, so that sums and products of two do not overflow.
    if (stride < width * each || view_at + length > buffer.size() ||
        (count > 0 && offset + (count - 1) * stride + width * each > length)) {
      Refuse(Formatted("an accessor of %zu items reaches beyond its buffer of %zu bytes", count,
                       buffer.size()));
    }
    std::vector<double> numbers;
    numbers.reserve(count * width);
    for (size_t i = 0; i < count; ++i) {
      const char* at = buffer.data() + view_at + offset + i * stride;
      for (size_t k = 0; k < width; ++k, at += each) numbers.push_back(NumberAt(at, kind));
    }
    return numbers;
  }

  double NumberAt(const char* at, size_t kind) const {
    const auto as = [at](auto value) {
      std::memcpy(&value, at, sizeof(value));
      return static_cast<double>(value);
    };
    if (kind == 5121) return as(std::uint8_t{});
    if (kind == 5123) return as(std::uint16_t{});
    if (kind == 5125) return as(std::uint32_t{});
    const double value = as(float{});
    if (!(std::abs(value) <= kMaxMeshCoordinate))
      Refuse("a coordinate is not finite, or beyond 1e9");
    return value;
  }

  const std::string& Buffer(size_t index) {
    const json& buffer = Item("buffers", json(index));
    if (!buffer.contains("uri")) {
      if (index != 0) Refuse("a buffer without uri");
      return binary_;
    }
    if (buffers_.size() <= index) buffers_.resize(List("buffers").size());
    std::string& bytes = buffers_[index];
    if (!bytes.empty() || !buffer["uri"].is_string()) return bytes;
    const std::string uri = buffer["uri"].get<std::string>();
    const size_t comma = uri.find(";base64,");
    if (uri.starts_with("data:") && comma != std::string::npos) {
      bytes = FromBase64(std::string_view(uri).substr(comma + 8));
    } else if (uri.find(':') != std::string::npos || uri.starts_with('/')) {
      Refuse("buffer " + Quote(uri) + " is no file beside it");
    } else {
      bytes = ReadRegularFile((std::filesystem::path(path_).parent_path() / uri).string(),
                              kMaxMeshBytes);
    }
    return bytes;
  }

  std::string FromBase64(std::string_view text) const {
    std::string bytes;
    std::uint32_t held = 0;
    int bits = 0;
    for (const char c : text) {
      if (c == '=') break;
      const int value = c >= 'A' && c <= 'Z'   ? c - 'A'
                        : c >= 'a' && c <= 'z' ? c - 'a' + 26
                        : c >= '0' && c <= '9' ? c - '0' + 52
                        : c == '+'             ? 62
                        : c == '/'             ? 63
                                               : -1;
      if (value < 0) Refuse("a buffer is no base64");
      held = held << 6 | static_cast<std::uint32_t>(value);
      bits += 6;
      if (bits >= 8) {
        bits -= 8;
        bytes += static_cast<char>(held >> bits & 0xFF);
      }
    }
    return bytes;
  }

  const std::string& path_;
  std::vector<std::string>* const told_;
  std::set<std::string> said_;
  json root_;
  std::string binary_;
  std::vector<std::string> buffers_;
  std::set<const json*> open_;  // nodes that are being shown
  int nodes_ = 0;
  std::vector<double> coordinates_;
  std::vector<int> corners_;
};

}  // namespace

OwnMesh ReadGltfMesh(const std::string& path, const std::string& bytes,
                     std::vector<std::string>* told) {
  return GltfReader(path, told).Read(bytes);
}

}  // namespace halfstep
