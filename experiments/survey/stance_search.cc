#include "experiments/survey/stance_search.h"

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "experiments/config/experiment.h"
#include "experiments/config/scaled_defaults.h"
#include "experiments/survey/arm_posture.h"
#include "experiments/survey/self_gaps.h"
#include "experiments/survey/support_search.h"
#include "experiments/survey/touching_neighbours.h"
#include "wpg/files/input_error.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"
#include "wpg/robot/robot_legs.h"
#include "wpg/robot/robot_measures.h"
#include "wpg/robot/torque_limits.h"

namespace halfstep {
namespace {

constexpr double kFeetApart = 0.05;  // bodies of HRP-2's feet, standing [m]
// Of the swing foot, of the leg's length. For more, knees would have to be straighter: legs get
// stiffer then, and a foot that lands early tips the robot (notebooks-data/measurements.md, "Robots
// from their URDF").
constexpr double kLeastLift = 0.07;
constexpr double kTorquePeriod = 0.002;  // [s]
constexpr int kParts = 8;                // of a mesh whose hull touches what it should not

// The least margin of a leg joint's torque in six steps, sampled [N m]; +∞ where nothing is known
// of torques. Instants at which a leg does not reach say nothing of them.
double LeastTorqueMargin(const RobotModel& robot) {
  if (!TorqueFault(robot).empty()) return std::numeric_limits<double>::infinity();
  return LeastInSixSteps(robot, MarginFamily::kTorque, kTorquePeriod, false);
}

class StanceSearch {
 public:
  StanceSearch(const StanceRequest& request, const std::array<Leg, 2>& legs,
               const std::vector<RobotBody>& bodies, RobotDraft* draft)
      : request_(request), legs_(legs), bodies_(bodies), draft_(*draft) {}

  RobotModel Search() {
    TakeNarrowest();
    Bend();
    Stand();
    CutMeshes();
    const double narrowest = draft_.standing.width;
    const bool may_widen = request_.width == 0.0;
    Found best = LiftLess();
    const double before = best.apart;
    for (int wider = 1; may_widen && best.apart < NearByDesign(best.model) && wider <= 5; ++wider) {
      RobotDraft narrower = draft_;
      draft_.standing.width = narrowest * (1 + 0.1 * wider);
      draft_.why_width = Formatted("%.3f m apart, a body ", narrowest) + NearnessText(before) +
                         " another one in six steps";
      Stand();
      Found found = LiftLess();
      if (found.apart > best.apart) {
        best = std::move(found);
      } else {
        draft_ = std::move(narrower);
      }
    }
    Support(&best.model);
    return best.model;
  }

 private:
  struct Found {
    RobotModel model;
    double apart = 0.0;  // at most NearByDesign [m]
  };

  void TakeNarrowest() {
    StandingRequest& standing = draft_.standing;
    standing.width = request_.width;
    draft_.why_width = "as asked for";
    if (request_.width > 0.0) return;
    const double apart = kFeetApart * StretchedLength(legs_[0]) / 0.6;
    standing.width = NarrowestStance(legs_, draft_.soles, bodies_, apart);
    draft_.why_width = standing.width > NarrowestStance(legs_, draft_.soles, {}, 0.0) + 1e-9
                           ? Formatted("so the feet are %.0f mm apart", 1e3 * apart)
                           : "as with straight legs";
  }

  // Bends the knees less while the joints' limits keep the swing foot low, or the joints give too
  // little torque; but not so little that legs no longer reach in six steps.
  void Bend() {
    StandingRequest& standing = draft_.standing;
    if (request_.bend > 0.0) {
      standing.bend = request_.bend;
      return;
    }
    // Less bend than the first that makes a robot; where none does, more.
    double best = 0.9, highest = -1.0;
    bool best_reaches = false;
    std::optional<InputError> refusal;
    for (const double bend : {0.9, 0.92, 0.94, 0.96, 0.98, 0.87, 0.84, 0.8, 0.75}) {
      if (bend < 0.9 && highest >= 0.0) break;
      standing.bend = bend;
      if (!TryToStand().empty()) continue;
      std::optional<RobotModel> model;
      try {
        model = ModelOf(draft_, RobotParts::kLegs);
      } catch (const InputError& error) {  // too near to a singularity, say
        if (!refusal) refusal = error;
        continue;
      }
      const RobotMeasures measures = MeasuresOf(*model);
      const bool high_enough = measures.lift >= kLeastLift * measures.leg_length;
      if (highest >= kLeastLift * measures.leg_length && !high_enough) break;
      const bool reaches = IsWithinReach(*model, SixSteps(*model, DefaultHalfStep(*model)));
      if (best_reaches && !reaches) break;
      const double torque = LeastTorqueMargin(*model);
      const bool strong_enough = torque >= 0.0;
      if (measures.lift > highest || strong_enough || (reaches && !best_reaches)) {
        highest = measures.lift;
        best = bend;
        best_reaches = reaches;
      }
      if (high_enough && strong_enough) break;
      draft_.why_bend =
          high_enough ? Formatted("with more bend a joint lacks %.1f N m in six steps", -torque)
                      : "with more bend the joints' limits keep the swing foot lower";
    }
    if (highest < 0.0 && refusal) throw InputError(*refusal);
    standing.bend = best;
    if (best < 0.9) draft_.why_bend = "with less bend a leg is too near to a singularity";
    if (best == 0.9) draft_.why_bend.clear();
  }

