#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "experiments/config/experiment.h"
#include "experiments/config/half_step_config.h"
#include "experiments/run/crossing.h"
#include "smoothing/margins/margin_evaluator.h"
#include "smoothing/margins/work.h"
#include "smoothing/proof/certified_feasibility.h"

namespace halfstep {

/// How well forms of half-steps do on crossings, at eleven instants of each: only what Proves()
/// says is proved. To be asked by one thread.
class CrossingFit {
 public:
  /// Robot and demands are the config's, obstacles and ground those of `scene`.
  CrossingFit(const ExperimentConfig& config, const RobotModel& robot, const Scene& scene,
              std::vector<Crossing> crossings);

  const std::vector<Crossing>& crossings() const { return crossings_; }  ///< those that are left
  double Highest() const;  ///< the largest difference of height that they have [m]
  void Drop(int kind);     ///< leaves crossings of a kind out from now on

  /// What a form does on the crossings of one kind.
  struct OfKind {
    double fit = 0.0;    ///< 1: a tenth of the crossings or more keep all; below 0: none does
    Margin missed = {};  ///< of the best crossing, where none does
    const Crossing* of = nullptr;  ///< that crossing
  };
  /// By kind. Where none keeps all, `fit` is 0, and Nearest() tells how near one comes.
  std::map<int, OfKind> Fit(const HalfStepConfig& form);
  /// How many of all crossings keep all [1].
  double Share(const HalfStepConfig& form);
  /// How near the best of the first `looked` crossings of a kind is to keeping all; `of` is null
  /// where the foot does not rise to the other level.
  OfKind Nearest(const HalfStepConfig& form, int kind, int looked = 16);
  /// Whether some crossing of those that a form keeps at these instants is certified for all t, of
  /// the first four.
  bool Proves(const HalfStepConfig& form);
  /// The landings, seen from a left support, of the crossings that a form keeps at these instants;
  /// each once.
  std::vector<Foothold> Landings(const HalfStepConfig& form);
  Work work() const { return scratch_.work; }  ///< of all answers so far
  /// "clearance of left_foot to 'bar': …".
  std::string Describe(const Margin& margin) const { return evaluator_.Describe(margin); }

 private:
  // Calls visit(walk) of a step in place of either foot, which moves down as it moves up, in
  // reverse: so of the half-steps down to the landing and up from it. Until it says stop.
  void EachStep(const HalfStepConfig& form, const Crossing& crossing,
                const std::function<bool(const SuperposedWalk&)>& goes_on) const;
  // Calls visit(walk, t) at instants of these half-steps, until it says stop.
  void Visit(const HalfStepConfig& form, const Crossing& crossing,
             const std::function<bool(const SuperposedWalk&, const LocalTime&)>& goes_on);
  bool Keeps(const HalfStepConfig& form, const Crossing& crossing);
  // The least slack of a crossing, and its margin.
  std::pair<double, Margin> SlackOf(const HalfStepConfig& form, const Crossing& crossing);

  MarginEvaluator evaluator_;
  CertifiedFeasibility certified_;
  MarginEvaluator::Scratch scratch_;
  std::vector<Crossing> crossings_;
};

}  // namespace halfstep
