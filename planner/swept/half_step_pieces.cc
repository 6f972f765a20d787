#include "planner/swept/half_step_pieces.h"

#include <algorithm>
#include <utility>

#include "wpg/motion/posture.h"

namespace halfstep {
namespace {

constexpr double kEnclosureRounding = 1e-9;  // of the cylinder around bodies [m]

}  // namespace

const HalfStepPieces::Piece& HalfStepPieces::Of(int n, std::int64_t* made) {
  const auto [at, is_new] = pieces_.try_emplace(n);
  if (is_new) {
    ++*made;
    at->second = Make(n);
    if (at->second.bounded) at->second.around.emplace(Around(at->second));
  }
  return at->second;
}

HalfStepPieces::Piece HalfStepPieces::Make(int n) const {
  Piece piece;
  int count = 1;  // of the pieces that are as long
  while (2 * count <= n) count *= 2;
  const double width = lasts() / count;
  const double begin = from_ + width * (n - count);
  piece.mid = begin + 0.5 * width;
  piece.half = 0.5 * width * (1.0 + 1e-9);  // for the rounding of its ends
  if (width == 0.0) {
    const Posture posture = SolvePosture(robot_, tracks_.At(piece.mid).value);
    piece.bounded = posture.reachable;
    for (const RobotBody& body : robot_.bodies) piece.X_SBody.push_back(posture.OfBody(body));
    piece.displacement.assign(robot_.bodies.size(), 0.0);
    return piece;
  }
  WalkState second = WalkState::Zero();
  tracks_.AddSecondBounds(begin, begin + width, &second);
  IntervalMotion motion;
  bounds_.Bound(tracks_.At(piece.mid), second, piece.half, &motion);
  piece.bounded = motion.bounded;
  if (!piece.bounded) return piece;
  for (const RobotBody& body : robot_.bodies) {
    piece.X_SBody.push_back(motion.posture.OfBody(body));
  }
  piece.displacement = std::move(motion.displacement);
  return piece;
}

CollisionShape HalfStepPieces::Around(const Piece& piece) const {
  Eigen::AlignedBox3d box;
  for (size_t body = 0; body < shapes_.size(); ++body) {
    const Eigen::Vector3d center = piece.X_SBody[body] * shapes_[body].center();
    const double radius = shapes_[body].radius() + piece.displacement[body] + kEnclosureRounding;
    box.extend(Eigen::AlignedBox3d(center.array() - radius, center.array() + radius));
  }
  const Eigen::Vector3d middle = box.center();
  ConvexBody around;
  for (size_t body = 0; body < shapes_.size(); ++body) {
    const Eigen::Vector3d center = piece.X_SBody[body] * shapes_[body].center();
    const double radius = shapes_[body].radius() + piece.displacement[body] + kEnclosureRounding;
    around.disc_radius = std::max(around.disc_radius, (center - middle).head<2>().norm() + radius);
  }
  around.vertices.resize(3, 2);
  around.vertices << middle.x(), middle.x(), middle.y(), middle.y(), box.min().z(), box.max().z();
  BoundBySphere(&around);
  return CollisionShape(std::move(around));
}

}  // namespace halfstep
