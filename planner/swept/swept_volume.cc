#include "planner/swept/swept_volume.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "wpg/check.h"
#include "wpg/motion/half_step_tracks.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

// Directions of the planes around a body: those of its faces, and of a cube's faces, edges and
// corners. One that is nearer than this to another is left out [cosine of 3°].
constexpr double kSameDirection = 0.9986;

// A body's mirror image may reach this far out of its twin, and its link be this far from where
// that of the twin is: both get one region around [m].
constexpr double kSameBody = 1e-3;

// Placements stand for at most this long [s], but where a body moves so slowly that it stays within
// this share of the displacement allowed: longer ones would all be inflated to the limit.
constexpr double kLongest = 0.008;
constexpr double kSlow = 0.4;

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

Eigen::Affine3d Mirror() { return Eigen::Affine3d(Eigen::Scaling(1.0, -1.0, 1.0)); }

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
  for (size_t b = 0; b < outlines_.size(); ++b) twins_.push_back(FindTwin(b));
}

std::optional<SweptVolumeBaker::Twin> SweptVolumeBaker::FindTwin(size_t body) const {
  const auto X_BLink = [&](const RobotBody& of) -> Isometry3d {
    if (of.leg < 0) return Isometry3d::Identity();
    return Nth(Nth(robot_.legs, of.leg).joints, of.link).X_BLink;
  };
  const RobotBody& own = robot_.bodies[body];
  const Outline& outline = outlines_[body];
  std::optional<Twin> best;
  double least = kSameBody;
  for (size_t t = 0; t < robot_.bodies.size(); ++t) {
    const RobotBody& other = robot_.bodies[t];
    const int mirrored_leg = own.leg < 0 ? -1 : 1 - own.leg;
    if (other.leg != mirrored_leg || other.link != own.link) continue;
    Twin twin{.body = t,
              .X_LinkImage = X_BLink(own).inverse() * Mirror() * X_BLink(other),
              .offsets = Eigen::VectorXd(outline.offsets.size())};
    const Eigen::Matrix3d R_ImageLink = twin.X_LinkImage.linear().transpose();
    for (Eigen::Index i = 0; i < twin.offsets.size(); ++i) {
      const Vector3d n = outline.normals.col(i);
      twin.offsets[i] =
          n.dot(twin.X_LinkImage.translation()) + Support(other.shape, R_ImageLink * n);
    }
    twin.reach = (twin.X_LinkImage * other.shape.center).norm() + other.shape.radius;
    const double out = (twin.offsets - outline.offsets).maxCoeff();
    if (out < least) {
      least = out;
      best = std::move(twin);
    }
  }
  return best;
}

