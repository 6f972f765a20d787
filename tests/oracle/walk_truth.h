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
#include "tests/oracle/plain_dynamics.h"
#include "tests/oracle/plain_robot.h"
#include "tests/oracle/plain_scene.h"
#include "tests/oracle/tube_motions.h"

namespace halfstep::oracle {

/// A margin that nothing limits.
inline constexpr double kNever = std::numeric_limits<double>::infinity();

/// A number that is known.
inline Bracket Exactly(double value) { return {value, value}; }

/// Where a control lets the oracle take soles for level that are not.
enum class ForgetsHeights { kNowhere, kInShadows, kInFriction, kInLoads };

/// What is demanded, by the names that margins have in YAML; and limits.
struct Demands {
  std::map<std::string, double> margin;
  double foot_speed = 1, foot_yaw_rate = 2, joint_speed_scale = 1;
  double landing_speed = 1;  ///< in the last centimetre [m/s]
  double friction = 0.7;     ///< of the scene
  ForgetsHeights forgets = ForgetsHeights::kNowhere;
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

  /// The least margin of each family that the sampling met, or of one alone: every 10 ms, and by
  /// halves down to 0.2 ms wherever a margin could fall below what is demanded at a generous rate
  /// of change: four times the fastest that its stretch shows, and a little, for torques always.
  /// The least is descended from to 10 µs.
  std::map<std::string, TrueMargin> Least(const std::string& only = "");

  /// The least margin of a family at one instant, of the subjects whose name fits (empty: all).
  TrueMargin At(const std::string& family, double t, const std::string& subject);

  /// The least margin of a family that `tries` motions within a tube have where the plan is nearest
  /// to its limit, and as many at any instant; two in three of them go straight towards the limit.
  /// A ZMP that strays does so towards the nearest side, and joints that are faster are so at their
  /// fastest. Motions of the tube have the plan's instants of contact.
  TrueMargin InTube(const std::string& family, const PlainTube& tube, int tries, Draw* draw);

  /// Other demanded margins; limits stay.
  void Demand(const Demands& demands);
  const ClosedFormWalk& walk() const { return walk_; }
  long instants() const { return static_cast<long>(instants_.size()); }
  /// How many statements a family makes at every instant.
  int CountOf(const std::string& family) const;

 private:
  struct Instant {
    double t = 0;  // [s]
    WalkState state;
    Eigen::Isometry3d X_WB;
    std::array<Eigen::Isometry3d, 2> X_WSole;
    std::array<Vector6, 2> q, speed;
    bool reaches = false;
    std::optional<PlainDynamics> dynamics;
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
    bool has_cusps = false;  // its steepest fall may be anywhere between two instants of the grid
  };

  Instant& At(double t, const std::array<Vector6, 2>& guess);
  // A body as the obstacle of time t sees it, seen from where the obstacle is at the start.
  ConvexSet SeenAtStart(size_t obstacle, double t, const ConvexSet& body) const;
  const ConvexSet& BodyAt(Instant& instant, size_t body) const;
  const Eigen::Isometry3d& LinkOf(const Instant& instant, size_t body) const;
  void PlaceBodies(Instant* at) const;
  Instant Displaced(const Instant& plan, const TubePosture& posture) const;
  TrueMargin InPosture(const std::string& family, const std::string& subject,
                       const Stretch& stretch, const PlainTube& tube, Instant& plan,
                       Instant& moved) const;
  void AddFootStatements();
  void AddFootholdStatements();
  void AddGroundStatements();
  void AddLegStatements();
  void AddBodyStatements();
  void AddObstacleStatements();
  void AddSolidStatements();
  void AddDynamicStatements();
  const PlainDynamics& DynamicsOf(Instant& instant) const;
  std::array<Eigen::Vector3d, 2> FloorOn(size_t foot, Instant& at, const Stretch& stretch) const;
  double FrictionNeeded(Instant& at, const Stretch& stretch) const;
  std::vector<Eigen::Vector2d> SeenAlongForce(Instant& at, const Stretch& stretch) const;
  std::vector<Eigen::Vector2d> SupportCorners(const WalkState& state, const Stretch& stretch) const;
  double Demanded(const std::string& family) const;
  void Sample(const Statement& statement, const Stretch& stretch, double rate, double a,
              const Bracket& at_a, double b, const Bracket& at_b, TrueMargin* least);
  void Descend(const Statement& statement, const Stretch& stretch, double width, TrueMargin* least);
  void SampleStretch(const Statement& statement, const Stretch& stretch,
                     const std::vector<Instant*>& grid, TrueMargin* least);

  const PlainRobot& robot_;
  const ClosedFormWalk& walk_;
  const PlacedScene& scene_;
  const std::vector<std::vector<Eigen::Vector2d>>& no_step_;
  Demands demands_;
  std::map<std::string, double> far_;  // distances beyond this [m] are not told apart; by family
  std::array<double, 2> longest_;
  std::vector<Eigen::Isometry3d> X_BUpper_;   // links that no leg moves
  std::vector<std::array<int, 2>> leg_link_;  // of each body: leg and place in it, or −1
  std::vector<Statement> statements_;
  std::unordered_map<double, Instant> instants_;
};

}  // namespace halfstep::oracle
