#include "planner/swept/obstacle_times.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "wpg/check.h"
#include "wpg/motion/posture.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

constexpr double kShortestStarts = 1.0 / 16;  // [s] start times are not cut below this
constexpr size_t kFewBodies = 2;              // of which no cylinder is asked
constexpr int kFinestPiece = 32;              // the first of those that are not cut
constexpr int kFinestUnbounded = 1 << 14;     // the same where the motion has no bound yet
constexpr double kClearanceRounding = 1e-9;   // [m]
constexpr double kEnclosureRounding = 1e-9;   // of the cylinder around bodies [m]
// Of pieces that are made and of bodies that are looked at, as PlanProgress::effort [µs].
constexpr double kPieceCost = 15.0, kCheckCost = 0.3;

// From when on an obstacle is where it stays [s]; ∞: never.
double SettlesAt(const Obstacle& obstacle) {
  const ObstacleMotion& motion = obstacle.motion;
  const double arrives = motion.waypoints.empty() ? 0.0 : motion.waypoints.back().t;
  const double known = motion.speed == 0.0 ? 0.0 : motion.measured_at + motion.horizon;
  return std::max({0.0, arrives, known});
}

// When an obstacle begins or ceases to move, or to be known less well, in any order [s].
std::vector<double> ChangesOf(const ObstacleMotion& motion) {
  std::vector<double> changes;
  for (const ObstacleMotion::Waypoint& waypoint : motion.waypoints) changes.push_back(waypoint.t);
  if (motion.speed > 0.0) {
    for (const double since : {-motion.horizon, 0.0, motion.horizon}) {
      changes.push_back(motion.measured_at + since);
    }
  }
  return changes;
}

// Whether pose and uncertainty are the same from one change to the next.
bool RestsBetween(const Obstacle& obstacle, double begin, double end) {
  const double mid = 0.5 * (begin + end);
  return obstacle.motion.UncertaintyRateAt(mid) == 0.0 &&
         obstacle.PoseAt(begin).isApprox(obstacle.PoseAt(mid), 0.0) &&
         obstacle.PoseAt(mid).isApprox(obstacle.PoseAt(end), 0.0);
}

// Only what moves, on no ground.
Scene WithoutGround(const Scene& scene) {
  Scene moving = MovingPart(scene);
  moving.ground = Scene{}.ground;
  return moving;
}

void AddInterval(double begin, double end, TimeIntervals* free) {
  if (!free->empty() && free->back().end == begin) {
    free->back().end = end;
  } else {
    free->push_back({begin, end});
  }
}

}  // namespace

Scene RestingPart(const Scene& scene) {
  Scene resting = scene;
  std::erase_if(resting.obstacles, [](const Obstacle& obstacle) { return !obstacle.rests(); });
  return resting;
}

Scene MovingPart(const Scene& scene) {
  Scene moving = scene.Emptied();
  for (const Obstacle& obstacle : scene.obstacles) {
    if (!obstacle.rests()) moving.obstacles.push_back(obstacle);
  }
  return moving;
}

ObstacleTimes::ObstacleTimes(const RobotModel& robot, std::shared_ptr<const MotionModel> model,
                             const StepSet& set, const Scene& scene, double clearance,
                             const HalfStepQuery* always, double latest)
    : robot_(robot),
      model_(std::move(model)),
      set_(set),
      always_(always),
      world_(WithoutGround(scene)),
      bounds_(robot),
      clearance_(clearance + kClearanceRounding),
      scratch_(robot.bodies.size() + 1) {
  HALFSTEP_CHECK(clearance >= 0.0 && latest >= 0.0,
                 "clearance = " << clearance << ", latest = " << latest);
  for (const RobotBody& body : robot.bodies) shapes_.emplace_back(body.shape);
  for (const Obstacle& obstacle : scene.obstacles) {
    if (!obstacle.rests()) settled_ = std::max(settled_, SettlesAt(obstacle));
  }
  settles_ = settled_ <= latest;
  settled_ = std::min(settled_, latest);
  std::vector<double> changes = {0.0, settled_};
  for (const Obstacle& obstacle : scene.obstacles) {
    if (obstacle.rests()) continue;
    for (const double t : ChangesOf(obstacle.motion)) {
      if (t > 0.0 && t < settled_) changes.push_back(t);
    }
  }
  std::ranges::sort(changes);
  for (size_t i = 0; i + 1 < changes.size(); ++i) {
    if (changes[i] == changes[i + 1]) continue;
    const bool rests = std::ranges::all_of(scene.obstacles, [&](const Obstacle& obstacle) {
      return obstacle.rests() || RestsBetween(obstacle, changes[i], changes[i + 1]);
    });
    if (rests) still_.push_back({changes[i], changes[i + 1]});
  }
}

