#pragma once

#include <array>
#include <span>

#include "wpg/geometry/pose2.h"

namespace halfstep::verify {

/// The columns of half_steps.csv that are there when half-steps have forms of their own, or
/// footsteps are moved. Source: wpg/README.md, "Half-step".
struct FormColumns {
  /// How far aside of the support sole's centre the via point is, towards the swing foot [m].
  double via_lateral = 0;
  /// Of the foot's horizontal motion, of T, of the foot's flight.
  double foot_ramp = 0, foot_delay = 0, lift_share = 0;
  double via_along = 0;                     ///< how far ahead of that centre [m]
  double zmp_shift = 0, zmp_bump_ramp = 0;  ///< of T; of the bump
  Pose2 footstep = {};  ///< the step's, seen from where it is planned; as planned without columns
  /// When the waist rises in an up half-step, of T; in a down one as long before its end. They are
  /// in tables of walks over levels only.
  double rise_begin = 0.525, rise_end = 1;
};

/// What verify knows by itself of a column of forms: a row for each but the footsteps'.
struct FormColumn {
  const char* name;            ///< in smoothing.fixed
  const char* key;             ///< in configs, of the flag that lets methods move it
  const char* column;          ///< in half_steps.csv
  double FormColumns::*value;  ///< where it is kept
  double least, most;          ///< what makes sense
  const char *before, *after;  ///< words around a value that does not
  const char* differs;         ///< what a step's half-steps must not have; null: each has its own

  /// Whether both half-steps of a step share it.
  bool of_step() const { return differs != nullptr; }
};

/// In the order of the columns; the footsteps' are before the last two.
inline constexpr std::array<FormColumn, 9> kAllFormColumns = {{
    {"via_lateral", "via_laterals", "via_lateral_m", &FormColumns::via_lateral, 0.01, 1,
     "via point at ", "", "another via point"},
    {"foot_ramp", "foot_ramps", "foot_ramp", &FormColumns::foot_ramp, 0.1, 0.5, "foot ramp ", "",
     nullptr},
    {"foot_delay", "foot_delays", "foot_delay", &FormColumns::foot_delay, 0, 0.2, "foot delay ", "",
     nullptr},
    {"lift_share", "lift_shares", "lift_share", &FormColumns::lift_share, 0.2, 1, "lift share ", "",
     nullptr},
    {"via_along", "via_alongs", "via_along_m", &FormColumns::via_along, -0.5, 0.5, "via point ",
     " ahead", "a via point elsewhere along"},
    {"zmp_shift", "zmp_shifts", "zmp_shift", &FormColumns::zmp_shift, 0.01, 0.5, "ZMP's shift ", "",
     nullptr},
    {"zmp_bump_ramp", "zmp_bump_ramps", "zmp_bump_ramp", &FormColumns::zmp_bump_ramp, 0.1, 1,
     "ZMP's bump ramp ", "", nullptr},
    {"rise_begin", "heights", "rise_begin", &FormColumns::rise_begin, 0, 0.75, "rise begin ", "",
     nullptr},
    {"rise_end", "heights", "rise_end", &FormColumns::rise_end, 0.85, 1, "rise end ", "", nullptr},
}};
/// Those of any walk whose half-steps have forms of their own, and those of walks over levels.
inline constexpr auto kFormColumns = std::span(kAllFormColumns).first<7>();
/// The latter.
inline constexpr auto kRiseColumns = std::span(kAllFormColumns).last<2>();

}  // namespace halfstep::verify
