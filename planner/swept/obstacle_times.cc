#include "planner/swept/obstacle_times.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "planner/scene/scene_parts.h"
#include "wpg/check.h"

namespace halfstep {
namespace {

constexpr double kShortestStarts = 1.0 / 16;  // [s] start times are not cut below this
constexpr double kShort = 1.0;                // [s] nor below this where they are hopeless
constexpr size_t kFewBodies = 2;              // of which no cylinder is asked
constexpr int kFinestPiece = 32;              // the first of those that are not cut
constexpr int kFinestUnbounded = 1 << 14;     // the same where the motion has no bound yet
constexpr double kClearanceRounding = 1e-9;   // [m]
// Of pieces that are made and of bodies that are looked at, as PlanProgress::effort [µs].
constexpr double kPieceCost = 15.0, kCheckCost = 0.3;

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

ObstacleTimes::ObstacleTimes(const RobotModel& robot, std::shared_ptr<const MotionModel> model,
                             const StepSet& set, const Scene& scene, double clearance,
                             const HalfStepQuery* always, double latest)
    : robot_(robot),
      model_(std::move(model)),
      set_(set),
      always_(always),
      world_(WithoutGround(scene)),
      still_(scene, latest),
      bounds_(robot),
      clearance_(clearance + kClearanceRounding),
      scratch_(robot.bodies.size() + 1) {
  HALFSTEP_CHECK(clearance >= 0.0, "clearance = " << clearance);
  for (const RobotBody& body : robot.bodies) shapes_.emplace_back(body.shape);
}

TimeIntervals ObstacleTimes::DownStarts(int i, Side support, const Foothold& X_WS,
                                        const Foothold& X_WF, const TimeInterval& within) const {
  if (always_ != nullptr && always_->DownIsFree(i, support, X_WS)) return {{}};
  return Answer(What::kDown, i, support, X_WS, X_WF.height - X_WS.height, within);
}

TimeIntervals ObstacleTimes::UpStarts(int i, Side support, const Foothold& X_WS,
                                      const Foothold& X_WF, const TimeInterval& within) const {
  if (always_ != nullptr && always_->UpIsFree(i, support, X_WS)) return {{}};
  // Seen from the foot that has landed.
  return Answer(What::kUp, i, Opposite(support), X_WF, X_WS.height - X_WF.height, within);
}

TimeIntervals ObstacleTimes::OnBothFeet(int i, Side support, const Foothold& X_WS,
                                        const Foothold& X_WF, const TimeInterval& within) const {
  // That posture is part of either half-step.
  if (always_ != nullptr &&
      (always_->DownIsFree(i, support, X_WS) || always_->UpIsFree(i, support, X_WS))) {
    return {{}};
  }
  return Answer(What::kBothFeet, i, support, X_WS, X_WF.height - X_WS.height, within);
}

TimeIntervals ObstacleTimes::OnOneFoot(Side support, const Foothold& X_WS,
                                       const TimeInterval& within) const {
  return Answer(What::kOneFoot, 0, support, X_WS, 0.0, within);
}

double ObstacleTimes::effort() const {
  const std::lock_guard lock(mutex_);
  return 1e-6 *
         (kPieceCost * static_cast<double>(made_) + kCheckCost * static_cast<double>(checks_));
}

TimeIntervals ObstacleTimes::Answer(What what, int i, Side support, const Foothold& X_WS,
                                    double rise, const TimeInterval& within) const {
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
  Known& known = answer->second;
  if (is_new) {
    known.pieces = &PiecesOf(what, i, support, rise);
    known.X_WS = ToIsometry(X_WS);
    known.parts = PartsOf(known.pieces->lasts());
    known.some.resize(known.parts.size(), {.clear = std::vector<bool>(shapes_.size())});
  }
  TimeIntervals free;
  for (size_t part = 0; part < known.parts.size(); ++part) {
    Collect(known.parts[part], part, within, &known, &free);
  }
  return free;
}

std::vector<ObstacleTimes::Part> ObstacleTimes::PartsOf(double lasts) const {
  std::vector<Part> parts;
  double begin = 0.0;
  for (const TimeInterval& still : still_.before_settled()) {
    const double end = still.end - lasts;
    if (end <= still.begin) continue;
    if (begin < still.begin) parts.push_back({begin, still.begin});
    parts.push_back({still.begin, end, true});
    begin = end;
  }
  if (begin < still_.settled()) parts.push_back({begin, still_.settled()});
  if (still_.settles()) {
    parts.push_back({still_.settled(), std::numeric_limits<double>::infinity(), true});
  }
  return parts;
}

HalfStepPieces& ObstacleTimes::PiecesOf(What what, int i, Side support, double rise) const {
  const PiecesKey key = {static_cast<double>(what), static_cast<double>(i),
                         static_cast<double>(Index(support)), rise};
  const auto known = pieces_.find(key);
  if (known != pieces_.end()) return known->second;
  // `support` carries the half-step that is meant.
  HalfStep half_step = what == What::kUp ? set_.Up(i, Opposite(support)) : set_.Down(i, support);
  half_step.X_SF.height = rise;
  const double T = half_step.duration;
  const double from = what == What::kBothFeet ? T : 0.0;
  const double to = what == What::kOneFoot ? 0.0 : T;
  return pieces_
      .try_emplace(key, robot_, bounds_, shapes_, HalfStepTracks(half_step, *model_), from, to)
      .first->second;
}

void ObstacleTimes::Collect(const Part& part, size_t index, const TimeInterval& within,
                            Known* known, TimeIntervals* free) const {
  const TimeInterval asked = Common({part.begin, part.end}, within);
  if (asked.begin > asked.end) return;
  const double mid = 0.5 * (part.begin + part.end);
  if (known->some[index].is == Some::kNotAsked) {
    Some some = known->some[index];
    const Starts starts = {.X_WS = known->X_WS,
                           .mid = part.still ? part.begin : mid,
                           .half = part.still ? 0.0 : std::max(mid - part.begin, part.end - mid),
                           .settled = part.still};
    if (IsFree(*known->pieces, starts, &some)) {
      some.is = Some::kFree;
    } else if (part.still || part.end - part.begin <= kShortestStarts ||
               IsHopeless(*known, part, some.refusal)) {
      some.is = Some::kNotFree;
    } else {
      some.is = Some::kCut;
      some.halves = static_cast<int>(known->some.size());
      known->some.resize(known->some.size() + 2, {.refusal = some.refusal, .clear = some.clear});
    }
    known->some[index] = some;
  }
  const Some& some = known->some[index];
  if (some.is == Some::kFree) AddInterval(part.begin, part.end, free);
  if (some.is != Some::kCut) return;
  const auto first = static_cast<size_t>(some.halves);
  Collect({part.begin, mid}, first, within, known, free);
  Collect({mid, part.end}, first + 1, within, known, free);
}

bool ObstacleTimes::IsHopeless(const Known& known, const Part& part, const Refusal& refusal) const {
  if (part.end - part.begin > kShort) return false;
  const Piece& piece = known.pieces->Of(refusal.piece, &made_);
  for (const double t : {part.begin, 0.5 * (part.begin + part.end), part.end}) {
    if (Clears(known.pieces->from(), piece, refusal.body, {.X_WS = known.X_WS, .mid = t})) {
      return false;
    }
  }
  return true;
}

bool ObstacleTimes::IsFree(HalfStepPieces& pieces, const Starts& starts, Some* some) const {
  Refusal& refusal = some->refusal;
  if (refusal.piece != 0 &&
      !Clears(pieces.from(), pieces.Of(refusal.piece, &made_), refusal.body, starts)) {
    return false;
  }
  std::vector<size_t> bodies;
  for (size_t body = 0; body < shapes_.size(); ++body) {
    if (!some->clear[body]) bodies.push_back(body);
  }
  const std::vector<size_t> left =
      NotClear(pieces.from(), pieces.Of(1, &made_), bodies, starts, bodies.size());
  if (left.empty()) return true;
  for (const size_t body : bodies) some->clear[body] = !std::ranges::binary_search(left, body);
  if (!IsCut(pieces, 1, starts)) {
    refusal = {1, left.front()};
    return false;
  }
  return IsFree(pieces, 2, left, starts, &refusal) && IsFree(pieces, 3, left, starts, &refusal);
}

bool ObstacleTimes::IsCut(HalfStepPieces& pieces, int n, const Starts& starts) const {
  const Piece& piece = pieces.Of(n, &made_);
  // Where the start times are much longer than the piece, they have to be cut first.
  const bool short_enough = !starts.settled && piece.half <= 0.25 * starts.half;
  return pieces.lasts() > 0.0 && n < kFinestUnbounded &&
         (!piece.bounded || (n < kFinestPiece && !short_enough));
}

std::pair<double, double> ObstacleTimes::TimesOf(double from, const Piece& piece,
                                                 const Starts& starts) {
  if (starts.settled) return {starts.mid, 0.0};
  return {starts.mid + piece.mid - from, starts.half + piece.half};
}

bool ObstacleTimes::Clears(double from, const Piece& piece, size_t body,
                           const Starts& starts) const {
  if (!piece.bounded) return false;
  ++checks_;
  const auto [t, half] = TimesOf(from, piece, starts);
  return world_.Clears(shapes_[body], starts.X_WS * piece.X_SBody[body], t,
                       clearance_ + piece.displacement[body], &scratch_[body], half);
}

bool ObstacleTimes::AllClear(double from, const Piece& piece, const Starts& starts) const {
  if (!piece.bounded) return false;
  ++checks_;
  const auto [t, half] = TimesOf(from, piece, starts);
  return world_.Clears(*piece.around, starts.X_WS, t, clearance_, &scratch_.back(), half);
}

std::vector<size_t> ObstacleTimes::NotClear(double from, const Piece& piece,
                                            const std::vector<size_t>& bodies, const Starts& starts,
                                            size_t at_most) const {
  std::vector<size_t> left;
  if (bodies.size() > kFewBodies && AllClear(from, piece, starts)) return left;
  for (size_t b = 0; b < bodies.size() && left.size() < at_most; ++b) {
    if (!Clears(from, piece, bodies[b], starts)) left.push_back(bodies[b]);
  }
  return left;
}

bool ObstacleTimes::IsFree(HalfStepPieces& pieces, int n, const std::vector<size_t>& bodies,
                           const Starts& starts, Refusal* refusal) const {
  const bool cut = IsCut(pieces, n, starts);
  const std::vector<size_t> left =
      NotClear(pieces.from(), pieces.Of(n, &made_), bodies, starts, cut ? bodies.size() : 1);
  if (left.empty()) return true;
  if (!cut) {
    *refusal = {n, left.front()};
    return false;
  }
  return IsFree(pieces, 2 * n, left, starts, refusal) &&
         IsFree(pieces, 2 * n + 1, left, starts, refusal);
}

}  // namespace halfstep
