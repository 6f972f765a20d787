#include <array>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <unordered_map>
#include <vector>

#include "wpg/files/input_error.h"
#include "wpg/files/mesh_text.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

// Gathers triangles given by coordinates; equal vertices become one.
class Merger {
 public:
  void AddCorner(const Eigen::Vector3d& p) {
    const Eigen::Vector3d key = p.array() + 0.0;  // no negative zero
    const auto [place, fresh] = index_.try_emplace({key.x(), key.y(), key.z()}, size());
    if (fresh) vertices_.push_back(key);
    corners_.push_back(place->second);
  }
  size_t num_triangles() const { return corners_.size() / 3; }
  LoadedMesh Take() const {
    LoadedMesh mesh;
    mesh.vertices.resize(3, static_cast<Eigen::Index>(vertices_.size()));
    for (size_t i = 0; i < vertices_.size(); ++i) {
      mesh.vertices.col(static_cast<Eigen::Index>(i)) = vertices_[i];
    }
    mesh.triangles = Eigen::Map<const Eigen::Matrix3Xi>(
        corners_.data(), 3, static_cast<Eigen::Index>(corners_.size() / 3));
    return mesh;
  }

 private:
  using Key = std::array<double, 3>;
  struct Hash {
    size_t operator()(const Key& key) const {
      std::uint64_t hash = 1469598103934665603u;
      for (const double x : key) {
        hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * 1099511628211u;
        hash ^= hash >> 29;
      }
      return static_cast<size_t>(hash);
    }
  };
  int size() const { return static_cast<int>(vertices_.size()); }

  std::unordered_map<Key, int, Hash> index_;
  std::vector<Eigen::Vector3d> vertices_;
  std::vector<int> corners_;
};

bool Is(const MeshWord& word, std::string_view keyword) {
  if (word.text.size() != keyword.size()) return false;
  for (size_t i = 0; i < keyword.size(); ++i) {
    if (std::tolower(static_cast<unsigned char>(word.text[i])) != keyword[i]) return false;
  }
  return true;
}

void Expect(MeshText* text, std::string_view keyword) {
  const MeshWord word = text->Next();
  if (Is(word, keyword)) return;
  const std::string found = word.text.empty() ? "the file ends here" : Quote(word.text);
  text->Fail(word, found + " (valid: " + std::string(keyword) + ")");
}

template <typename T>
T LittleEndian(const char* bytes) {
  static_assert(std::endian::native == std::endian::little);
  T value;
  std::memcpy(&value, bytes, sizeof(value));
  return value;
}

}  // namespace

LoadedMesh ReadAsciiStl(const std::string& path, std::string_view content) {
  MeshText text(path, content);
  Merger merger;
  Expect(&text, "solid");
  text.SkipLine();  // the rest is its name
  for (;;) {
    const MeshWord word = text.Next();
    if (Is(word, "endsolid")) {
      text.SkipLine();
      const MeshWord next = text.Next();
      if (next.text.empty()) return merger.Take();
      if (!Is(next, "solid")) text.Fail(next, Quote(next.text) + " after endsolid (valid: solid)");
      text.SkipLine();
      continue;
    }
    if (!Is(word, "facet")) {
      const std::string found = word.text.empty() ? "the file ends here" : Quote(word.text);
      text.Fail(word, found + " (valid: facet, endsolid)");
    }
    if (merger.num_triangles() == kMaxMeshTriangles) {
      text.Fail(word, "too many triangles (valid: at most 5 million)");
    }
    Expect(&text, "normal");
    for (int i = 0; i < 3; ++i) {
      // Not used, and writers put nan there for thin triangles.
      if (text.NextInLine().text.empty()) text.Fail(word, "a normal of fewer than three numbers");
    }
    Expect(&text, "outer");
    Expect(&text, "loop");
    for (int corner = 0; corner < 3; ++corner) {
      Expect(&text, "vertex");
      const double x = text.Number(text.NextInLine()), y = text.Number(text.NextInLine());
      const double z = text.Number(text.NextInLine());
      merger.AddCorner({x, y, z});
    }
    Expect(&text, "endloop");
    Expect(&text, "endfacet");
  }
}

// 80 bytes of header, the number of triangles, then for each a normal and three corners as
// little-endian floats and two bytes of attributes.
LoadedMesh ReadBinaryStl(const std::string& path, std::string_view bytes) {
  constexpr size_t kCount = 80, kStart = 84, kTriangle = 50;
  if (bytes.size() < kStart) {
    RefuseByte(path, bytes.size(), "the file ends within the header of 84 bytes of a binary STL");
  }
  const size_t count = LittleEndian<std::uint32_t>(bytes.data() + kCount);
  if (count > kMaxMeshTriangles) {
    RefuseByte(path, kCount, std::to_string(count) + " triangles (valid: at most 5 million)");
  }
  const size_t expected = kStart + count * kTriangle;
  if (bytes.size() != expected) {
    RefuseByte(path, std::min(bytes.size(), expected),
               std::to_string(count) + " triangles take " + std::to_string(expected) +
                   " bytes, the file has " + std::to_string(bytes.size()));
  }
  Merger merger;
  for (size_t i = 0; i < count; ++i) {
    for (size_t corner = 0; corner < 3; ++corner) {
      const size_t at = kStart + i * kTriangle + 12 * (corner + 1);
      Eigen::Vector3d p;
      for (int axis = 0; axis < 3; ++axis) {
        p[axis] = LittleEndian<float>(bytes.data() + at + 4 * static_cast<size_t>(axis));
      }
      if (!(p.cwiseAbs().maxCoeff() <= kMaxMeshCoordinate) || !p.allFinite()) {
        RefuseByte(path, at,
                   "a coordinate of triangle " + std::to_string(i) +
                       " is not finite or too large (valid: -1e9 … 1e9)");
      }
      merger.AddCorner(p);
    }
  }
  return merger.Take();
}

}  // namespace halfstep
