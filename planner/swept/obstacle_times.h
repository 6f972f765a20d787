#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "planner/collision/collision_world.h"
#include "planner/scene/scene.h"
#include "planner/search/half_step_query.h"
#include "planner/search/half_step_times.h"
#include "planner/search/step_set.h"
#include "wpg/motion/half_step_tracks.h"
#include "wpg/motion/motion_bounds.h"
#include "wpg/motion/motion_model.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// When a robot's half-steps keep clear of the obstacles of a scene that move. An interval of start
/// times is told only when a bound holds for all of it: each body is where it is in the middle of a
/// piece of the half-step, or no farther from there than its motion allows; each obstacle is where
/// it is in the middle of the times that are meant, or no farther than its speed allows. A cylinder
/// around all bodies is asked first. Where that does not decide, both are halved, down to 1/32 of T
/// (less where the motion has no bound) and 1/16 s; what is undecided then is told as not free.
/// Source: planner/README.md, "Planning in time".
class ObstacleTimes : public HalfStepTimes {
 public:
  /// `robot`, `set` and `always` are borrowed and must outlive this. Bodies keep `clearance` ≥ 0
  /// [m] from each obstacle of the scene that moves, less its uncertainty; what rests does not
  /// count. What `always` calls free is free of them at all times; null: nothing is known. An
  /// obstacle that is still on its way after `latest` [s] keeps half-steps from being free later.
  ObstacleTimes(const RobotModel& robot, std::shared_ptr<const MotionModel> model,
                const StepSet& set, const Scene& scene, double clearance,
                const HalfStepQuery* always = nullptr, double latest = 600.0);

  TimeIntervals DownStarts(int i, Side support, const Foothold& X_WS,
                           const Foothold& X_WF) const override;
  TimeIntervals UpStarts(int i, Side support, const Foothold& X_WS,
                         const Foothold& X_WF) const override;
  TimeIntervals OnBothFeet(int i, Side support, const Foothold& X_WS,
                           const Foothold& X_WF) const override;
  TimeIntervals OnOneFoot(Side support, const Foothold& X_WS) const override;
  double settled() const override { return settled_; }
  double effort() const override;

 private:
  // What is asked: a half-step, or the rest before it or after it.
  enum class What { kDown, kUp, kBothFeet, kOneFoot };
  // The bodies over a piece of a half-step, seen from its support sole.
  struct Piece {
    double mid = 0.0, half = 0.0;  // of its local times [s]
    bool bounded = false;
    std::vector<Eigen::Isometry3d> X_SBody;  // at mid
    std::vector<double> displacement;        // from there, at most [m]
    std::optional<CollisionShape> around;    // upright, holds all bodies wherever they are
  };
  // A half-step by halves of halves: piece 1 is all of it, and 2n and 2n + 1 are those of n.
  struct Cover {
    HalfStepTracks tracks;
    double from = 0.0, to = 0.0;  // local times [s]; equal: of a rest
    std::map<int, Piece> pieces = {};
    // The piece and the body that were not free the last time: start times nearby mostly are not
    // either. 0: none yet.
    int refused = 0;
    size_t refused_body = 0;
  };
  // Start times [s], and where the support sole stands.
  struct Starts {
    Eigen::Isometry3d X_WS;
    double mid = 0.0, half = 0.0;
    bool settled = false;  // nothing moves at `mid` and then, as long as it is asked about
  };
  using Question = std::array<double, 8>;
  using CoverKey = std::array<double, 4>;

  TimeIntervals Answer(What what, int i, Side support, const Foothold& X_WS, double rise) const;
  Cover& CoverOf(What what, int i, Side support, double rise) const;
  const Piece& PieceOf(Cover& cover, int n) const;
  void Enclose(Piece* piece) const;
  // Adds those of [begin, end] that are free.
  void Collect(Cover& cover, const Eigen::Isometry3d& X_WS, double begin, double end,
               TimeIntervals* free) const;
  bool IsFree(Cover& cover, const Starts& starts) const;
  // The middle of the times at which bodies are looked at, and their half-width [s].
  static std::pair<double, double> TimesOf(const Cover& cover, const Piece& piece,
                                           const Starts& starts);
  bool Clears(const Cover& cover, const Piece& piece, size_t body, const Starts& starts) const;
  bool AllClear(const Cover& cover, const Piece& piece, const Starts& starts) const;
  bool IsFree(Cover& cover, int n, const std::vector<size_t>& bodies, const Starts& starts) const;

  const RobotModel& robot_;
  std::shared_ptr<const MotionModel> model_;
  const StepSet& set_;
  const HalfStepQuery* always_;
  CollisionWorld world_;
  std::vector<CollisionShape> shapes_;  // of the robot's bodies
  MotionBounds bounds_;
  double clearance_;
  double settled_ = 0.0;
  bool settles_ = true;
  TimeIntervals still_;  // when nothing moves, before settled_
  mutable std::mutex mutex_;
  mutable std::vector<CollisionWorld::Scratch> scratch_;  // by body, and of what is around them
  mutable std::map<CoverKey, Cover> covers_;
  mutable std::map<Question, TimeIntervals> known_;
  mutable std::int64_t checks_ = 0, made_ = 0;
};

/// The scene without what moves, and with nothing but that.
Scene RestingPart(const Scene& scene);
/// The other part: on its ground, without areas and files.
Scene MovingPart(const Scene& scene);

}  // namespace halfstep
