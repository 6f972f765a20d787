#pragma once

#include <limits>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "smoothing/proof/certificate.h"
#include "smoothing/proof/feasibility_test.h"
#include "smoothing/proof/interval_statements.h"

namespace halfstep {

/// What of a walk is proved.
struct CertificationScope {
  double since = 0.0;  ///< nothing before this time of the walk [s]
  double until = std::numeric_limits<double>::infinity();  ///< nothing after it [s]
  /// All, unless told otherwise.
  std::vector<MarginFamily> families = [] {
    const auto all = AllMarginFamilies();
    return std::vector<MarginFamily>(all.begin(), all.end());
  }();
};

/// Decides for every instant of a span whether the demanded margins are kept. An interval is
/// settled by its midpoint and a bound on the motion around it, else bisected; what is still open
/// at the resolution is undecided. Feasible is a proof; violated has a witness; a walk that keeps
/// every margin with a little to spare is never undecided at a fine enough resolution. Intervals
/// are shared out among the scratch's workers; answer, rows and counts do not depend on how many.
/// Source: [Schwarzer2005]; bounds: smoothing/README.md, "Certificates".
class CertifiedFeasibility : public FeasibilityTest {
 public:
  /// Throws std::logic_error for options out of their ranges.
  CertifiedFeasibility(MarginEvaluator evaluator, const CertificationOptions& options)
      : CertifiedFeasibility(std::move(evaluator), options, CertificationScope{}) {}
  /// Proves no more than what is in `scope`.
  CertifiedFeasibility(MarginEvaluator evaluator, const CertificationOptions& options,
                       CertificationScope scope);

  Evidence evidence() const override { return Evidence::kCertified; }  ///< always kCertified
  std::string Description() const override;
  /// As given, or of Over().
  const MarginEvaluator& evaluator() const override { return evaluator_; }
  std::unique_ptr<FeasibilityTest> Over(const MarginEvaluator& evaluator) const override {
    return std::make_unique<CertifiedFeasibility>(evaluator, options_, scope_);
  }
  Feasibility Check(const SuperposedWalk& walk, const TimeSpan& span,
                    MarginEvaluator::Scratch* scratch) const override;

  /// Decides the whole walk and keeps the proof: `certificate` has the rows that were proved before
  /// the verdict was reached, which is the complete proof when feasible, sorted by begin, end and
  /// family. `stop` is polled before each interval; a proof that is stopped is undecided.
  Feasibility Certify(const SuperposedWalk& walk, MarginEvaluator::Scratch* scratch,
                      Certificate* certificate, const std::stop_token& stop = {}) const;

  const CertificationOptions& options() const { return options_; }  ///< as given
  /// How many statements a family has at every instant.
  int CountOf(MarginFamily family) const { return evaluator_.statements(family).count(); }

 private:
  struct Open;
  struct Settled;

  Feasibility Decide(const SuperposedWalk& walk, const TimeSpan& span,
                     MarginEvaluator::Scratch* scratch, Certificate* certificate,
                     const std::stop_token& stop) const;

  // Proves what it can of all `open` intervals, which keep what is still open. The first one that
  // is violated, or undecided at the resolution, or met when told to stop; their number: none.
  int ProveOpen(const SuperposedWalk& walk, const std::stop_token& stop, std::vector<Open>* open,
                MarginEvaluator::Scratch* scratch, bool with_rows,
                std::vector<Settled>* settled) const;

  MarginEvaluator evaluator_;
  CertificationOptions options_;
  CertificationScope scope_;
  IntervalStatements statements_;
  OpenGroups all_;  // of the scope
};

/// Extends a span on either side to the next knot (KnotsInside). A changed overlap moves knots,
/// and the intervals beside a moved knot are cut anew. Every check includes these, so a walk whose
/// spans were proved one after the other is proved as a whole, by the same intervals. A span
/// that begins and ends where half-steps begin, or the walk ends, is returned unchanged, since
/// intervals were cut anew only within it.
TimeSpan ExtendedToKnots(const SuperposedWalk& walk, const TimeSpan& span);

/// Instants strictly inside a span at which a foot lands or lifts off, starts or stops moving
/// horizontally, or a half-step begins or ends, in order [s].
std::vector<double> KnotsInside(const SuperposedWalk& walk, const TimeSpan& span);

}  // namespace halfstep