TimeIntervals ObstacleTimes::DownStarts(int i, Side support, const Foothold& X_WS,
                                        const Foothold& X_WF) const {
  if (always_ != nullptr && always_->DownIsFree(i, support, X_WS)) return {{}};
  return Answer(What::kDown, i, support, X_WS, X_WF.height - X_WS.height);
}

TimeIntervals ObstacleTimes::UpStarts(int i, Side support, const Foothold& X_WS,
                                      const Foothold& X_WF) const {
  if (always_ != nullptr && always_->UpIsFree(i, support, X_WS)) return {{}};
  // Seen from the foot that has landed.
  return Answer(What::kUp, i, Opposite(support), X_WF, X_WS.height - X_WF.height);
}

TimeIntervals ObstacleTimes::OnBothFeet(int i, Side support, const Foothold& X_WS,
                                        const Foothold& X_WF) const {
  // That posture is part of either half-step.
  if (always_ != nullptr &&
      (always_->DownIsFree(i, support, X_WS) || always_->UpIsFree(i, support, X_WS))) {
    return {{}};
  }
  return Answer(What::kBothFeet, i, support, X_WS, X_WF.height - X_WS.height);
}

TimeIntervals ObstacleTimes::OnOneFoot(Side support, const Foothold& X_WS) const {
  return Answer(What::kOneFoot, 0, support, X_WS, 0.0);
}

double ObstacleTimes::effort() const {
  const std::lock_guard lock(mutex_);
  return 1e-6 *
         (kPieceCost * static_cast<double>(made_) + kCheckCost * static_cast<double>(checks_));
}

TimeIntervals ObstacleTimes::Answer(What what, int i, Side support, const Foothold& X_WS,
                                    double rise) const {
  const Question question = {static_cast<double>(what),
                             static_cast<double>(i),
                             static_cast<double>(Index(support)),
                             rise,
                             X_WS.x,
                             X_WS.y,
                             X_WS.height,
                             X_WS.yaw};
  const std::lock_guard lock(mutex_);
  const auto [answer, is_new] = known_.try_emplace(question);
  if (!is_new) return answer->second;
  TimeIntervals& free = answer->second;
  Cover& cover = CoverOf(what, i, support, rise);
  cover.refused = 0;  // so that an answer does not depend on those before
  const Eigen::Isometry3d pose = ToIsometry(X_WS);
  double begin = 0.0;
  for (const TimeInterval& still : still_) {
    const double lasts = cover.to - cover.from, end = still.end - lasts;
    if (end <= still.begin) continue;
    if (begin < still.begin) Collect(cover, pose, begin, still.begin, &free);
    // One question for all of it.
    if (IsFree(cover, {.X_WS = pose, .mid = still.begin, .settled = true})) {
      AddInterval(still.begin, end, &free);
    }
    begin = end;
  }
  if (begin < settled_) Collect(cover, pose, begin, settled_, &free);
  if (settles_ && IsFree(cover, {.X_WS = pose, .mid = settled_, .settled = true})) {
    AddInterval(settled_, std::numeric_limits<double>::infinity(), &free);
  }
  return free;
}

ObstacleTimes::Cover& ObstacleTimes::CoverOf(What what, int i, Side support, double rise) const {
  const CoverKey key = {static_cast<double>(what), static_cast<double>(i),
                        static_cast<double>(Index(support)), rise};
  const auto known = covers_.find(key);
  if (known != covers_.end()) return known->second;
  // `support` carries the half-step that is meant.
  HalfStep half_step = what == What::kUp ? set_.Up(i, Opposite(support)) : set_.Down(i, support);
  half_step.X_SF.height = rise;
  const double T = half_step.duration;
  const double from = what == What::kBothFeet ? T : 0.0;
  const double to = what == What::kOneFoot ? 0.0 : T;
  return covers_.try_emplace(key, Cover{HalfStepTracks(half_step, *model_), from, to})
      .first->second;
}

const ObstacleTimes::Piece& ObstacleTimes::PieceOf(Cover& cover, int n) const {
  const auto [at, is_new] = cover.pieces.try_emplace(n);
  Piece& piece = at->second;
  if (!is_new) return piece;
  ++made_;
  int count = 1;  // of the pieces that are as long
  while (2 * count <= n) count *= 2;
  const double width = (cover.to - cover.from) / count;
  const double from = cover.from + width * (n - count);
  piece.mid = from + 0.5 * width;
  piece.half = 0.5 * width * (1.0 + 1e-9);  // for the rounding of its ends
  if (width == 0.0) {
    const Posture posture = SolvePosture(robot_, cover.tracks.At(piece.mid).value);
    piece.bounded = posture.reachable;
    for (const RobotBody& body : robot_.bodies) piece.X_SBody.push_back(posture.OfBody(body));
    piece.displacement.assign(robot_.bodies.size(), 0.0);
    Enclose(&piece);
    return piece;
  }
  WalkState second = WalkState::Zero();
  cover.tracks.AddSecondBounds(from, from + width, &second);
  IntervalMotion motion;
  bounds_.Bound(cover.tracks.At(piece.mid), second, piece.half, &motion);
  piece.bounded = motion.bounded;
  if (!piece.bounded) return piece;
  for (const RobotBody& body : robot_.bodies) {
    piece.X_SBody.push_back(motion.posture.OfBody(body));
  }
  piece.displacement = std::move(motion.displacement);
  Enclose(&piece);
  return piece;
}

