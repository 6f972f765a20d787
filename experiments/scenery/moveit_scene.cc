#include <cmath>
#include <utility>

#include "experiments/scenery/scenery_readers.h"
#include "experiments/scenery/scenery_shapes.h"
#include "wpg/files/mesh_text.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

class MoveItReader {
 public:
  MoveItReader(const std::string& path, const std::string& text, const SceneryRequest& request)
      : text_(path, text), request_(request) {}

  Scenery Read() {
    RestOfLine();  // the scene's name
    for (;;) {
      const MeshWord word = text_.Next();
      if (word.text == ".") return std::move(scenery_);
      if (word.text.empty()) text_.Fail(word, "the file ends without the line `.`");
      if (word.text != "*") {
        text_.Fail(word, Quote(word.text) + " (valid: `* NAME` of an object, or `.` at the end)");
      }
      ReadObject(RestOfLine());
    }
  }

 private:
  std::string RestOfLine() {
    MeshWord word = text_.NextInLine();
    const char* const begin = word.text.data();
    const char* end = begin;
    for (; !word.text.empty(); word = text_.NextInLine()) end = word.text.data() + word.text.size();
    text_.SkipLine();
    return {begin, end};
  }

  double Number() { return text_.Number(text_.Next()); }

  double Size() {
    const MeshWord word = text_.Next();
    const double size = text_.Number(word);
    if (!(size >= kLeastSize && size <= kMostSize)) text_.Fail(word, SizeMistake(size));
    return size;
  }

  long Count(const char* of, long most) {
    const MeshWord word = text_.Next();
    const double count = text_.Number(word);
    if (!(count >= 0 && count <= static_cast<double>(most) && count == std::floor(count))) {
      text_.Fail(word, Quote(word.text) + " is no number of " + of + " (valid: 0 … " +
                           std::to_string(most) + ")");
    }
    return static_cast<long>(count);
  }

  Eigen::Isometry3d Pose() {
    Eigen::Vector3d p;
    for (double& x : p) x = Number();
    const MeshWord first = text_.Next();
    Eigen::Vector4d q(text_.Number(first), 0, 0, 0);
    for (int i = 1; i < 4; ++i) q[i] = Number();
    const auto X = PoseOf(p, q);
    if (!X) text_.Fail(first, kNoTurn);
    return *X;
  }

  void ReadObject(const std::string& name) {
    if (!newer_) {  // the form is that of the first object, as MoveIt has it
      MeshText ahead = text_;
      MeshWord word = ahead.Next();
      int words = 0;
      for (; !word.text.empty(); word = ahead.NextInLine()) ++words;
      newer_ = words == 3;
    }
    const Eigen::Isometry3d X_WObject = *newer_ ? Pose() : Eigen::Isometry3d::Identity();
    const long shapes = Count("shapes", static_cast<long>(kMostThings));
    for (long i = 0; i < shapes; ++i) ReadShape(name, X_WObject);
    if (!*newer_) return;
    const long subframes = Count("subframes", 1'000'000);
    text_.SkipLine();
    for (long i = 0; i < subframes; ++i) {
      RestOfLine();
      Pose();
      text_.SkipLine();
    }
  }

  void ReadShape(const std::string& name, const Eigen::Isometry3d& X_WObject) {
    const MeshWord kind = text_.Next();
    SceneryThing thing{.name = name, .shape = {}};
    bool known = true;
    if (kind.text == "box") {
      const double x = Size(), y = Size();
      thing.shape = Box{{x, y, Size()}};
    } else if (kind.text == "sphere") {
      thing.shape = Sphere{Size()};
    } else if (kind.text == "cylinder") {
      const double radius = Size();
      thing.shape = Cylinder{radius, Size()};
    } else if (kind.text == "cone") {
      const double radius = Size();
      thing.shape = ConeMesh(radius, Size());
      scenery_.Tell(kConesTold);
    } else if (kind.text == "plane") {
      Eigen::Vector4d abcd;
      for (double& x : abcd) x = Number();
      if (const auto plane = PlaneOf(abcd)) {
        thing.shape = EndlessPlane{plane->normal};
        thing.X_WO.translation() = plane->point;
      } else {
        text_.Fail(kind, "a plane without a normal");
      }
    } else if (kind.text == "mesh") {
      thing.shape = Mesh();
    } else {
      known = false;
      text_.Fail(kind, Quote(kind.text) +
                           " is no shape (valid: box, sphere, cylinder, cone, plane, mesh)");
    }
    thing.X_WO = X_WObject * Pose() * thing.X_WO;
    for (int i = 0; i < 4; ++i) Number();  // its colour
    if (request_.LeavesOut(name)) {
      scenery_.Tell(name + ": left out by --without");
    } else if (known) {
      if (scenery_.things.size() == kMostThings) text_.Fail(kind, kTooManyThings);
      scenery_.things.push_back(std::move(thing));
    }
  }

  OwnMesh Mesh() {
    const long vertices = Count("vertices", 3L * kMaxMeshTriangles);
    const MeshWord place = text_.Next();
    const double triangles = text_.Number(place);
    if (!(triangles >= 1 && triangles <= kMaxMeshTriangles)) {
      text_.Fail(place, Quote(place.text) + " triangles (valid: 1 … 5 million)");
    }
    std::vector<double> coordinates;  // grows with what is there, not with what is claimed
    for (long i = 0; i < 3 * vertices; ++i) coordinates.push_back(Number());
    std::vector<int> corners;
    for (long i = 0; i < 3 * static_cast<long>(triangles); ++i) {
      const MeshWord word = text_.Next();
      const double corner = text_.Number(word);
      if (!(corner >= 0 && corner < static_cast<double>(vertices)) ||
          corner != std::floor(corner)) {
        text_.Fail(word, Quote(word.text) + " is no vertex (valid: 0 … " +
                             std::to_string(vertices - 1) + ")");
      }
      corners.push_back(static_cast<int>(corner));
    }
    LoadedMesh mesh = MeshOf(coordinates, corners);
    return {std::move(mesh.vertices), std::move(mesh.triangles)};
  }

  MeshText text_;
  const SceneryRequest& request_;
  Scenery scenery_;
  std::optional<bool> newer_;
};

}  // namespace

Scenery ReadMoveItScene(const std::string& path, const std::string& text,
                        const SceneryRequest& request) {
  return MoveItReader(path, text, request).Read();
}

}  // namespace halfstep
