#include "planner/swept/swept_volume.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "wpg/check.h"

namespace halfstep {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

// Directions of the planes around a body: those of its faces, and of a cube's faces, edges and
// corners. One that is nearer than this to another is left out [cosine of 3°].
constexpr double kSameDirection = 0.9986;

// A body's mirror image may reach this far out of its twin: both get one region around [m].
constexpr double kSameBody = 1e-3;

// Placements stand for at most this long [s]: longer ones would all be inflated to the limit.
constexpr double kLongest = 0.008;

Eigen::Matrix3Xd Directions(const ConvexBody& body) {
  std::vector<Vector3d> all;
  const auto add = [&](const Vector3d& direction) {
    const bool near = std::any_of(all.begin(), all.end(), [&](const Vector3d& n) {
      return n.dot(direction) > kSameDirection;
    });
    if (!near) all.push_back(direction);
  };
  for (const Vector3d& normal : body.normals.colwise()) add(normal.normalized());
  for (int k = 0; k < 27; ++k) {
    if (k != 13) add(Vector3d(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1).normalized());
  }
  Eigen::Matrix3Xd directions(3, static_cast<Eigen::Index>(all.size()));
  for (size_t i = 0; i < all.size(); ++i) directions.col(static_cast<Eigen::Index>(i)) = all[i];
  return directions;
}

HalfSpaces MirrorImage(HalfSpaces region) {
  region.normals.row(1) *= -1.0;
  std::swap(region.lower.y(), region.upper.y());
  region.lower.y() *= -1.0;
  region.upper.y() *= -1.0;
  return region;
}

}  // namespace

SweptVolumeBaker::SweptVolumeBaker(const RobotModel& robot, const SweptVolumeOptions& options)
    : robot_(robot), options_(options), bounds_(robot) {
  HALFSTEP_CHECK(options.cell >= 1e-3 && options.cell <= 0.1, "cell = " << options.cell);
  HALFSTEP_CHECK(options.displacement > 0 && options.clearance >= 0 && options.clearance < 1.0 &&
                     options.shortest_interval > 0,
                 "displacement = " << options.displacement << ", clearance = " << options.clearance
                                   << ", shortest_interval = " << options.shortest_interval);
  for (const RobotBody& body : robot.bodies) {
    Outline outline{.normals = Directions(body.shape), .offsets = {}};
    outline.offsets.resize(outline.normals.cols());
    for (Eigen::Index i = 0; i < outline.normals.cols(); ++i) {
      outline.offsets[i] = Support(body.shape, outline.normals.col(i));
    }
    outlines_.push_back(std::move(outline));
  }
  for (size_t b = 0; b < outlines_.size(); ++b) outlines_[b].twin = FindTwin(b);
}

int SweptVolumeBaker::FindTwin(size_t body) const {
  const auto X_BLink = [&](const RobotBody& of) -> Isometry3d {
    if (of.leg < 0) return Isometry3d::Identity();
    return robot_.legs[static_cast<size_t>(of.leg)].joints[static_cast<size_t>(of.link)].X_BLink;
  };
  const RobotBody& own = robot_.bodies[body];
  const Isometry3d X_LinkB = X_BLink(own).inverse();
  int twin = -1;
  double least = kSameBody;
  for (size_t t = 0; t < robot_.bodies.size(); ++t) {
    const RobotBody& other = robot_.bodies[t];
    const int mirrored_leg = own.leg < 0 ? -1 : 1 - own.leg;
    if (other.leg != mirrored_leg || other.link != own.link) continue;
    HalfSpaces region{.normals = X_LinkB.inverse().linear() * outlines_[body].normals,
                      .offsets = {},
                      .lower = Vector3d::Zero(),
                      .upper = Vector3d::Zero()};
    region.offsets =
        outlines_[body].offsets + region.normals.transpose() * X_LinkB.inverse().translation();
    const Eigen::VectorXd before = region.offsets;
    AddMirrored({.body = t, .X_SBody = X_BLink(other)}, &region);
    const double out = (region.offsets - before).maxCoeff() - options_.clearance;
    if (out < least) {
      least = out;
      twin = static_cast<int>(t);
    }
  }
  return twin;
}

