#include "experiments/config/half_step_config.h"

namespace halfstep {

void DeclareHalfStep(Fields& fields, HalfStepConfig* c) {
  fields.Number("duration_s", &c->duration,
                {.meaning = "T of an isolated half-step", .unit = "s", .min = 0.6, .max = 6});
  fields.Number("zmp_shift_s", &c->zmp_shift,
                {.meaning = "t2 − t1, the ZMP's shift, at that T: 0.01 … 0.5 of `duration_s`; a "
                            "footstep's own `duration_s` scales it",
                 .unit = "s",
                 .min = 0.02,
                 .max = 2});
  if (c->zmp_shift < 0.01 * c->duration || c->zmp_shift > 0.5 * c->duration) {
    fields.Complain("zmp_shift_s", "does not fit duration_s (valid: 0.01 … 0.5 of it)");
  }
  fields.Renamed("horizontal_delay", "foot_delay");
  fields.Renamed("support_offset_m", "support_point_m");
  fields.Number("via_height_m", &c->via_height,
                {.meaning = "height of the via point", .unit = "m", .min = 0.01, .max = 1});
  fields.Number("via_lateral_m", &c->via_lateral,
                {.meaning = "distance of the via point from the support sole's centre",
                 .unit = "m",
                 .min = 0.01,
                 .max = 1});
  fields.Number(
      "foot_delay", &c->foot_delay,
      {.meaning = "fraction of T between take-off (landing) and the foot's horizontal motion",
       .min = 0,
       .max = 0.2});
  fields.OptionalNumber(
      "zmp_bump_ramp", &c->zmp_bump_ramp,
      {.meaning =
           "fraction of the ZMP's bump in which it rises, and in which it falls; constant in "
           "between; from 0.5 on it has no flat top, and 1 or `none` is a round bump",
       .min = 0.1,
       .max = 1});
  fields.Number(
      "foot_ramp", &c->foot_ramp,
      {.meaning = "fraction of the foot's horizontal motion in which its speed rises, and "
                  "in which it falls; constant in between",
       .min = 0.1,
       .max = 0.5});
  fields.Number(
      "lift_share", &c->lift_share,
      {.meaning = "fraction of the foot's flight in which it rises, or sinks, next to the "
                  "floor",
       .min = 0.2,
       .max = 1});
  fields.Number("support_point_m", &c->support_point,
                {.meaning = "where CoM and ZMP rest on one foot: from the support sole's centre, "
                            "along its y, towards the other foot",
                 .unit = "m",
                 .min = -1,
                 .max = 1});
  const HalfStepShape as_always;
  fields.Number(
      "rise_begin", &c->rise_begin,
      {.meaning = "fraction of T after which the waist rises, where the swing foot stands "
                  "lower than the support foot; in a down half-step as long before its end",
       .min = 0,
       .max = 0.75,
       .left_out = as_always.rise_begin});
  fields.Number("rise_end", &c->rise_end,
                {.meaning = "fraction of T by which it has risen",
                 .min = 0.85,
                 .max = 1,
                 .left_out = as_always.rise_end});
  fields.Number(
      "crouch_m", &c->crouch,
      {.meaning = "how far the waist is kept below where the robot file has it; legs reach "
                  "further down steps then",
       .unit = "m",
       .min = 0,
       .max = 0.5,
       .left_out = as_always.crouch});
  fields.Misplaced("compensation", "is gone, since it made no walk shorter (leave it out)");
}

HalfStepShape ShapeOf(const HalfStepConfig& config) {
  return {.shift = config.zmp_shift / config.duration,
          .foot_delay = config.foot_delay,
          .bump_ramp = config.zmp_bump_ramp.value_or(1.0),
          .foot_ramp = config.foot_ramp,
          .lift_share = config.lift_share,
          .support_point = config.support_point,
          .rise_begin = config.rise_begin,
          .rise_end = config.rise_end,
          .crouch = config.crouch};
}

}  // namespace halfstep
