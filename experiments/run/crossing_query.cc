#include "experiments/run/crossing_query.h"

#include <algorithm>

namespace halfstep {

bool CrossingQuery::DownIsFree(int i, Side support, const Foothold& X_WS) const {
  if (volumes_.DownIsFree(i, support, X_WS)) return true;
  return LeadsOver(i, support, X_WS) && proofs_.DownIsFree(i, support, X_WS);
}

bool CrossingQuery::UpIsFree(int i, Side support, const Foothold& X_WS) const {
  if (volumes_.UpIsFree(i, support, X_WS)) return true;
  return LeadsOver(i, support, X_WS) && proofs_.UpIsFree(i, support, X_WS);
}

bool CrossingQuery::LeadsOver(int i, Side support, const Foothold& X_WS) const {
  const Pose2 S = X_WS.Planar(), F = (X_WS * set_.Placement(i, support)).Planar();
  const auto reach = [this](const Pose2& X_W, const Eigen::Vector2d& direction) {
    return direction.dot(X_W.position()) +
           (direction.transpose() * X_W.rotation() * sole_outline_).maxCoeff();
  };
  return std::ranges::any_of(over_, [&](const ObstacleFootprint& print) {
    if (!print.IsBetween(S.position(), F.position())) return false;
    const bool ahead = print.across.dot(S.position()) <= print.near;
    const Pose2 &before = ahead ? S : F, &behind = ahead ? F : S;
    return reach(before, print.across) <= print.near && -reach(behind, -print.across) >= print.far;
  });
}

}  // namespace halfstep
