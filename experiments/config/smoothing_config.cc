#include "experiments/config/smoothing_config.h"

#include <algorithm>
#include <utility>

#include "smoothing/margins/family_traits.h"
#include "smoothing/methods/solver_method_options.h"
#include "wpg/files/number_text.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

void DeclareFixed(Fields& fields, FixedConfig* c) {
  std::vector<std::string> names;
  for (const ParameterFamily family : AllParameterFamilies()) {
    names.emplace_back(Traits(family).name);
  }
  fields.Text("parameter", &c->parameter,
              {.meaning = "which kind of them", .required = true, .choices = names});
  fields.Integer("index", &c->index,
                 {.meaning = "of its junction, step or half-step, from 1", .min = 1, .max = 20000});
  fields.OptionalNumber(
      "value", &c->value,
      {.meaning = "s (an overlap below 0 is a rest), of the planned height, or m; none: as planned",
       .min = -kLongestRest,
       .max = 6});
}

void DeclareGiven(Fields& fields, GivenWalkFiles* files) {
  fields.Text("overlaps", &files->overlaps,
              {.meaning = "path of a table like overlaps.csv, one row a junction",
               .otherwise = "as planned"});
  fields.Text("half_steps", &files->half_steps,
              {.meaning = "path of a table like half_steps.csv, one row a half-step",
               .otherwise = "as planned"});
  if (files->overlaps.empty() && files->half_steps.empty()) {
    fields.Complain("", "no table is named (valid: `overlaps`, `half_steps` or both)");
  }
}

// What the profile that the file names says otherwise than the one before becomes what it says,
// scaled to the robot as before; the rest stays.
void TakeProfile(DemandProfile before, DemandProfile now, MarginLimits* limits) {
  const MarginLimits was = LimitsOf(before), is = LimitsOf(now);
  for (const MarginFamily family : AllMarginFamilies()) {
    const double from = was.demanded_of(family), to = is.demanded_of(family);
    if (from == to) continue;
    double& demanded = limits->demanded_of(family);
    demanded = from > 0.0 && to > 0.0 ? Shortened(to * (demanded / from), 3) : to;
  }
  if (was.foot_speed != is.foot_speed) limits->foot_speed = is.foot_speed;
  if (was.foot_yaw_rate != is.foot_yaw_rate) limits->foot_yaw_rate = is.foot_yaw_rate;
}

void DeclareProfile(Fields& fields, SmoothingConfig* c) {
  std::vector<std::string> names;
  for (const DemandProfile profile : kDemandProfiles) names.emplace_back(Name(profile));
  const std::string before = c->profile;
  fields.Text("profile", &c->profile,
              {.meaning = "what is demanded without further keys: `walkable`, what a robot needs; "
                          "`limit`, what physics allows; `paper`, what the source paper asked",
               .choices = names});
  const auto of = [](const std::string& name) {
    return std::ranges::find(kDemandProfiles, name, [](DemandProfile p) { return Name(p); });
  };
  const auto was = of(before), is = of(c->profile);
  if (was == is || was == kDemandProfiles.end() || is == kDemandProfiles.end()) return;
  TakeProfile(*was, *is, &c->limits);
}

void DeclareLimits(Fields& fields, SmoothingConfig* c) {
  MarginLimits* const l = &c->limits;
  fields.OptionalNumber("foot_speed_m_s", &l->foot_speed,
                        {.meaning = "of the swing sole's centre; none: no limit",
                         .unit = "m/s",
                         .min = 0.01,
                         .max = 20});
  fields.OptionalNumber(
      "foot_yaw_rate_rad_s", &l->foot_yaw_rate,
      {.meaning = "of the swing sole; none: no limit", .unit = "rad/s", .min = 0.01, .max = 50});
  fields.Number("joint_speed_scale", &l->joint_speed_scale,
                {.meaning = "fraction of the robot's joint speed limits", .min = 0.01, .max = 1});
  fields.OptionalNumber("joint_acceleration_rad_s2", &c->assumed_acceleration,
                        {.meaning = "assumed of the legs' joints of which the robot file states "
                                    "none; none: nothing is assumed",
                         .unit = "rad/s²",
                         .min = 1e-3,
                         .max = 1e5,
                         .none_left_out = true});
  fields.OptionalNumber("landing_speed_m_s", &l->landing_speed,
                        {.meaning = "how fast the sole sinks in its last centimetre; none: no "
                                    "limit",
                         .unit = "m/s",
                         .min = 0.01,
                         .max = 20,
                         .none_left_out = true});
}

void DeclareMargins(Fields& fields, MarginLimits* l) {
  for (const MarginFamily family : FamiliesWith(l->own)) {
    const FamilyTraits& traits = Traits(family);
    const NumberSpec spec{
        .meaning = traits.meaning.data(),
        .unit = traits.unit == "1" ? "" : traits.unit.data(),
        .min = 0,
        .max = traits.most,
        .left_out = traits.may_be_absent ? std::optional(traits.demanded) : std::nullopt,
        .none_left_out = traits.may_be_absent && traits.demanded == kNotDemanded};
    double& demanded = l->demanded_of(family);
    if (!traits.may_be_none) {
      fields.Number(traits.key.data(), &demanded, spec);
      continue;
    }
    std::optional<double> or_none;
    if (demanded != kNotDemanded) or_none = demanded;
    fields.OptionalNumber(traits.key.data(), &or_none, spec);
    demanded = or_none.value_or(kNotDemanded);
  }
}

void DeclareGroups(Fields& fields, const std::vector<DeclaredGroup>& groups,
                   MethodOptions* options) {
  for (const DeclaredGroup& group : groups) {
    fields.Group(group.key.c_str(), {.meaning = group.meaning.c_str()},
                 [&](Fields& f) { group.declare(f, options); });
  }
}