  // The pairs that come too near to each other in six steps, and are no neighbours.
  std::vector<SelfGap> StrangersThatTouch(const RobotModel& model) const {
    const std::vector<bool> of_limb =
        BodiesOfLimbs(draft_.urdf, draft_.legs.waist, draft_.posture, model);
    std::vector<SelfGap> gaps = SelfGaps(model, WalkedPostures(model)).Nearer(NearByDesign(model));
    std::erase_if(gaps, [&](const SelfGap& gap) {
      if (Nth(of_limb, gap.a) || Nth(of_limb, gap.b)) return true;
      return !AreOfBothLegs(model, gap) &&
             LegJointsBetween(draft_.urdf, draft_.legs, model, gap) <= 2;
    });
    return gaps;
  }

  using LinkPair = std::array<std::string, 2>;

  static LinkPair LinksOf(const RobotModel& model, const SelfGap& gap) {
    return {LinkOf(Nth(model.bodies, gap.a)), LinkOf(Nth(model.bodies, gap.b))};
  }

  // Of these gaps, the links, not of both legs, whose bodies stand so near that they touch by
  // design: NeighboursThatTouch excludes the links, with all of their bodies.
  static std::set<LinkPair> TouchingByDesign(const RobotModel& model,
                                             const std::vector<SelfGap>& gaps) {
    const double near = NearByDesign(model);
    std::set<LinkPair> links;
    for (const SelfGap& gap : gaps) {
      if (!AreOfBothLegs(model, gap) && gap.standing < near) {
        links.insert(LinksOf(model, gap));
      }
    }
    return links;
  }

  // Meshes of strangers that touch become several convex parts, where that takes any of them apart.
  void CutMeshes() {
    std::map<LinkPair, double> touching;  // and their least gap [m]
    const RobotModel whole = ModelOf(draft_);
    for (const SelfGap& gap : StrangersThatTouch(whole)) {
      const auto [known, is_new] = touching.emplace(LinksOf(whole, gap), gap.least);
      known->second = std::min(known->second, gap.least);
    }
    const auto cut = [&](const LinkPair& links, double gap) {
      for (const size_t i : {size_t{0}, size_t{1}}) {
        if (!HasMesh(Nth(draft_.urdf.links, draft_.urdf.FindLink(links[i])))) continue;
        draft_.mesh_parts[links[i]] = kParts;
        draft_.why_parts[links[i]] =
            "as one hull it " + NearnessText(gap) + " " + links[1 - i] + " in six steps";
      }
    };
    for (const auto& [links, gap] : touching) cut(links, gap);
    if (draft_.mesh_parts.empty()) return;
    const RobotModel all_cut = ModelOf(draft_);
    const std::set<LinkPair> by_design = TouchingByDesign(all_cut, StrangersThatTouch(all_cut));
    draft_.mesh_parts.clear();
    for (const auto& [links, gap] : touching) {
      if (!by_design.contains(links)) cut(links, gap);
    }
  }

  // Lifts the swing foot less while bodies touch; the best that was found.
  Found LiftLess() {
    draft_.lift.reset();
    RobotModel model = ModelOf(draft_);
    const double planned = MeasuresOf(model).lift, via = DefaultHalfStep(model).via_height;
    Found best;
    for (const double share : {1.0, 0.9, 0.8, 0.7, 0.6}) {
      model.largest_lift = share == 1.0 ? planned : share * via;
      std::vector<SelfGap> gaps = StrangersThatTouch(model);
      const std::set<LinkPair> by_design = TouchingByDesign(model, gaps);
      std::erase_if(gaps,
                    [&](const SelfGap& gap) { return by_design.contains(LinksOf(model, gap)); });
      double apart = NearByDesign(model);
      const SelfGap* nearest = nullptr;
      for (const SelfGap& gap : gaps) {
        if (gap.least < apart) {
          apart = gap.least;
          nearest = &gap;
        }
      }
      if (share == 1.0 || apart > best.apart) {
        best = {model, apart};
        if (share < 1.0) draft_.lift = model.largest_lift;
      }
      if (nearest == nullptr) break;
      if (share == 1.0) {
        const LinkPair links = LinksOf(model, *nearest);
        draft_.why_lift = Formatted("Lifted by %.3f m, ", via) + links[1] + " " +
                          NearnessText(apart) + " " + links[0] + ".";
      }
    }
    return best;
  }

