#include "tests/oracle/nasty_draws.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace halfstep::oracle {
namespace {

using Kind = PlainObstacle::Kind;

void AddBox(const Eigen::Vector3d& center, const Eigen::Vector3d& size, bool inwards,
            PlainObstacle* mesh) {
  const int first = static_cast<int>(mesh->vertices.size());
  for (int k = 0; k < 8; ++k) {
    mesh->vertices.push_back(center + Eigen::Vector3d((k & 1 ? 0.5 : -0.5) * size.x(),
                                                      (k & 2 ? 0.5 : -0.5) * size.y(),
                                                      (k & 4 ? 0.5 : -0.5) * size.z()));
  }
  constexpr std::array<std::array<int, 3>, 12> kFaces = {{{0, 2, 1},
                                                          {1, 2, 3},
                                                          {4, 5, 6},
                                                          {5, 7, 6},
                                                          {0, 1, 4},
                                                          {1, 5, 4},
                                                          {2, 6, 3},
                                                          {3, 6, 7},
                                                          {0, 4, 2},
                                                          {2, 4, 6},
                                                          {1, 3, 5},
                                                          {3, 7, 5}}};
  for (auto face : kFaces) {
    if (inwards) std::swap(face[1], face[2]);
    mesh->triangles.push_back({face[0] + first, face[1] + first, face[2] + first});
  }
}

void AddTetrahedron(const std::array<Eigen::Vector3d, 4>& corners, PlainObstacle* mesh) {
  const int n = static_cast<int>(mesh->vertices.size());
  for (const Eigen::Vector3d& corner : corners) mesh->vertices.push_back(corner);
  const Eigen::Vector3d a = corners[1] - corners[0], b = corners[2] - corners[0];
  const bool turn = a.cross(b).dot(corners[3] - corners[0]) > 0;
  for (std::array<int, 3> t : {std::array{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}) {
    if (turn) std::swap(t[1], t[2]);
    mesh->triangles.push_back({t[0] + n, t[1] + n, t[2] + n});
  }
}

// A closed solid about its own origin, of about the size.
void AddSolid(double size, Draw* draw, PlainObstacle* mesh) {
  if (draw->Chance(0.6)) {
    AddBox({0, 0, 0}, size * draw->Vector(0.2, 1), false, mesh);
    return;
  }
  AddTetrahedron(
      {draw->Vector(-size, 0), size * draw->Vector(0, 0.2) + size * Eigen::Vector3d(1, 0, 0),
       size * draw->Vector(0, 0.2) + size * Eigen::Vector3d(0, 1, 0),
       size * draw->Vector(0, 0.2) + size * Eigen::Vector3d(0, 0, 1)},
      mesh);
}

void Spoil(SceneKind kind, Draw* draw, PlainObstacle* mesh) {
  auto& triangles = mesh->triangles;
  const std::vector<std::array<int, 3>> whole = triangles;
  const int corners = static_cast<int>(mesh->vertices.size());
  switch (kind) {
    case SceneKind::kOpenMeshes:
      for (int k = 1 + draw->Below(static_cast<int>(triangles.size()) - 1); k > 0; --k) {
        triangles.erase(triangles.begin() + draw->Below(static_cast<int>(triangles.size())));
      }
      break;
    case SceneKind::kFlippedMeshes: {
      const double share = draw->Chance(0.6) ? 1 : draw->Uniform(0, 1);
      for (auto& t : triangles) {
        if (draw->Chance(share)) std::swap(t[1], t[2]);
      }
      break;
    }
    case SceneKind::kDoubledMeshes: {
      const bool both_ways = draw->Chance(0.5), own_points = draw->Chance(0.5);
      if (own_points) {
        for (int k = 0; k < corners; ++k) {
          mesh->vertices.push_back(Eigen::Vector3d(mesh->vertices[static_cast<size_t>(k)]));
        }
      }
      for (std::array<int, 3> t : whole) {
        if (both_ways) std::swap(t[1], t[2]);
        for (int& v : t) v += own_points ? corners : 0;
        triangles.push_back(t);
      }
      break;
    }
    case SceneKind::kDegenerateMeshes:
      triangles.push_back({0, 0, 1});
      triangles.push_back({2, 2, 2});
      mesh->vertices.push_back(0.5 * (mesh->vertices[0] + mesh->vertices[1]));
      triangles.push_back({0, 1, corners});  // flat
      mesh->vertices.push_back(mesh->vertices[0]);
      triangles.push_back({corners + 1, 1, 2});
      mesh->vertices.push_back(mesh->vertices[0] + draw->Vector(-1e-9, 1e-9));
      triangles.push_back({corners + 2, 1, 2});
      mesh->vertices.push_back(draw->Vector(-3, 3));  // used by none
      break;
    default:
      break;
  }
}

Eigen::Vector3d AnyTurn(Draw* draw) {
  const double roll = draw->Uniform(-180, 180), pitch = draw->Uniform(-80, 80);
  return {roll, pitch, draw->Uniform(-360, 360)};
}

PlainObstacle Round(Kind kind, double radius, double length) {
  return {.name = {}, .kind = kind, .size = {radius, length, 0}, .vertices = {}, .triangles = {}};
}

PlainObstacle MeshAbout(const Eigen::Vector3d& xyz) {
  return {.name = {}, .kind = Kind::kMesh, .vertices = {}, .triangles = {}, .xyz = xyz};
}

// One obstacle at its own origin, by kind.
PlainObstacle Small(SceneKind kind, Draw* draw) {
  PlainObstacle o{.name = {}, .vertices = {}, .triangles = {}};
  const double length = draw->Uniform(0.05, 0.6);
  switch (kind) {
    case SceneKind::kThinPlates: {
      const double thick = draw->Chance(0.5) ? 1e-4 : draw->Logarithmic(1e-5, 1e-3);
      o.size = {thick, length, draw->Uniform(0.02, 0.3)};
      break;
    }
    case SceneKind::kNeedles: {
      const double thick = draw->Logarithmic(1e-4, 1e-3);
      const int which = draw->Below(4);
      if (which == 0) o.size = {thick, thick, length};
      if (which == 1) o = Round(Kind::kCylinder, thick, length);
      if (which == 2) o = Round(Kind::kCapsule, thick, length);
      if (which == 3) {
        o.kind = Kind::kMesh;
        AddTetrahedron(
            {Eigen::Vector3d(0, 0, length), {thick, 0, 0}, {-thick, thick, 0}, {0, -thick, 0}}, &o);
      }
      break;
    }
    case SceneKind::kClouds:
      o = Round(Kind::kPoints, draw->Logarithmic(0.01, 0.05), 0);
      for (int n = 1 + draw->Below(12); n > 0; --n) o.vertices.push_back(draw->Vector(-0.15, 0.15));
      break;
    case SceneKind::kTinySpheres:
      o = Round(Kind::kSphere, draw->Chance(0.5) ? 1e-3 : draw->Logarithmic(1e-5, 3e-3), 0);
      break;
    case SceneKind::kPrimitives: {
      const int which = draw->Below(4);
      if (which == 0) o.size = draw->Vector(0.01, 0.2);
      if (which > 0) {
        constexpr std::array<Kind, 3> kRound = {Kind::kCylinder, Kind::kCapsule, Kind::kSphere};
        o = Round(kRound[static_cast<size_t>(which - 1)], draw->Logarithmic(0.003, 0.1), length);
      }
      break;
    }
    default:
      o.kind = Kind::kMesh;
      AddSolid(draw->Uniform(0.02, 0.25), draw, &o);
      Spoil(kind, draw, &o);
      if (draw->Chance(0.3)) {  // in another unit
        o.scale = draw->Logarithmic(1e-3, 1e3);
        for (Eigen::Vector3d& v : o.vertices) v /= o.scale;
      }
  }
  return o;
}

// Triangles far larger than the robot, a plate's thickness away from where the feet pass.
PlainObstacle Huge(const ClosedFormWalk& walk, double size, Draw* draw) {
  PlainObstacle o = MeshAbout(NearTheWay(walk, size, draw));
  const double edge = draw->Logarithmic(100, 1e5);
  const bool level = draw->Chance(0.3);
  if (level) o.xyz.z() = draw->Chance(0.5) ? -draw->Uniform(0.006, 0.02) : draw->Uniform(1.6, 2);
  if (draw->Chance(0.5)) {  // one triangle, the origin well inside
    o.vertices = {{edge, -0.3 * edge, 0}, {-0.8 * edge, -0.5 * edge, 0}, {0.1 * edge, edge, 0}};
    o.triangles = {{0, 1, 2}};
  } else {  // a corner, an edge far away
    o.vertices = {{0, 0, 0}, {edge, 0.1 * edge, 0}, {edge, -0.2 * edge, 0}};
    o.triangles = {{0, 1, 2}};
  }
  if (!level) o.rpy_deg = {draw->Uniform(60, 120), 0, draw->Uniform(-360, 360)};
  return o;
}

PlainObstacle FarVertices(const ClosedFormWalk& walk, double size, Draw* draw) {
  PlainObstacle o = MeshAbout(NearTheWay(walk, size, draw));
  AddBox({0, 0, 0}, size * Eigen::Vector3d(0.02, draw->Uniform(0.1, 0.5), draw->Uniform(0.05, 0.3)),
         false, &o);
  const double away = draw->Logarithmic(1e3, 1e15);
  const bool in_triangles = draw->Chance(0.5);
  for (int k = 0; k < 5; ++k) {
    const int n = static_cast<int>(o.vertices.size());
    Eigen::Vector3d far = away * draw->Vector(-1, 1);
    far.z() = std::abs(far.z()) + away;
    o.vertices.push_back(far);
    if (in_triangles) {
      o.vertices.push_back(far + Eigen::Vector3d(1, 0, 0));
      o.vertices.push_back(far + Eigen::Vector3d(0, 1, 0));
      o.triangles.push_back({n, n + 1, n + 2});
    }
  }
  if (away > 1e8 || draw->Chance(0.3)) {
    o.scale = draw->Logarithmic(1e2, 1e6);
    for (Eigen::Vector3d& v : o.vertices) v /= o.scale;
  }
  return o;
}

PlainObstacle Nested(const ClosedFormWalk& walk, double size, Draw* draw) {
  Eigen::Vector3d middle = NearTheWay(walk, size, draw);
  middle.z() = 0;
  PlainObstacle o = MeshAbout(middle);
  const int which = draw->Below(5);
  const double room = draw->Uniform(5, 8);
  if (which == 0) {  // solids around the robot, any of them flipped
    for (int k = 1 + draw->Below(3); k > 0; --k) {
      AddBox({0, 0, 0}, Eigen::Vector3d::Constant(room + k), draw->Chance(0.5), &o);
    }
  } else if (which == 1) {  // a shell
    AddBox({0, 0, 0}, Eigen::Vector3d::Constant(room + 0.2), false, &o);
    AddBox({0, 0, 0}, Eigen::Vector3d::Constant(room), true, &o);
  } else {  // small solids in one another
    const Eigen::Vector3d edges = size * draw->Vector(0.05, 0.25);
    for (double share = 1; share > 0.2; share -= draw->Uniform(0.1, 0.5)) {
      AddBox({0, 0, 0}, share * edges, draw->Chance(0.5), &o);
    }
    o.xyz.z() = size * draw->Uniform(0, 0.3);
    o.rpy_deg = AnyTurn(draw);
  }
  return o;
}

}  // namespace

Polygon DrawArea(const ClosedFormWalk& walk, double size, Draw* draw) {
  const Eigen::Vector2d at = NearTheWay(walk, size, draw).head<2>();
  const double across =
      size * (draw->Chance(0.3) ? draw->Uniform(0.002, 0.02) : draw->Uniform(0.02, 0.2));
  const double first = draw->Uniform(0, 6.28);
  const int n = 3 + draw->Below(5);
  std::vector<Eigen::Vector2d> polygon;
  for (int k = 0; k < n; ++k) {
    const double angle = first + 2 * std::numbers::pi * k / n;
    const double r = across * draw->Uniform(0.5, 1);
    polygon.push_back(at + r * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  if (draw->Chance(0.5)) std::reverse(polygon.begin(), polygon.end());
  return polygon;
}

PlainObstacle DrawObstacle(SceneKind kind, const ClosedFormWalk& walk, double size, Draw* draw) {
  constexpr std::array<SceneKind, 5> kThatMove = {SceneKind::kThinPlates, SceneKind::kNeedles,
                                                  SceneKind::kPrimitives, SceneKind::kClosedMeshes,
                                                  SceneKind::kClouds};
  PlainObstacle o = Small(
      kind == SceneKind::kMoving ? kThatMove[static_cast<size_t>(draw->Below(5))] : kind, draw);
  o.size *= size;
  for (Eigen::Vector3d& v : o.vertices) v *= size;
  o.xyz = NearTheWay(walk, size, draw);
  o.rpy_deg = draw->Chance(0.4) ? Eigen::Vector3d(0, 0, draw->Uniform(-180, 180)) : AnyTurn(draw);
  return o;
}

Eigen::Vector3d NearTheWay(const ClosedFormWalk& walk, double size, Draw* draw) {
  const WalkState at = walk.At(Real(draw->Uniform(0, walk.duration())));
  const Eigen::Vector4d& foot = at.value.feet[static_cast<size_t>(draw->Below(2))];
  const double away = size * draw->Uniform(0, 0.3), towards = draw->Uniform(-3.15, 3.15);
  const double z = size * (draw->Chance(0.6) ? draw->Uniform(0, 0.15) : draw->Uniform(0, 0.7));
  const double ground = std::min(at.value.feet[0][2], at.value.feet[1][2]);
  return {foot[0] + away * std::cos(towards), foot[1] + away * std::sin(towards), ground + z};
}

const char* NameOf(SceneKind kind) {
  constexpr std::array<const char*, kNumSceneKinds + kNumLevelKinds> kNames = {
      "thin plates",  "needles",        "tiny spheres",   "primitives", "closed meshes",
      "open meshes",  "flipped meshes", "doubled meshes", "degenerate", "huge meshes",
      "far vertices", "nested solids",  "no-step areas",  "clouds",     "moving obstacles",
      "stairs",       "platforms",      "stones",         "blocks"};
  return kNames[static_cast<size_t>(kind)];
}

PlainScene DrawNastyScene(SceneKind kind, const WalkPlan& plan, double size, Draw* draw) {
  const ClosedFormWalk walk(plan);
  PlainScene scene;
  scene.friction = draw->Uniform(0.3, 1);
  int count = 1 + draw->Below(8);
  if (kind == SceneKind::kTinySpheres) count = 8 + draw->Below(25);
  if (kind == SceneKind::kMoving) count = 1 + draw->Below(4);
  if (kind == SceneKind::kHugeMeshes || kind == SceneKind::kFarVertices) count = 1 + draw->Below(3);
  for (int k = 0; k < count; ++k) {
    if (kind == SceneKind::kNoStep) {
      scene.no_step.push_back(DrawArea(walk, size, draw));
      continue;
    }
    PlainObstacle o;
    if (kind == SceneKind::kHugeMeshes) {
      o = Huge(walk, size, draw);
    } else if (kind == SceneKind::kFarVertices) {
      o = FarVertices(walk, size, draw);
    } else if (kind == SceneKind::kNested) {
      o = Nested(walk, size, draw);
    } else {
      o = DrawObstacle(kind, walk, size, draw);
    }
    if (kind == SceneKind::kMoving) AddMotion(walk, size, draw, &o);
    o.name = "o" + std::to_string(k);
    scene.obstacles.push_back(std::move(o));
  }
  return scene;
}

}  // namespace halfstep::oracle