void ObstacleTimes::Enclose(Piece* piece) const {
  Eigen::AlignedBox3d box;
  for (size_t body = 0; body < shapes_.size(); ++body) {
    const Eigen::Vector3d center = piece->X_SBody[body] * shapes_[body].center();
    const double radius = shapes_[body].radius() + piece->displacement[body] + kEnclosureRounding;
    box.extend(Eigen::AlignedBox3d(center.array() - radius, center.array() + radius));
  }
  const Eigen::Vector3d middle = box.center();
  ConvexBody around;
  for (size_t body = 0; body < shapes_.size(); ++body) {
    const Eigen::Vector3d center = piece->X_SBody[body] * shapes_[body].center();
    const double radius = shapes_[body].radius() + piece->displacement[body] + kEnclosureRounding;
    around.disc_radius = std::max(around.disc_radius, (center - middle).head<2>().norm() + radius);
  }
  around.vertices.resize(3, 2);
  around.vertices << middle.x(), middle.x(), middle.y(), middle.y(), box.min().z(), box.max().z();
  BoundBySphere(&around);
  piece->around.emplace(std::move(around));
}

void ObstacleTimes::Collect(Cover& cover, const Eigen::Isometry3d& X_WS, double begin, double end,
                            TimeIntervals* free) const {
  const double mid = 0.5 * (begin + end);
  const double half = std::max(mid - begin, end - mid);
  if (IsFree(cover, {.X_WS = X_WS, .mid = mid, .half = half})) {
    AddInterval(begin, end, free);
  } else if (end - begin > kShortestStarts) {
    Collect(cover, X_WS, begin, mid, free);
    Collect(cover, X_WS, mid, end, free);
  }
}

bool ObstacleTimes::IsFree(Cover& cover, const Starts& starts) const {
  if (cover.refused != 0 &&
      !Clears(cover, PieceOf(cover, cover.refused), cover.refused_body, starts)) {
    return false;
  }
  std::vector<size_t> everything(robot_.bodies.size());
  std::iota(everything.begin(), everything.end(), size_t{0});
  return IsFree(cover, 1, everything, starts);
}

std::pair<double, double> ObstacleTimes::TimesOf(const Cover& cover, const Piece& piece,
                                                 const Starts& starts) {
  if (starts.settled) return {starts.mid, 0.0};
  return {starts.mid + piece.mid - cover.from, starts.half + piece.half};
}

bool ObstacleTimes::Clears(const Cover& cover, const Piece& piece, size_t body,
                           const Starts& starts) const {
  if (!piece.bounded) return false;
  ++checks_;
  const auto [t, half] = TimesOf(cover, piece, starts);
  return world_.Clears(shapes_[body], starts.X_WS * piece.X_SBody[body], t,
                       clearance_ + piece.displacement[body], &scratch_[body], half);
}

bool ObstacleTimes::AllClear(const Cover& cover, const Piece& piece, const Starts& starts) const {
  if (!piece.bounded) return false;
  ++checks_;
  const auto [t, half] = TimesOf(cover, piece, starts);
  return world_.Clears(*piece.around, starts.X_WS, t, clearance_, &scratch_.back(), half);
}

bool ObstacleTimes::IsFree(Cover& cover, int n, const std::vector<size_t>& bodies,
                           const Starts& starts) const {
  const Piece& piece = PieceOf(cover, n);
  if (bodies.size() > kFewBodies && AllClear(cover, piece, starts)) return true;
  // Where the start times are much longer than the piece, they have to be cut first.
  const bool short_enough = !starts.settled && piece.half <= 0.25 * starts.half;
  const bool finest = cover.from == cover.to || n >= kFinestUnbounded ||
                      (piece.bounded && (n >= kFinestPiece || short_enough));
  std::vector<size_t> left;
  for (const size_t body : bodies) {
    if (Clears(cover, piece, body, starts)) continue;
    if (finest) {
      cover.refused = n;
      cover.refused_body = body;
      return false;
    }
    left.push_back(body);
  }
  if (left.empty()) return true;
  return IsFree(cover, 2 * n, left, starts) && IsFree(cover, 2 * n + 1, left, starts);
}

}  // namespace halfstep