  // Moves the support points where the whole robot's ZMP would come too near to the soles' edges,
  // or a joint lack torque.
  void Support(RobotModel* model) {
    const FoundSupport found = FindSupport(*model);
    if (found.offset == 0.0) return;
    draft_.support_point = model->support_point = found.offset;
    draft_.why_support =
        found.missed == MarginFamily::kTorque
            ? Formatted(
                  "Where the soles' centres carry, a joint has %.1f N m left of its torque in "
                  "six steps; so %.1f N m.",
                  found.before, found.after)
            : Formatted(
                  "Where the soles' centres carry, the robot's ZMP is %.1f mm inside the "
                  "support polygon in six steps; so %.1f mm.",
                  1e3 * found.before, 1e3 * found.after);
  }

  void Stand() {
    if (const std::string fault = TryToStand(); !fault.empty()) {
      throw InputError({draft_.urdf.file + ": " + fault});
    }
  }

  // Finds the legs' angles; "" or why there are none.
  std::string TryToStand() {
    StandingRequest& standing = draft_.standing;
    // The CoM moves with the legs: a few rounds are enough.
    for (int round = 0; round < 4; ++round) {
      standing.x = ComAhead();
      // Both soles are level with each other: the shorter leg is bent as asked for.
      const auto left = StandingHeight(legs_[0], Side::kLeft, standing);
      const auto right = StandingHeight(legs_[1], Side::kRight, standing);
      for (const Side side : {Side::kLeft, Side::kRight}) {
        const auto q = left && right
                           ? FindStanding(Nth(legs_, side), side, standing, std::max(*left, *right))
                           : std::nullopt;
        if (!q) {
          const std::string joint = left && right ? JointInTheWay(Nth(legs_, side), side, standing,
                                                                  std::max(*left, *right))
                                                  : "";
          return Formatted(
                     "the %s foot cannot stand level below the CoM, %.3f m from the other, hip and "
                     "ankle %.0f %% of the stretched leg apart, within the joints' limits",
                     side == Side::kLeft ? "left" : "right", standing.width, 100 * standing.bend) +
                 (joint.empty() ? "" : ": " + joint) + " (valid: another --bend or --width)";
        }
        for (size_t k = 0; k < 6; ++k) {
          Nth(draft_.posture, Nth(draft_.legs.joints, side)[k]) =
              (*q)[static_cast<Eigen::Index>(k)];
        }
      }
    }
    return "";
  }

  // The CoM ahead of the waist in the present posture [m].
  double ComAhead() const {
    const std::vector<Eigen::Isometry3d> X = draft_.urdf.LinkPoses(draft_.posture);
    const Eigen::Isometry3d X_BRoot = Nth(X, draft_.legs.waist).inverse();
    double mass = 0.0, moment = 0.0;
    for (size_t i = 0; i < X.size(); ++i) {
      mass += draft_.urdf.links[i].mass;
      moment += draft_.urdf.links[i].mass * (X_BRoot * X[i] * draft_.urdf.links[i].com).x();
    }
    return mass > 0 ? moment / mass : 0.0;
  }

  const StanceRequest request_;
  const std::array<Leg, 2>& legs_;
  const std::vector<RobotBody>& bodies_;
  RobotDraft& draft_;
};

ExperimentConfig DefaultConfig(const RobotModel& robot) {
  ExperimentConfig config;
  ScaleDefaults(MeasuresOf(robot), &config);
  return config;
}

}  // namespace

HalfStep DefaultHalfStep(const RobotModel& robot) { return PrototypeOf(DefaultConfig(robot)); }

MarginLimits DefaultLimits(const RobotModel& robot) {
  return DefaultConfig(robot).smoothing.limits;
}

std::vector<Posture> WalkedPostures(const RobotModel& robot) {
  return SampledPostures(robot, SixSteps(robot, DefaultHalfStep(robot)));
}

RobotModel StandApart(const StanceRequest& request, const std::array<Leg, 2>& legs,
                      const std::vector<RobotBody>& bodies, RobotDraft* draft) {
  return StanceSearch(request, legs, bodies, draft).Search();
}

}  // namespace halfstep