std::optional<std::vector<SweptVolumeBaker::Placement>> SweptVolumeBaker::Cover(
    const HalfStep& half_step, const Lipm& lipm) const {
  const HalfStepProfiles profiles(half_step.kind, half_step.shape, half_step.duration, lipm);
  const WalkState change = (half_step.End() - half_step.Start()).cwiseAbs();
  struct Task {
    double from, to;
    std::vector<size_t> bodies;
  };
  std::vector<size_t> everything(robot_.bodies.size());
  std::iota(everything.begin(), everything.end(), size_t{0});
  std::vector<Task> tasks = {{0.0, half_step.duration, std::move(everything)}};
  std::vector<Placement> placements;
  IntervalMotion motion;
  while (!tasks.empty()) {
    Task task = std::move(tasks.back());
    tasks.pop_back();
    const double mid = 0.5 * (task.from + task.to), width = task.to - task.from;
    const HalfStepJet sup = profiles.SecondBounds(task.from, task.to);
    WalkState second;
    for (int q = 0; q < kNumQuantities; ++q) second[q] = change[q] * sup.of(q).second;
    // A little wider, for the rounding of the interval's ends.
    bounds_.Bound(Evaluate(half_step, profiles, mid), second, 0.5 * width * (1 + 1e-9), &motion);
    const bool last = width <= options_.shortest_interval;
    if (motion.bounded && (width <= kLongest || last)) {
      std::erase_if(task.bodies, [&](size_t b) {
        const double displacement = motion.displacement[b];
        if (!(displacement <= options_.displacement) && !last) return false;
        placements.push_back({b, motion.posture.OfBody(robot_.bodies[b]), displacement, mid});
        return true;
      });
    } else if (!motion.bounded && last) {
      return std::nullopt;
    }
    if (task.bodies.empty()) continue;
    tasks.push_back({mid, task.to, task.bodies});
    tasks.push_back({task.from, mid, std::move(task.bodies)});
  }
  return placements;
}

double SweptVolumeBaker::Inflation(const Placement& placement) const {
  return options_.clearance + placement.displacement;
}

HalfSpaces SweptVolumeBaker::Inflated(const Placement& placement) const {
  const Outline& outline = outlines_[placement.body];
  const ConvexBody& shape = robot_.bodies[placement.body].shape;
  const double inflation = Inflation(placement);
  const Eigen::Matrix3d& R = placement.X_SBody.linear();
  const Vector3d& p = placement.X_SBody.translation();
  HalfSpaces region;
  region.normals = R * outline.normals;
  region.offsets = (outline.offsets + region.normals.transpose() * p).array() + inflation;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d direction = R.transpose().col(axis);
    region.upper[axis] = p[axis] + Support(shape, direction) + inflation;
    region.lower[axis] = p[axis] - Support(shape, -direction) - inflation;
  }
  return region;
}

void SweptVolumeBaker::AddMirrored(const Placement& placement, HalfSpaces* region) const {
  const ConvexBody& shape = robot_.bodies[placement.body].shape;
  const double inflation = Inflation(placement);
  const Eigen::DiagonalMatrix<double, 3> mirror(1, -1, 1);
  // The mirror image reaches as far along n as the body along the mirror image of n.
  const auto reach = [&](const Vector3d& n) {
    const Vector3d of = mirror * n;
    return of.dot(placement.X_SBody.translation()) +
           Support(shape, placement.X_SBody.linear().transpose() * of) + inflation;
  };
  for (Eigen::Index i = 0; i < region->normals.cols(); ++i) {
    region->offsets[i] = std::max(region->offsets[i], reach(region->normals.col(i)));
  }
  for (int axis = 0; axis < 3; ++axis) {
    region->upper[axis] = std::max(region->upper[axis], reach(Vector3d::Unit(axis)));
    region->lower[axis] = std::min(region->lower[axis], -reach(-Vector3d::Unit(axis)));
  }
}

std::optional<BoxTree> SweptVolumeBaker::Bake(const HalfStep& half_step, const Lipm& lipm) const {
  const auto placements = Cover(half_step, lipm), mirrored = Cover(half_step.Mirrored(), lipm);
  if (!placements || !mirrored) return std::nullopt;
  std::map<std::pair<size_t, double>, const Placement*> left;  // mirrored ones, by body and time
  for (const Placement& placement : *mirrored) {
    left[{placement.body, placement.time}] = &placement;
  }
  std::vector<HalfSpaces> regions;
  for (const Placement& placement : *placements) {
    regions.push_back(Inflated(placement));
    const int twin = outlines_[placement.body].twin;
    if (twin < 0) continue;
    const auto same = left.find({static_cast<size_t>(twin), placement.time});
    if (same == left.end()) continue;
    AddMirrored(*same->second, &regions.back());
    left.erase(same);
  }
  for (const auto& [key, placement] : left) regions.push_back(MirrorImage(Inflated(*placement)));
  if (regions.empty()) return BoxTree{};
  Vector3d lower = regions[0].lower, upper = regions[0].upper;
  for (const HalfSpaces& region : regions) {
    lower = lower.cwiseMin(region.lower);
    upper = upper.cwiseMax(region.upper);
  }
  VoxelGrid grid(lower, upper, options_.cell);
  for (const HalfSpaces& region : regions) grid.Fill(region);
  return BoxTree::Build(grid);
}

}  // namespace halfstep
