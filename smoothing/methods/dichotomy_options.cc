#include "smoothing/methods/dichotomy.h"

namespace halfstep {

OptionGroup<DichotomyOptions> DichotomyGroup() {
  return {"dichotomy", "options of the method `dichotomy`"};
}

void DeclareFields(Fields& fields, DichotomyOptions* o) {
  fields.Number("tolerance_s", &o->tolerance,
                {.meaning = "bisection of an overlap ends below this (published: 0.05)",
                 .unit = "s",
                 .min = 1e-6,
                 .max = 1});
  std::string order =
      o->order == DichotomyOptions::Order::kLeftToRight ? "left_to_right" : "right_to_left";
  fields.Text("order", &order,
              {.meaning = "of the junctions", .choices = {"left_to_right", "right_to_left"}});
  o->order = order == "left_to_right" ? DichotomyOptions::Order::kLeftToRight
                                      : DichotomyOptions::Order::kRightToLeft;
  fields.Integer("passes", &o->passes, {.meaning = "over all junctions", .min = 1, .max = 100});
  fields.Number("up_down_cap", &o->up_down_cap,
                {.meaning = "largest overlap as a fraction of its natural bound (published: 0.8)",
                 .min = 0,
                 .max = 1});
  fields.Number("down_up_cap", &o->down_up_cap,
                {.meaning = "largest overlap as a fraction of its natural bound (published: 0.76)",
                 .min = 0,
                 .max = 1});
}

}  // namespace halfstep
