#include "experiments/checker/standing_soles.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiments/checker/walk_statements.h"
#include "wpg/elementary.h"
#include "wpg/files/text.h"

namespace halfstep::checker {
namespace {

using Eigen::Matrix2Xd;
using Eigen::Vector2d;
using Kind = TrajectoryFinding::Kind;

// Heights are whole nanometres; gaps that are no wider are none [m].
constexpr double kSameHeight = 0.5e-9, kGap = 2e-9;
// More than all rounding of corners below 10⁵ m in doubles [m].
constexpr double kRounded = 1e-10;

// A sole's outline where it stands.
struct Standing {
  FrameIn<Curve> X_WF;  // seen from above
  double z = 0.0;       // [m]
  double at = 0.0;      // [s]
  size_t side = 0;      // Index(Side)
  size_t place = 0;     // as proofs count: side at the start; 2 + j: after flight j
};

std::vector<Standing> StandingFrom(const WalkMotion& motion, double from) {
  std::vector<Standing> all;
  for (size_t side = 0; side < 2; ++side) {
    double since = motion.StandsSince(side), until = kInfinity;
    size_t place = side;
    const auto add = [&] {
      if (until < from) return;
      const WalkNumbers x = motion.On(since, since);
      const Curve* const sole = &x[kSole + 4 * side];
      const auto [s, c] = SinCosOf(sole[3]);
      Standing standing{TurnAbout(Eigen::Vector3d::UnitZ(), s, c), sole[2].at[0].Middle(), since,
                        side, place};
      standing.X_WF.p = {sole[0], sole[1], 0.0};
      all.push_back(standing);
    };
    for (size_t j = 0; j < motion.flights().size(); ++j) {
      const WalkMotion::Flight& flight = motion.flights()[j];
      if (flight.side != side) continue;
      until = flight.begin;
      add();
      since = std::min(flight.end, motion.end());
      place = 2 + motion.first() / 2 + j;
      until = flight.lands ? kInfinity : -kInfinity;
    }
    add();
  }
  return all;
}

double FlatGap(const ConvexBody& at_rest, const ConvexBody& outline, const FrameIn<Curve>& X_WF,
               double demanded) {
  Eigen::Vector3d direction{0, 0, 0};
  return WalkStatements::Apart({at_rest, FrameIn<Curve>(), VectorOf(at_rest.center)},
                               {outline, X_WF, CenterAt(X_WF, outline)}, demanded, &direction,
                               false)
      .bound;
}

// How far a sole is from an area, by the direction that is told, or that is noted.
Kept FromArea(const ConvexBody& area, const ConvexBody& outline, const Standing& sole,
              double demanded, bool told, ProofHints::Directions* known) {
  Eigen::Vector3d direction = ProofHints::At(*known, sole.at);
  const Vector at_rest = VectorOf(area.center), center = CenterAt(sole.X_WF, outline);
  const Kept kept = WalkStatements::Apart({area, FrameIn<Curve>(), at_rest},
                                          {outline, sole.X_WF, center}, demanded, &direction, told);
  if (told) return kept;
  if (direction.isZero()) {  // their circles are apart
    const Vector away = center - at_rest;
    direction << away[0].Middle(), away[1].Middle(), 0.0;
  }
  ProofHints::Note(sole.at, direction.normalized(), known);
  return kept;
}

// How far points are to the left of the line from a to b, at least [m].
double LeftOf(const Vector2d& a, const Vector2d& b, const VectorIn<Curve>& p) {
  const Interval x = Interval(b.x()) - Interval(a.x()), y = Interval(b.y()) - Interval(a.y());
  const Interval across =
      x * (p[1].over[0] - Interval(a.y())) - y * (p[0].over[0] - Interval(a.x()));
  return (across / Sqrt(Square(x) + Square(y))).lo;
}
double LeftOf(const Vector2d& a, const Vector2d& b, const Vector2d& p) {
  const Vector2d along = (b - a).normalized();
  return along.x() * (p.y() - a.y()) - along.y() * (p.x() - a.x());
}

// What of a convex polygon is farther to the left of the line from a to b than `least`.
Matrix2Xd Cut(const Matrix2Xd& polygon, const Vector2d& a, const Vector2d& b, double least) {
  Matrix2Xd kept(2, 2 * polygon.cols());
  Eigen::Index count = 0;
  for (Eigen::Index i = 0; i < polygon.cols(); ++i) {
    const Vector2d p = polygon.col(i), q = polygon.col((i + 1) % polygon.cols());
    const double of_p = LeftOf(a, b, p) - least, of_q = LeftOf(a, b, q) - least;
    if (of_p >= 0.0) kept.col(count++) = p;
    if (of_p * of_q < 0.0) kept.col(count++) = p + of_p / (of_p - of_q) * (q - p);
  }
  return kept.leftCols(count);
}

// Whether convex polygons hold all of another one, gaps aside: what lies outside of an edge of one
// of them has to be within the others.
bool Hold(const std::vector<const Matrix2Xd*>& polygons, size_t first, Matrix2Xd part) {
  if (part.cols() < 3) return true;
  for (Eigen::Index i = 0; i < part.cols(); ++i) {  // nowhere wider than a gap across an edge
    const Vector2d a = part.col(i), b = part.col((i + 1) % part.cols());
    if (a == b) continue;
    double width = 0.0;
    for (const Vector2d& p : part.colwise()) width = std::max(width, LeftOf(a, b, p));
    if (width + kRounded < kGap) return true;
  }
  if (first == polygons.size()) return false;
  const Matrix2Xd& polygon = *polygons[first];
  for (Eigen::Index i = 0; i < polygon.cols(); ++i) {
    const Vector2d a = polygon.col(i), b = polygon.col((i + 1) % polygon.cols());
    if (!Hold(polygons, first + 1, Cut(part, b, a, -kRounded))) return false;
    part = Cut(part, a, b, -kRounded);
    if (part.cols() < 3) return true;
  }
  return true;
}

// All that is less than `around` from the outline, and a little more: it lies in the half-planes
// n·x ≤ max n·p + around of any unit vectors n.
Matrix2Xd Around(const Standing& sole, const Matrix2Xd& outline, double around) {
  constexpr int kSides = 32;
  Matrix2Xd corners(2, outline.cols());
  for (Eigen::Index i = 0; i < outline.cols(); ++i) {
    const VectorIn<Curve> at = sole.X_WF * VectorOf<Curve>({outline(0, i), outline(1, i), 0.0});
    corners.col(i) << at[0].at[0].Middle(), at[1].at[0].Middle();
  }
  const double far =
      2.0 * (corners.colwise() - corners.col(0)).colwise().norm().maxCoeff() + around;
  Matrix2Xd grown(2, 4);
  grown << far, -far, -far, far, far, far, -far, -far;
  grown.colwise() += corners.col(0);
  const auto cut = [&](const Vector2d& n) {
    const Vector2d a = ((n.transpose() * corners).maxCoeff() + around) * n;
    grown = Cut(grown, a, a + Vector2d(-n.y(), n.x()), -kRounded);
  };
  for (int i = 0; i < kSides; ++i) {
    const auto [s, c] = SinCos(2.0 * std::numbers::pi * i / kSides);
    cut({c, s});
  }
  for (Eigen::Index i = 0; i < corners.cols(); ++i) {
    const Vector2d side = corners.col((i + 1) % corners.cols()) - corners.col(i);
    cut(Vector2d(side.y(), -side.x()).normalized());
  }
  return grown;
}

// How far inside its level an outline lies, at least [m]; of several surfaces that bear it together
// what is demanded, or that it does not.
double InsideLevel(const Standing& sole, const Matrix2Xd& outline, const Ground& ground,
                   double demanded) {
  double least = std::abs(ground.Floor() - sole.z) < kSameHeight ? kInfinity : -kInfinity;
  const ConvexBody flat = PrismOver(outline);
  std::vector<const Matrix2Xd*> tops;
  double in_the_way = kInfinity;
  for (const GroundSolid& solid : ground.Solids()) {
    if (std::abs(solid.top - sole.z) < kSameHeight) {
      if (!solid.bears) continue;
      tops.push_back(&solid.polygon);
      double inside = kInfinity;
      for (Eigen::Index i = 0; i < solid.polygon.cols(); ++i) {
        const Vector2d a = solid.polygon.col(i);
        const Vector2d b = solid.polygon.col((i + 1) % solid.polygon.cols());
        for (const Vector2d& p : outline.colwise()) {
          const VectorIn<Curve> at = sole.X_WF * VectorOf<Curve>({p.x(), p.y(), 0.0});
          inside = std::min(inside, LeftOf(a, b, at));
        }
      }
      least = std::max(least, inside);
    } else if (solid.bottom < sole.z + kSameHeight && solid.top > sole.z) {
      in_the_way =
          std::min(in_the_way, FlatGap(PrismOver(solid.polygon), flat, sole.X_WF, demanded));
    }
  }
  // What is thinner than a gap may lie beyond a border, so more is asked for.
  const double more = demanded + 2.0 * kGap;
  if (least < demanded && tops.size() > 1 && Hold(tops, 0, Around(sole, outline, more))) {
    least = demanded;
  }
  return std::min(least, in_the_way);
}

}  // namespace

void AddStandingSoles(const WalkMotion& motion, const RobotModel& robot, const Scene& scene,
                      const verify::CertificateText& certificate, double from, ProofHints* hints,
                      TrajectoryCheck* check) {
  const std::vector<Standing> soles = StandingFrom(motion, from);
  const ConvexBody outline = PrismOver(robot.sole_outline);
  const auto add = [&](Kind kind, const std::string& what, const Standing& sole, double demanded,
                       const Kept& kept) {
    check->findings.push_back(
        {.kind = kind,
         .subject =
             Formatted("%s sole at %.3f s", sole.side == 0 ? "left" : "right", sole.at) + what,
         .proved = kept.bound > 0.0 && kept.bound >= demanded,
         .demanded = demanded,
         .least = kept.bound,
         .at = sole.at,
         .hint_missing = kept.hint_missing});
  };
  const double apart = certificate.demanded[verify::kNoStep];
  for (size_t k = 0; apart != verify::kNotDemanded && k < scene.no_step.size(); ++k) {
    for (const Standing& sole : soles) {
      add(Kind::kNoStep, Formatted(" - area %zu", k + 1), sole, apart,
          FromArea(PrismOver(scene.no_step[k]), outline, sole, apart, hints->told,
                   &hints->directions[{verify::kNoStep, sole.place, k}]));
    }
  }
  const double inside = certificate.demanded[verify::kFoothold];
  if (inside == verify::kNotDemanded || scene.ground->OnlyLevel()) return;
  for (const Standing& sole : soles) {
    add(Kind::kFoothold, "", sole, inside,
        {.bound = InsideLevel(sole, robot.sole_outline, *scene.ground, inside)});
  }
}

}  // namespace halfstep::checker
