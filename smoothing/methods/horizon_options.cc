#include "smoothing/methods/horizon.h"

namespace halfstep {

OptionGroup<HorizonOptions> HorizonGroup() {
  return {"horizon",
          "windows of `halfstep/horizon`; its program, variables and effort are those of "
          "`optimizer`"};
}

void DeclareFields(Fields& fields, HorizonOptions* o) {
  const auto half_steps = [&](const char* key, int* count, const char* meaning) {
    fields.Integer(key, count, {.meaning = meaning, .min = 2, .max = 1000});
    if (*count % 2 == 0) return;
    fields.Complain(key,
                    std::to_string(*count) + " is odd (valid: whole steps, two half-steps each)");
  };
  half_steps("window", &o->window, "half-steps that are moved together");
  half_steps("step", &o->step, "half-steps by which the next window lies further on");
  if (o->step > o->window) {
    fields.Complain("step", std::to_string(o->step) +
                                " leaves half-steps between windows (valid: up to `window`, " +
                                std::to_string(o->window) + ")");
  }
  fields.Integer(
      "passes", &o->passes,
      {.meaning = "over the walk at most; they end when nothing is gained", .min = 1, .max = 1000});
}

}  // namespace halfstep