void DeclareOwn(Fields& fields, SmoothingConfig* c) {
  const std::vector<DeclaredGroup> own = c->known.OwnGroups();
  if (own.empty()) {
    fields.Misplaced("own",
                     "there is none: this program added no methods with options (valid: "
                     "without this key)");
    return;
  }
  fields.Group("own", {.meaning = "options of methods that this program added"},
               [&](Fields& f) { DeclareGroups(f, own, &c->options); });
}

constexpr double kMostTurnDegrees = 30;

}  // namespace

Tube WidestTube() {
  const double turn = DegreesToRadians(kMostTurnDegrees);
  return {.foot = 0.5,
          .foot_turn = turn,
          .waist = 0.5,
          .waist_turn = turn,
          .joint = 0.5,
          .joint_speed = 100.0,
          .zmp = 0.5};
}

void DeclareTube(Fields& fields, Tube* tube) {
  const Tube widest = WidestTube();
  const auto length = [&](const char* key, double* value, const char* meaning) {
    fields.Number(key, value, {.meaning = meaning, .unit = "m", .min = 0, .max = widest.foot});
  };
  const auto turn = [&fields](const char* key, double* value, const char* meaning) {
    fields.Number(key, value,
                  {.meaning = meaning, .unit = "deg", .min = 0, .max = kMostTurnDegrees});
  };
  length("foot_m", &tube->foot, "each sole's centre from its place, height included");
  turn("foot_deg", &tube->foot_turn, "each sole turned, about any axis");
  length("waist_m", &tube->waist, "origin of the waist's frame from its place");
  turn("waist_deg", &tube->waist_turn, "the waist turned, about any axis");
  fields.Number(
      "joint_rad", &tube->joint,
      {.meaning = "angle of each leg joint", .unit = "rad", .min = 0, .max = widest.joint});
  fields.Number(
      "joint_speed_rad_s", &tube->joint_speed,
      {.meaning = "speed of each leg joint", .unit = "rad/s", .min = 0, .max = widest.joint_speed});
  length("zmp_m", &tube->zmp, "ZMP of the whole robot on the floor");
}

void SetKnown(Methods known, SmoothingConfig* config) {
  config->limits.own = known.own_margins();
  config->options.Edit(OptimizerGroup()).options.program.own_costs = known.own_costs();
  config->known = std::move(known);
}

void DeclareSmoothing(Fields& fields, SmoothingConfig* c) {
  fields.Texts("methods", &c->methods,
               {.meaning = "to run and compare, each once; `raw` is always written",
                .choices = c->known.Names(),
                .listed_by = "halfstep list methods"});
  for (auto method = c->methods.begin(); method != c->methods.end(); ++method) {
    if (std::find(c->methods.begin(), method, *method) != method) {
      fields.Complain("methods", Quote(*method) + " is there twice (valid: each method once)");
      break;
    }
  }
  fields.Text(
      "acceptance", &c->acceptance,
      {.meaning = "what makes a candidate acceptable", .choices = {"certified", "sampled"}});
  fields.Number("sampling_s", &c->sampling,
                {.meaning = "period of the sampled checks (`sampled` only)",
                 .unit = "s",
                 .min = 1e-4,
                 .max = 0.1});
  fields.Number("resolution_s", &c->certification.resolution,
                {.meaning = "certification gives up on shorter intervals: undecided",
                 .unit = "s",
                 .min = 1e-7,
                 .max = 0.01});
  fields.Text("stop_branches", &c->stop_branches,
              {.meaning = "after which half-steps the walk can be stopped, every margin kept",
               .choices = {"none", "down", "all"}});
  fields.Boolean("repair_plan", &c->repair_plan,
                 {.meaning = "steps of a plan that is not feasible take longer, or go higher or "
                             "lower, where that makes them feasible"});
  fields.Integer("threads", &c->threads,
                 {.meaning = "that search and prove; the walks are the same for any number, unless "
                             "a deadline ends the search",
                  .min = 1,
                  .max = 64});
  DeclareGroups(fields, c->known.BuiltInGroups(), &c->options);
  fields.List("fixed", {.meaning = "parameters that no method may move"}, &c->fixed, DeclareFixed);
  fields.OptionalGroup("given", &c->has_given,
                       {.meaning = "the walk of the method `given`, from tables with the columns "
                                   "of a run; parameters without a column are as planned"},
                       [&](Fields& f) { DeclareGiven(f, &c->given); });
  DeclareOwn(fields, c);
  const bool takes_given = std::ranges::find(c->methods, "given") != c->methods.end();
  if (takes_given && !c->has_given) {
    fields.Complain("methods", "'given' without a walk (valid: with `smoothing.given`)");
  }
  DeclareProfile(fields, c);
  fields.Group("limits", {.meaning = "what the robot file does not limit"},
               [&](Fields& f) { DeclareLimits(f, c); });
  fields.Group("margins", {.meaning = "demanded margins: feasible means at least this far inside"},
               [&](Fields& f) { DeclareMargins(f, &c->limits); });
  fields.OptionalGroup(
      "tube", &c->has_tube,
      {.meaning = "how far motions may be from the plan that keep what is demanded as well",
       .otherwise = "the planned motion alone"},
      [&](Fields& f) { DeclareTube(f, &c->limits.tube); });
}

std::vector<FixedParameter> FixedParameters(const SmoothingConfig& config) {
  std::vector<FixedParameter> fixed;
  for (const FixedConfig& one : config.fixed) {
    for (const ParameterFamily family : AllParameterFamilies()) {
      if (one.parameter == Traits(family).name)
        fixed.push_back({{family, one.index - 1}, one.value});
    }
  }
  return fixed;
}

}  // namespace halfstep
