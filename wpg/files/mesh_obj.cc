#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "wpg/files/mesh_text.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

constexpr std::array<std::string_view, 7> kIgnored{"vt", "vn", "o", "g", "s", "usemtl", "mtllib"};

class ObjReader {
 public:
  ObjReader(const std::string& path, std::string_view content) : text_(path, content) {}

  LoadedMesh Read() {
    for (; !text_.AtEnd(); text_.SkipLine()) {
      const MeshWord word = text_.NextInLine();
      if (word.text.empty() || word.text.starts_with('#')) continue;
      if (word.text == "v") {
        ReadVertex();
      } else if (word.text == "f") {
        ReadFace(word);
      } else if (std::find(kIgnored.begin(), kIgnored.end(), word.text) == kIgnored.end()) {
        text_.Fail(word, "unknown statement " + Quote(word.text) +
                             " (valid: v, f, vt, vn, o, g, s, usemtl, mtllib)");
      }
    }
    return MeshOf(coordinates_, corners_);
  }

 private:
  // Next word of the line; empty at its end or at a comment.
  MeshWord NextWord() {
    MeshWord word = text_.NextInLine();
    if (word.text.starts_with('#')) word.text = {};
    return word;
  }

  // x y z, then nothing, a weight, or three colours, which are not used.
  void ReadVertex() {
    for (int i = 0; i < 3; ++i) coordinates_.push_back(text_.Number(NextWord()));
    int more = 0;
    for (MeshWord word = NextWord(); !word.text.empty(); word = NextWord()) {
      text_.Number(word);
      if (++more > 4) text_.Fail(word, "a vertex of more than three coordinates and a colour");
    }
  }

  void ReadFace(const MeshWord& statement) {
    std::vector<int> polygon;
    for (MeshWord word = NextWord(); !word.text.empty(); word = NextWord()) {
      polygon.push_back(Corner(word));
    }
    if (polygon.size() < 3) text_.Fail(statement, "a face of fewer than three corners");
    for (size_t i = 2; i < polygon.size(); ++i) {
      if (std::ssize(corners_) == 3 * kMaxMeshTriangles) {
        text_.Fail(statement, "too many triangles (valid: at most 5 million)");
      }
      corners_.insert(corners_.end(), {polygon[0], polygon[i - 1], polygon[i]});
    }
  }

  // v, v/vt, v//vn or v/vt/vn; v counts from 1, or from −1 backwards.
  int Corner(const MeshWord& word) const {
    std::array<std::string_view, 3> parts;
    size_t n = 0;
    std::string_view rest = word.text;
    for (;;) {
      const size_t slash = rest.find('/');
      if (n < 3) parts[n] = rest.substr(0, slash);
      ++n;
      if (slash == std::string_view::npos) break;
      rest.remove_prefix(slash + 1);
    }
    const bool middle_left_out = n == 3 && parts[1].empty();
    for (size_t i = 0; i < std::min<size_t>(n, 3); ++i) {
      if (!(i == 1 && middle_left_out)) text_.Integer(word, parts[i]);
    }
    if (n > 3) text_.Integer(word, "");  // complains
    const long count = static_cast<long>(coordinates_.size() / 3);
    const long given = text_.Integer(word, parts[0]);
    const long index = given < 0 ? count + given : given - 1;
    if (index < 0 || index >= count) {
      text_.Fail(word, "no vertex " + std::to_string(given) + ", the file has " +
                           std::to_string(count) + " so far (valid: 1 … " + std::to_string(count) +
                           " or -" + std::to_string(count) + " … -1)");
    }
    return static_cast<int>(index);
  }

  MeshText text_;
  std::vector<double> coordinates_;
  std::vector<int> corners_;
};

}  // namespace

LoadedMesh ReadObj(const std::string& path, std::string_view text) {
  return ObjReader(path, text).Read();
}

}  // namespace halfstep
