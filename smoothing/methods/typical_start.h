#pragma once

#include <span>
#include <string_view>

#include "smoothing/walk/parameter_table.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// What half-steps of fast walks look like: medians over walks that long searches found, of HRP-2
/// under the limits of its robot file and the default margins. Source: smoothing/README.md,
/// "Typical forms", with the script that measures them.
struct TypicalForm {
  std::string_view name;  ///< "level"
  double duration;        ///< T [s], scaled by √z_c
  double up_down;         ///< Δ of its natural bound, from up to down
  double down_up;         ///< the same from down to up
  double height_scale;    ///< η
  double support_point;   ///< [m], scaled by the standing width, as the next
  double via_lateral;     ///< [m]
  double via_along;       ///< [m], scaled by the leg
  double foot_ramp, foot_delay, lift_share, zmp_shift, zmp_bump_ramp;  ///< as in HalfStepShape
};

/// All of them. The first is that of level ground, the last the slowest and highest.
std::span<const TypicalForm> TypicalForms();

/// The form for a step: by how it turns, goes aside or back, and whether its foot is planned to
/// pass over something.
const TypicalForm& FormOfStep(const HalfStepSequence& sequence, int step);

/// A point near which fast walks are: each step in its typical form, or in `form` where that is not
/// null, as far as the table's ranges allow; what is fixed stays. Nothing is proved of it.
HomotopyParameters TypicalStart(const HalfStepSequence& sequence, const ParameterTable& table,
                                const RobotModel& robot, const TypicalForm* form = nullptr);

}  // namespace halfstep
