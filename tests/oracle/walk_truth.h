#pragma once

#include <array>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "tests/oracle/closed_form_walk.h"
#include "tests/oracle/plain_robot.h"
#include "tests/oracle/plain_scene.h"

namespace halfstep::oracle {

/// A margin that nothing limits.
inline constexpr double kNever = std::numeric_limits<double>::infinity();

/// A number that is known.
inline Bracket Exactly(double value) { return {value, value}; }

/// What is demanded, by the names that margins have in YAML; and limits.
struct Demands {
  std::map<std::string, double> margin;
  double foot_speed = 1, foot_yaw_rate = 2, joint_speed_scale = 1;
};

/// A margin by the oracle. Where a number is only bracketed (distances), `value` is its upper end,
/// `lower` the lower one; elsewhere both are the same.
struct TrueMargin {
  double value = std::numeric_limits<double>::infinity();
  double lower = std::numeric_limits<double>::infinity();
  double t = 0;         ///< [s]
  std::string subject;  ///< "RLEG_LINK4 - o3", "LLEG_JOINT2", …
};

/// All margins of a walk by other means than the project's.
class WalkTruth {
 public:
  /// Borrows all three.
  WalkTruth(const PlainRobot& robot, const ClosedFormWalk& walk, const PlacedScene& scene,
            const std::vector<std::vector<Eigen::Vector2d>>& no_step, const Demands& demands);

  /// The least margin of each family that the sampling met: every 10 ms, and by halves down to
  /// 0.05 ms wherever a margin could fall below what is demanded at a generous rate of change.
  std::map<std::string, TrueMargin> Least();

  /// The least margin of a family at one instant, of the subjects whose name fits (empty: all).
  TrueMargin At(const std::string& family, double t, const std::string& subject);

  long instants() const { return static_cast<long>(instants_.size()); }

 private:
  struct Instant {
    WalkState state;
    Eigen::Isometry3d X_WB;
    std::array<Eigen::Isometry3d, 2> X_WSole;
    std::array<Vector6, 2> q, speed;
    bool reaches = false;
    std::vector<ConvexSet> bodies;  // in W
    std::vector<Eigen::Vector3d> centers;
    std::vector<bool> placed;
    std::array<std::array<Eigen::Isometry3d, 7>, 2> X_BLink;
  };
  // One number that must stay above what its family demands.
  struct Statement {
    std::string family, subject;
    double rate = 0;  // it hardly changes faster [1/s]
    std::function<Bracket(Instant&, const Stretch&)> value;
  };

  Instant& At(double t, const std::array<Vector6, 2>& guess);
  const ConvexSet& BodyAt(Instant& instant, size_t body) const;
  void AddFootStatements();
  void AddGroundStatements();
  void AddLegStatements();
  void AddBodyStatements();
  void AddObstacleStatements();
  double Demanded(const std::string& family) const;
  // Distances beyond this [m] are not told apart.
  double Far(const std::string& family) const;
  void Sample(const Statement& statement, const Stretch& stretch, double a, const Bracket& at_a,
              double b, const Bracket& at_b, TrueMargin* least);

  const PlainRobot& robot_;
  const ClosedFormWalk& walk_;
  const PlacedScene& scene_;
  const std::vector<std::vector<Eigen::Vector2d>>& no_step_;
  Demands demands_;
  std::array<double, 2> longest_;
  std::vector<Eigen::Isometry3d> X_BUpper_;   // links that no leg moves
  std::vector<std::array<int, 2>> leg_link_;  // of each body: leg and place in it, or −1
  std::vector<Statement> statements_;
  std::unordered_map<double, Instant> instants_;
};

}  // namespace halfstep::oracle
