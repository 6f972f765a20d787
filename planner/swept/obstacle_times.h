#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "planner/collision/collision_world.h"
#include "planner/scene/scene.h"
#include "planner/search/half_step_query.h"
#include "planner/search/half_step_times.h"
#include "planner/search/step_set.h"
#include "planner/swept/half_step_pieces.h"
#include "planner/swept/still_times.h"
#include "wpg/motion/motion_bounds.h"
#include "wpg/motion/motion_model.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// When a robot's half-steps keep clear of the obstacles of a scene that move. An interval of start
/// times is told only when a bound holds for all of it: each body is where it is in the middle of a
/// piece of the half-step, or no farther from there than its motion allows; each obstacle is where
/// it is in the middle of the times that are meant, or no farther than its speed allows. A cylinder
/// around all bodies is asked first. Where that does not decide, both are halved, down to 1/32 of T
/// (less where the motion has no bound) and 1/16 s, or 1 s where one body is in the way at the
/// beginning, in the middle and at the end. What is undecided then is told as not free. Only what
/// is asked about is decided; answers do not depend on what was asked before.
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

  TimeIntervals DownStarts(int i, Side support, const Foothold& X_WS, const Foothold& X_WF,
                           const TimeInterval& within) const override;
  TimeIntervals UpStarts(int i, Side support, const Foothold& X_WS, const Foothold& X_WF,
                         const TimeInterval& within) const override;
  TimeIntervals OnBothFeet(int i, Side support, const Foothold& X_WS, const Foothold& X_WF,
                           const TimeInterval& within) const override;
  TimeIntervals OnOneFoot(Side support, const Foothold& X_WS,
                          const TimeInterval& within) const override;
  double settled() const override { return still_.settled(); }
  double effort() const override;

 private:
  // What is asked: a half-step, or the rest before it or after it.
  enum class What { kDown, kUp, kBothFeet, kOneFoot };
  // Start times [s], and where the support sole stands.
  struct Starts {
    Eigen::Isometry3d X_WS;
    double mid = 0.0, half = 0.0;
    bool settled = false;  // nothing moves at `mid` and then, as long as it is asked about
  };
  // A piece and a body that are not free at some start times: those in their halves mostly are not
  // either. 0: none is known.
  struct Refusal {
    int piece = 0;
    size_t body = 0;
  };
  // Some of the start times of a question, by halves of halves.
  struct Some {
    enum { kNotAsked, kFree, kNotFree, kCut } is = kNotAsked;
    int halves = 0;  // where cut, its first half; the second one follows
    Refusal refusal = {};
    std::vector<bool> clear = {};  // bodies that are so in all pieces
  };
  // Start times that are cut by themselves.
  struct Part {
    double begin = 0.0, end = 0.0;  // [s]
    bool still = false;             // nothing moves until half-steps that begin then have ended
  };
  struct Known {
    HalfStepPieces* pieces = nullptr;
    Eigen::Isometry3d X_WS;
    std::vector<Part> parts;  // all times, but those of which nothing is known
    std::vector<Some> some;   // first one of each part
  };
  using Piece = HalfStepPieces::Piece;
  using Question = std::array<double, 8>;
  using PiecesKey = std::array<double, 4>;

  TimeIntervals Answer(What what, int i, Side support, const Foothold& X_WS, double rise,
                       const TimeInterval& within) const;
  std::vector<Part> PartsOf(double lasts) const;
  HalfStepPieces& PiecesOf(What what, int i, Side support, double rise) const;
  // Adds those of `part` that are free, as far as they touch `within`; they are known.some[index].
  void Collect(const Part& part, size_t index, const TimeInterval& within, Known* known,
               TimeIntervals* free) const;
  bool IsFree(HalfStepPieces& pieces, const Starts& starts, Some* some) const;
  // Whether piece n is cut where it is not free.
  bool IsCut(HalfStepPieces& pieces, int n, const Starts& starts) const;
  // Whether start times that are not free are so in the middle and at their ends as well, so that
  // it is not worth to cut them.
  bool IsHopeless(const Known& known, const Part& part, const Refusal& refusal) const;
  // The middle of the times at which bodies are looked at, and their half-width [s].
  static std::pair<double, double> TimesOf(double from, const Piece& piece, const Starts& starts);
  bool Clears(double from, const Piece& piece, size_t body, const Starts& starts) const;
  bool AllClear(double from, const Piece& piece, const Starts& starts) const;
  // The first `at_most` of the bodies that the bound of a piece does not prove clear.
  std::vector<size_t> NotClear(double from, const Piece& piece, const std::vector<size_t>& bodies,
                               const Starts& starts, size_t at_most) const;
  bool IsFree(HalfStepPieces& pieces, int n, const std::vector<size_t>& bodies,
              const Starts& starts, Refusal* refusal) const;

  const RobotModel& robot_;
  std::shared_ptr<const MotionModel> model_;
  const StepSet& set_;
  const HalfStepQuery* always_;
  CollisionWorld world_;
  StillTimes still_;
  std::vector<CollisionShape> shapes_;  // of the robot's bodies
  MotionBounds bounds_;
  double clearance_;
  mutable std::mutex mutex_;
  mutable std::vector<CollisionWorld::Scratch> scratch_;  // by body, and of what is around them
  mutable std::map<PiecesKey, HalfStepPieces> pieces_;
  mutable std::map<Question, Known> known_;
  mutable std::int64_t checks_ = 0, made_ = 0;
};

}  // namespace halfstep
