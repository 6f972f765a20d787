#include "experiments/run/crossing_query.h"

#include <algorithm>
#include <limits>

namespace halfstep {
namespace {

// What soles cover along a direction [m].
struct Interval {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void Extend(const Interval& other) {
    low = std::min(low, other.low);
    high = std::max(high, other.high);
  }
  bool Meets(double from, double to) const { return low < to && from < high; }
};

Interval CoverOf(const Pose2& X_WF, const Eigen::Matrix2Xd& sole, const Eigen::Vector2d& along) {
  const Eigen::RowVectorXd reach = (along.transpose() * X_WF.rotation()) * sole;
  const double middle = along.dot(X_WF.position());
  return {middle + reach.minCoeff(), middle + reach.maxCoeff()};
}

}  // namespace

bool CrossingQuery::DownIsFree(int i, Side support, const Foothold& X_WS) const {
  if (volumes_.DownIsFree(i, support, X_WS)) return true;
  const Foothold X_WF = X_WS * set_.Placement(i, support);
  return LeadsOver(support, X_WS.Planar(), X_WF.Planar()) && proofs_.DownIsFree(i, support, X_WS);
}

bool CrossingQuery::UpIsFree(int i, Side support, const Foothold& X_WS) const {
  if (volumes_.UpIsFree(i, support, X_WS)) return true;
  const Foothold X_WF = X_WS * set_.Placement(i, support);
  return LeadsOver(Opposite(support), X_WF.Planar(), X_WS.Planar()) &&
         proofs_.UpIsFree(i, support, X_WS);
}

bool CrossingQuery::LeadsOver(Side support, const Pose2& X_WS, const Pose2& X_WF) const {
  HalfStep half_step = set_.prototype;
  half_step.support = support;
  const Pose2 X_WV = X_WS * half_step.via();
  return std::ranges::any_of(over_.obstacles, [&](const ObstacleFootprint& print) {
    Interval across;
    for (const Pose2& X_W : {X_WS, X_WF}) {
      const Interval sole = CoverOf(X_W, sole_outline_, print.across);
      if (sole.Meets(print.near, print.far)) return false;  // it stands there
      across.Extend(sole);
    }
    across.Extend(CoverOf(X_WV, sole_outline_, print.across));
    if (!across.Meets(print.near - over_.near, print.far + over_.near)) return false;
    Interval along;
    for (const Pose2& X_W : {X_WS, X_WF, X_WV}) {
      along.Extend(CoverOf(X_W, sole_outline_, print.along));
    }
    return along.Meets(print.left, print.right);
  });
}

}  // namespace halfstep
