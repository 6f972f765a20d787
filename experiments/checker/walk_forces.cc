// What the ground has to give: friction, and joints' torques.
#include <algorithm>
#include <cmath>

#include "experiments/checker/walk_statements.h"

namespace halfstep::checker {
namespace {

using Direction = std::array<Interval, 2>;

Interval Abs(const Interval& x) { return Sqrt(Square(x)); }
Interval Dot(const Direction& a, const Direction& b) { return a[0] * b[0] + a[1] * b[1]; }
Rate Dot(const Direction& a, const Seen<1>& b) { return a[0] * b[0] + a[1] * b[1]; }

// Of soles at different heights, in the section (1 − λ)L + λR that has most room in the middle of
// the interval; the disc of radius ρ/4 about p has to lie in it, too. Along an inward normal of an
// edge p is (1 − λ)D_L + λD_R inside, which is linear in λ.
std::vector<Room> RoomInSection(const WalkState& state, const std::array<Seen<1>, 2>& p,
                                const Eigen::Vector2d& size) {
  std::array<Direction, 4> edges;  // of the left sole, of the right one
  for (size_t side = 0; side < 2; ++side) {
    const auto [s, c] = SinCosOf(state.numbers()[kSole + 4 * side + 3].at[0]);
    edges[2 * side] = {c, s};
    edges[2 * side + 1] = {-s, c};
  }
  struct Line {
    std::array<Rate, 2> depths;  // D_L, D_R
    size_t normal;               // of edges
  };
  std::vector<Line> lines;
  for (size_t i = 0; i < 8; ++i) {
    const Direction& e = edges[i / 2];
    const Direction n = i % 2 == 0 ? e : Direction{-e[0], -e[1]};
    Line line{{}, i / 2};
    for (size_t side = 0; side < 2; ++side) {
      const Curve* const sole = &state.numbers()[kSole + 4 * side];
      const Interval half = Interval(0.5 * size.x()) * Abs(Dot(n, edges[2 * side])) +
                            Interval(0.5 * size.y()) * Abs(Dot(n, edges[2 * side + 1]));
      line.depths[side] =
          Dot(n, p[side]) - Rate(Dot(n, Direction{sole[0].at[0], sole[1].at[0]}) - half);
    }
    lines.push_back(line);
  }
  const auto share = [&](const Line& line, size_t along) {
    return std::max(0.25, Dot(edges[line.normal], edges[along]).Magnitude());
  };
  double most = -kInfinity, lambda = 0.0;
  size_t along = 0;
  for (size_t u = 0; u < 4; ++u) {
    std::array<Eigen::Vector2d, 8> ends;  // of ρ's bounds at λ = 0 and 1
    for (size_t i = 0; i < 8; ++i) {
      for (size_t side = 0; side < 2; ++side) {
        ends[i][static_cast<Eigen::Index>(side)] =
            lines[i].depths[side].at[0].Middle() / share(lines[i], u);
      }
    }
    const auto look = [&](double at) {
      double least = kInfinity;
      for (const Eigen::Vector2d& end : ends) {
        least = std::min(least, (1.0 - at) * end[0] + at * end[1]);
      }
      if (least > most) most = least, lambda = at, along = u;
    };
    look(0.0);
    look(1.0);
    for (size_t i = 0; i < 8; ++i) {
      for (size_t k = 0; k < i; ++k) {
        const Eigen::Vector2d off = ends[i] - ends[k];
        if (off[0] * off[1] < 0.0) look(off[0] / (off[0] - off[1]));
      }
    }
  }
  std::vector<Room> rooms;
  for (const Line& line : lines) {
    rooms.push_back(
        {(Interval(1.0) - Interval(lambda)) * line.depths[0] + Interval(lambda) * line.depths[1],
         share(line, along)});
  }
  return rooms;
}

}  // namespace

Kept WalkStatements::Friction(WalkState* state) const {
  const WalkState::Dynamics& all = state->dynamics();
  const std::array<Seen<1>, 2> p = {all.At(state->HeightOf(0)), all.At(state->HeightOf(1))};
  const bool both = state->flight() == nullptr;
  const Seen<1>& level = p[state->Stands(0) ? 0 : 1];
  const std::vector<Room> rooms = both && !state->AreLevel()
                                      ? RoomInSection(*state, p, robot_.sole_size)
                                      : RoomInHull(state->Support<1>({level, level}));
  return FrictionLeft(rooms, all.floor, all.zmp, scene_.friction);
}

// τ = e·(Σ moments of the links that hang on the joint − that of the floor on the foot), about a
// point of the axis. Where both soles stand the right foot carries λW + C and the left one
// (1 − λ)W − C, with λ by the distances of the ZMP from both soles, in the plane of each.
Kept WalkStatements::Torque(const WalkStatement& statement, WalkState* state) const {
  const size_t side = statement.a;
  const LegJoint& joint = robot_.legs[side].joints[statement.b];
  const WalkState::Dynamics& all = state->dynamics();
  const FrameIn<Curve>& X_WLink = state->leg(side).X_WLink[statement.b];
  const Eigen::Isometry3d X_LinkB = joint.X_BLink.inverse();
  const Eigen::Vector3d point = robot_.legs[side].AxisPoint(statement.b);
  const VectorIn<Rate> e =
      FirstOf(X_WLink.Turned(VectorOf<Curve>(X_LinkB.linear() * joint.axis_B)));
  const VectorIn<Rate> r =
      FirstOf(X_WLink * VectorOf<Curve>(X_LinkB * point)) - VectorOf<Rate>(all.reference);
  const auto about = [&](const Push& of) { return Dot(e, of.moment - Cross(r, of.force)); };
  Rate links = 0.0;
  for (size_t j = statement.b; j < 6; ++j) links = links + about(all.links[side][j]);
  const Rate floor = about(all.floor);
  if (state->flight() != nullptr) {
    const Rate torque = state->Stands(side) ? links - floor : links;
    return Kept::Under(joint.max_torque, torque.over[0], torque.at[0]);
  }
  const auto shared = [&](const auto& of) {
    std::array<Interval, 2> away;
    std::array<std::array<Interval, 3>, 2> center;
    for (size_t s = 0; s < 2; ++s) {
      const Curve* const sole = &state->numbers()[kSole + 4 * s];
      center[s] = {sole[0].at[0], sole[1].at[0], sole[2].at[0]};
      const Seen<1> p = all.At(center[s][2]);
      const auto [sin, cos] = SinCosOf(sole[3].at[0]);
      const Interval x = of(p[0]) - center[s][0], y = of(p[1]) - center[s][1];
      const auto out = [](const Interval& along, double size) {
        const Interval half = Interval(0.5) * Interval(size), past = along - half;
        const Interval before = -along - half;
        return Interval(std::max({0.0, past.lo, before.lo}), std::max({0.0, past.hi, before.hi}));
      };
      away[s] = Sqrt(Square(out(cos * x + sin * y, robot_.sole_size.x())) +
                     Square(out(cos * y - sin * x, robot_.sole_size.y())));
    }
    const Interval sum = away[0] + away[1];
    if (!(sum.lo > 0.0)) throw NotDefined();
    const Interval of_right(std::max(0.0, (Interval(away[0].lo) / sum).lo),
                            std::min(1.0, (Interval(away[0].hi) / sum).hi));
    // C = λ(1 − λ) d × f but for its z, d from the left sole's centre to the right one's.
    std::array<Interval, 3> d, f;
    for (size_t k = 0; k < 3; ++k) {
      d[k] = center[1][k] - center[0][k];
      f[k] = of(all.floor.force[k]);
    }
    const Interval turn =
        of_right * (Interval(1.0) - of_right) *
        (of(e[0]) * (d[1] * f[2] - d[2] * f[1]) + of(e[1]) * (d[2] * f[0] - d[0] * f[2]));
    return of(links) - (side == 1 ? of_right * of(floor) + turn
                                  : (Interval(1.0) - of_right) * of(floor) - turn);
  };
  return Kept::Under(joint.max_torque, shared([](const Rate& x) { return x.over[0]; }),
                     shared([](const Rate& x) { return x.at[0]; }));
}

}  // namespace halfstep::checker
