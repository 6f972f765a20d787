#include "experiments/checker/walk_state.h"

#include <algorithm>

#include "wpg/nth.h"

namespace halfstep::checker {
namespace {

// An upright frame.
FrameIn<Curve> Upright(const Curve& x, const Curve& y, const Curve& z, const Curve& yaw) {
  const auto [s, c] = SinCosOf(yaw);
  FrameIn<Curve> frame;
  frame.R = {VectorIn<Curve>{c, -s, 0.0}, VectorIn<Curve>{s, c, 0.0}, frame.R[2]};
  frame.p = {x, y, z};
  return frame;
}

}  // namespace

WalkState::WalkState(const RobotModel& robot, const std::array<LegSolver, 2>& solvers,
                     const WalkMotion& motion, const Interval& waist_height, double from, double to)
    : robot_(robot),
      solvers_(solvers),
      from_(from),
      to_(to),
      middle_(0.5 * from + 0.5 * to),
      h_(Interval(from, to).FarthestFrom(middle_)),
      numbers_(motion.On(from, to)),
      flight_(motion.FlightAt(middle_)),
      centers_(robot.bodies.size()) {
  for (size_t side = 0; side < 2; ++side) {
    const size_t sole = kSole + 4 * side;
    // A foot that stands has one place.
    for (size_t k = sole; Stands(side) && k < sole + 4; ++k) numbers_[k] = numbers_[k].at[0];
    soles_[side] =
        Upright(numbers_[sole], numbers_[sole + 1], numbers_[sole + 2], numbers_[sole + 3]);
    carried_[side] = solvers[side].Carried(soles_[side]);
  }
  X_WB_ = Upright(numbers_[kCom], numbers_[kCom + 1], Curve(waist_height) + numbers_[kWaistZ],
                  numbers_[kYaw]);
  const double ahead = robot.com_x_B;
  X_WB_.p[0] = X_WB_.p[0] - ahead * X_WB_.R[0][0];
  X_WB_.p[1] = X_WB_.p[1] - ahead * X_WB_.R[1][0];
}

const LegPosture& WalkState::leg(size_t side) {
  if (unknown_[side]) throw NotDefined();
  if (legs_[side]) return *legs_[side];
  unknown_[side] = true;
  legs_[side] = solvers_[side].At(X_WB_, carried_[side], from_, to_);
  unknown_[side] = false;
  return *legs_[side];
}

void FollowLegs(const RobotModel& robot, const WalkMotion& motion, const Interval& waist_height,
                const std::vector<double>& knots, std::array<LegSolver, 2>* solvers) {
  for (size_t side = 0; side < 2; ++side) {
    (*solvers)[side].Follow(knots, [&](double from, double to) {
      return WalkState(robot, *solvers, motion, waist_height, from, to).foot(side);
    });
  }
}

const FrameIn<Curve>& WalkState::FrameOfBody(const RobotBody& body) {
  return body.leg < 0 ? X_WB_ : Nth(leg(static_cast<size_t>(body.leg)).X_WLink, body.link);
}

const Vector& WalkState::CenterOf(size_t body) {
  if (!centers_[body]) {
    const RobotBody& of = robot_.bodies[body];
    const VectorIn<Curve> center = FrameOfBody(of) * VectorOf<Curve>(of.shape.center);
    centers_[body] = {center[0].over[0], center[1].over[0], center[2].over[0]};
  }
  return *centers_[body];
}

std::array<std::array<Interval, 2>, 4> WalkState::CornersOf(size_t side) const {
  const Curve* const sole = &numbers_[kSole + 4 * side];
  const auto [s, c] = SinCosOf(sole[3].at[0]);
  std::array<std::array<Interval, 2>, 4> corners;
  for (size_t i = 0; i < 4; ++i) {
    const Interval x = (i == 0 || i == 3 ? 0.5 : -0.5) * robot_.sole_size.x();
    const Interval y = (i < 2 ? 0.5 : -0.5) * robot_.sole_size.y();
    corners[i] = {sole[0].at[0] + c * x - s * y, sole[1].at[0] + s * x + c * y};
  }
  return corners;
}

// With corners X of soles at h_X and the point P(h_X) in their planes, X − P(h_X) is where the
// corner is seen. The way from one corner to another, d, moves only where their heights differ.
template <int N>
std::vector<SupportEdge<N>> WalkState::Support(const std::array<Seen<N>, 2>& points,
                                               const Seen<N>& lean) const {
  std::vector<std::array<Interval, 2>> corners;
  std::vector<Seen<N>> seen;
  std::vector<size_t> sides;
  for (size_t side = 0; side < 2; ++side) {
    if (!Stands(side)) continue;
    for (const auto& [x, y] : CornersOf(side)) {
      corners.push_back({x, y});
      seen.push_back({Taylor<N>(x) - points[side][0], Taylor<N>(y) - points[side][1]});
      sides.push_back(side);
    }
  }
  std::vector<Eigen::Vector2d> middles;
  for (const auto& [x, y] : seen) middles.emplace_back(x.at[0].Middle(), y.at[0].Middle());
  const std::vector<size_t> hull = HullHint(middles);
  std::vector<SupportEdge<N>> edges;
  for (size_t i = 0; i < hull.size(); ++i) {
    const size_t a = hull[i], b = hull[(i + 1) % hull.size()];
    Seen<N> d;
    for (size_t k = 0; k < 2; ++k) {
      d[k] = Taylor<N>(corners[b][k] - corners[a][k]);
      if (sides[a] == sides[b]) continue;
      d[k] = d[k] + (HeightOf(sides[a]) - HeightOf(sides[b])) * lean[k];
    }
    const Taylor<N> scale = Inverse(Sqrt(d[0] * d[0] + d[1] * d[1]));
    SupportEdge<N> edge{{d[0] * scale, d[1] * scale}, {}};
    edge.inside = seen[a][0] * edge.along[1] - seen[a][1] * edge.along[0];
    edges.push_back(edge);
  }
  return edges;
}
template std::vector<SupportEdge<1>> WalkState::Support(const std::array<Seen<1>, 2>&,
                                                        const Seen<1>&) const;
template std::vector<SupportEdge<3>> WalkState::Support(const std::array<Seen<3>, 2>&,
                                                        const Seen<3>&) const;

const WalkState::Dynamics& WalkState::dynamics() {
  if (dynamics_) return *dynamics_;
  leg(0), leg(1);
  Dynamics all;
  all.reference = {numbers_[kZmp].at[0].Middle(), numbers_[kZmp + 1].at[0].Middle(),
                   HeightOf(Stands(0) ? 0 : 1).Middle()};
  all.floor = PushOf(robot_.masses.waist, X_WB_, all.reference);
  for (size_t side = 0; side < 2; ++side) {
    for (size_t i = 0; i < 6; ++i) {
      Push& link = all.links[side][i];
      link = PushOf(robot_.masses.links[side][i], legs_[side]->X_WLink[i], all.reference);
      all.floor += link;
    }
  }
  const Rate scale = Inverse(all.floor.force[2]);
  if (!(all.floor.force[2].over[0].lo > 0.0)) throw NotDefined();
  all.zmp = {-(all.floor.moment[1] * scale), all.floor.moment[0] * scale};
  all.lean = {all.floor.force[0] * scale, all.floor.force[1] * scale};
  return dynamics_.emplace(all);
}

}  // namespace halfstep::checker