std::optional<std::vector<SweptVolumeBaker::Placement>> SweptVolumeBaker::Cover(
    const HalfStep& half_step, const MotionModel& model) const {
  const HalfStepTracks tracks(half_step, model);
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
    WalkState second = WalkState::Zero();
    tracks.AddSecondBounds(task.from, task.to, &second);
    // A little wider, for the rounding of the interval's ends.
    bounds_.Bound(tracks.At(mid), second, 0.5 * width * (1 + 1e-9), &motion);
    const bool last = width <= options_.shortest_interval;
    if (motion.bounded) {
      const double most = (width <= kLongest ? 1.0 : kSlow) * options_.displacement;
      std::erase_if(task.bodies, [&](size_t b) {
        const double displacement = motion.displacement[b];
        if (!(displacement <= most) && !last) return false;
        placements.push_back({b, motion.posture.OfBody(robot_.bodies[b]), displacement, mid});
        return true;
      });
    } else if (last) {
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

HalfSpaces SweptVolumeBaker::Bounds(const Placement& placement) const {
  const ConvexBody& shape = robot_.bodies[placement.body].shape;
  const double inflation = Inflation(placement);
  HalfSpaces bounds{.normals = {}, .offsets = {}, .lower = {}, .upper = {}};
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d direction = placement.X_SBody.linear().row(axis);
    const double at = placement.X_SBody.translation()[axis];
    bounds.upper[axis] = at + Support(shape, direction) + inflation;
    bounds.lower[axis] = at - Support(shape, -direction) - inflation;
  }
  return bounds;
}

HalfSpaces SweptVolumeBaker::Inflated(const Placement& placement) const {
  const Outline& outline = outlines_[placement.body];
  HalfSpaces region = Bounds(placement);
  region.normals = placement.X_SBody.linear() * outline.normals;
  region.offsets =
      (outline.offsets + region.normals.transpose() * placement.X_SBody.translation()).array() +
      Inflation(placement);
  return region;
}

bool SweptVolumeBaker::AddTwin(const Placement& placement, const Placement& twin,
                               HalfSpaces* region) const {
  const Twin& image = *twins_[placement.body];
  // How the placed image lies to where the twin says that it is, seen from this body's link.
  const Eigen::Affine3d moved = placement.X_SBody.inverse() * Mirror() * twin.X_SBody *
                                image.X_LinkImage.inverse(Eigen::Isometry);
  const double away = (moved.linear() - Eigen::Matrix3d::Identity()).norm() * image.reach +
                      moved.translation().norm();
  if (!(away < kSameBody)) return false;
  const double more = away + Inflation(twin) - Inflation(placement);
  const Eigen::VectorXd& offsets = outlines_[placement.body].offsets;
  region->offsets.array() += ((image.offsets - offsets).array() + more).max(0.0);
  const HalfSpaces bounds = MirrorImage(Bounds(twin));
  region->lower = region->lower.cwiseMin(bounds.lower);
  region->upper = region->upper.cwiseMax(bounds.upper);
  return true;
}

std::optional<SweptVolumeBaker::Covered> SweptVolumeBaker::CoverBoth(
    const HalfStep& half_step, const MotionModel& model) const {
  auto own = Cover(half_step, model), mirrored = Cover(half_step.Mirrored(), model);
  if (!own || !mirrored) return std::nullopt;
  return Covered{*std::move(own), *std::move(mirrored)};
}

BoxTree SweptVolumeBaker::TreeOf(const Covered& covered, double cell) const {
  std::map<std::pair<size_t, double>, const Placement*> left;  // mirrored ones, by body and time
  for (const Placement& placement : covered.mirrored) {
    left[{placement.body, placement.time}] = &placement;
  }
  std::vector<HalfSpaces> regions;
  for (const Placement& placement : covered.own) {
    regions.push_back(Inflated(placement));
    const std::optional<Twin>& twin = twins_[placement.body];
    if (!twin) continue;
    const auto same = left.find({twin->body, placement.time});
    if (same == left.end()) continue;
    if (AddTwin(placement, *same->second, &regions.back())) left.erase(same);
  }
  for (const auto& [key, placement] : left) regions.push_back(MirrorImage(Inflated(*placement)));
  if (regions.empty()) return BoxTree{};
  Vector3d lower = regions[0].lower, upper = regions[0].upper;
  for (const HalfSpaces& region : regions) {
    lower = lower.cwiseMin(region.lower);
    upper = upper.cwiseMax(region.upper);
  }
  VoxelGrid grid(lower, upper, cell);
  for (const HalfSpaces& region : regions) grid.Fill(region);
  return BoxTree::Build(grid);
}

std::optional<BoxTree> SweptVolumeBaker::Bake(const HalfStep& half_step,
                                              const MotionModel& model) const {
  const auto covered = CoverBoth(half_step, model);
  if (!covered) return std::nullopt;
  return TreeOf(*covered, options_.cell);
}

std::optional<SweptVolumeBaker::Parts> SweptVolumeBaker::BakeParts(const HalfStep& half_step,
                                                                   const MotionModel& model) const {
  const auto covered = CoverBoth(half_step, model);
  if (!covered) return std::nullopt;
  const auto part = [&](double cell, const auto& holds) {
    Covered some;
    for (const Placement& placement : covered->own) {
      if (holds(robot_.bodies[placement.body], half_step.swing())) some.own.push_back(placement);
    }
    for (const Placement& placement : covered->mirrored) {
      if (holds(robot_.bodies[placement.body], half_step.support)) {
        some.mirrored.push_back(placement);
      }
    }
    return TreeOf(some, cell);
  };
  const auto on_foot = [](const RobotBody& body) { return body.link == 5; };
  const double foot = FootCell(options_.cell);
  return Parts{
      .rest = part(options_.cell, [&](const RobotBody& body, Side) { return !on_foot(body); }),
      .swing = part(foot, [&](const RobotBody& body,
                              Side swing) { return on_foot(body) && body.leg == Index(swing); }),
      .stand = part(foot, [&](const RobotBody& body, Side swing) {
        return on_foot(body) && body.leg != Index(swing);
      })};
}

}  // namespace halfstep
