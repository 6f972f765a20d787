#pragma once

#include <limits>
#include <vector>

namespace halfstep {

/// Tells from what the rounds of a search gain when it is over. Source: smoothing/README.md,
/// "The search".
class SearchPace {
 public:
  /// Of a search of at most `rounds` rounds, of which `poor_rounds` in a row may gain next to
  /// nothing.
  SearchPace(int rounds, int poor_rounds) : rounds_(rounds), poor_rounds_(poor_rounds) {}

  /// Whether `after` is less than `before` by more than next to nothing: 10⁻³ of it.
  static bool Gained(double before, double after);

  /// After a round at whose end the solver's point costs `end`, while the incumbent's cost went
  /// from `before` to `after`. A round is poor that gains nothing for either, unless the solver's
  /// point would be a gain and waits for its proof.
  void Note(double end, double before, double after);

  /// All rounds were used.
  bool exhausted() const { return static_cast<int>(ends_.size()) >= rounds_; }
  /// No round is to follow: none is left, too many were poor, or the incumbent is out of reach at
  /// the pace of the last rounds.
  bool over() const { return exhausted() || poor_ >= poor_rounds_ || out_of_reach_; }
  int poor() const { return poor_; }  ///< poor rounds in a row

 private:
  int rounds_, poor_rounds_;
  int poor_ = 0;
  bool out_of_reach_ = false;
  std::vector<double> ends_;                                // of the rounds
  double least_ = std::numeric_limits<double>::infinity();  // of these
};

}  // namespace halfstep
