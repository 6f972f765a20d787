#pragma once

#include <utility>
#include <vector>

namespace halfstep {

/// What each row of a half-step and family keeps in reserve [of a slack's scale], > 0, for what
/// lies between the instants that are watched and for what no proof can decide. It grows where a
/// candidate needed more of it, and shrinks after candidates that were proved, so that one place
/// that is hard to prove costs no time elsewhere. Source: smoothing/README.md, "Overlap program".
class RowReserves {
 public:
  /// What a candidate shows, by half-step and family (half-step·families + family).
  struct Seen {
    std::vector<double> rows;     ///< the least of the rows, which have the reserve taken off
    std::vector<double> samples;  ///< the least slack between the instants, too
  };
  using Place = std::pair<int, int>;  ///< half-step, and family by the order of its rows

  /// For `families` rows in each of `half_steps`; all keep `reserve`.
  RowReserves(int half_steps, int families, double reserve);

  /// Of the rows of a half-step and family [of a slack's scale].
  double of(int half_step, int family) const { return reserves_[Index({half_step, family})]; }
  void SetAll(double reserve);  ///< everywhere the same; what was refused is forgotten

  /// After a candidate that was proved but at the places `refused`, one a half-step at most; or,
  /// unless it was `tried`, that was only sampled. Where the solver kept a row, reserve and all,
  /// and yet something between the instants is violated or was refused, the reserve grows. Where
  /// the solver did not keep it more would not help. If all is proved, all shrink, but not down to
  /// what was refused before.
  void Learn(const Seen& seen, const std::vector<Place>& refused, bool tried);

 private:
  size_t Index(Place place) const {
    return static_cast<size_t>(place.first) * static_cast<size_t>(families_) +
           static_cast<size_t>(place.second);
  }

  int families_;
  std::vector<double> reserves_;
  std::vector<double> least_;  // that a reserve shrinks to
};

}  // namespace halfstep
