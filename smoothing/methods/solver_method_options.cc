#include "smoothing/methods/solver_method_options.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace halfstep {
namespace {

void DeclareWeights(Fields& fields, RoughnessWeights* w) {
  const auto weight = [&](const char* key, double* value, const char* meaning, const char* unit) {
    fields.Number(key, value, {.meaning = meaning, .unit = unit, .min = 0, .max = 1000});
  };
  weight("com_acceleration", &w->com_acceleration, "of ∫‖c̈‖² dt", "s⁴/m²");
  weight("com_jerk", &w->com_jerk, "of ∫‖c⃛‖² dt", "s⁶/m²");
  weight("foot_speed", &w->foot_speed, "of ∫‖v‖² dt of both soles", "s²/m²");
}

// A weight for each cost that the program itself adds.
void DeclareOwnCosts(Fields& fields, std::vector<WeightedWalkCost>* costs) {
  for (WeightedWalkCost& own : *costs) {
    const std::string name = own.cost->name(), meaning = own.cost->meaning(),
                      unit = own.cost->unit();
    fields.Number(name.c_str(), &own.weight,
                  {.meaning = meaning.c_str(), .unit = unit.c_str(), .min = 0, .max = 1e6});
  }
}

bool OfHalfSteps(const ParameterFamilyTraits& traits) {
  return !traits.always && traits.move == nullptr;
}

bool NamesFamilyOfHalfSteps(const std::vector<std::string>& keys) {
  return std::ranges::any_of(AllParameterFamilies(), [&keys](ParameterFamily family) {
    const ParameterFamilyTraits& traits = Traits(family);
    return OfHalfSteps(traits) && std::ranges::find(keys, traits.key) != keys.end();
  });
}

void ChooseFamiliesOfHalfSteps(bool chosen, ParameterChoice* choice) {
  for (const ParameterFamily family : AllParameterFamilies()) {
    if (OfHalfSteps(Traits(family))) *choice->flag(family) = chosen;
  }
  choice->bound("least_duration") = chosen ? 0.2 : ParameterChoice().bound("least_duration");
}

void DeclareProgram(Fields& fields, SolverMethodOptions* c) {
  fields.Text(
      "program", &c->program,
      {.meaning = "what is optimized: duration; duration and roughness; the least slack for a "
                  "duration; that for a range of durations",
       .choices = {"fastest", "smooth", "safest", "pareto"}});
  for (ProgramKind kind : {ProgramKind::kFastest, ProgramKind::kSmooth, ProgramKind::kSafest}) {
    if (c->program == Name(kind)) c->options.program.kind = kind;
  }
}

// Which parameters move, and within what.
void DeclareFamilies(Fields& fields, SolverMethodOptions* c) {
  ParameterChoice* const choice = &c->options.program.parameters;
  const std::vector<std::string> keys = fields.Keys();
  if (NamesFamilyOfHalfSteps(keys)) c->all_families = false;
  fields.Boolean("all_families", &c->all_families,
                 {.meaning = "of the next keys all but `footsteps` are true where they are not "
                             "given, and `least_duration` is 0.2; false by default where one of "
                             "them is given"});
  if (!keys.empty() && !c->all_families) ChooseFamiliesOfHalfSteps(false, choice);
  for (const ParameterFamily family : AllParameterFamilies()) {
    const ParameterFamilyTraits& traits = Traits(family);
    if (traits.always || traits.key.empty()) continue;
    fields.Boolean(traits.key.data(), choice->flag(family), {.meaning = traits.key_meaning.data()});
  }
  for (const ParameterFamily family : AllParameterFamilies()) {
    double* value = choice->bounds[family].data();
    for (const ParameterBoundKey& bound : Traits(family).bounds()) {
      fields.Number(bound.key.data(), value++,
                    {.meaning = bound.meaning.data(),
                     .unit = bound.unit.data(),
                     .min = bound.min,
                     .max = bound.max});
    }
  }
}

// What `safest`, `pareto` and `smooth` ask beside the duration.
void DeclareObjective(Fields& fields, SolverMethodOptions* c) {
  OptimizerOptions* const o = &c->options;
  fields.Number("duration_s", &o->duration_limit,
                {.meaning = "`safest`: of the walk at most; 0: the dichotomy's own",
                 .unit = "s",
                 .min = 0,
                 .max = 100000});
  fields.Integer(
      "pareto_points", &c->pareto.points,
      {.meaning = "`pareto`: durations, from the fastest to the longest", .min = 2, .max = 200});
  fields.Number(
      "pareto_longest", &c->pareto.most_duration,
      {.meaning = "`pareto`: longest duration, of the planned motion's", .min = 0.1, .max = 3});
  fields.Group("weights", {.meaning = "`smooth`: of the roughness beside the duration"},
               [&](Fields& f) {
                 DeclareWeights(f, &o->program.weights);
                 DeclareOwnCosts(f, &o->program.own_costs);
               });
}

// Where the search looks, begins and ends.
void DeclareSearch(Fields& fields, OptimizerOptions* o) {
  fields.Integer(
      "instants", &o->instants,
      {.meaning = "per half-step at which the program looks; 0: 24 for `halfstep/sqp`, 32 for "
                  "others",
       .min = 0,
       .max = 1000});
  fields.Integer("rounds", &o->rounds,
                 {.meaning = "solves from each start, each looking closer", .min = 1, .max = 100});
  fields.Boolean("windows", &o->windows,
                 {.meaning = "`halfstep/sqp` searches long walks in windows first"});
  fields.Misplaced("planned_start",
                   "is gone: rounds begin at the plan, too (`start`; leave it out)");
  fields.Misplaced("random_starts", "is gone: starts are forms, not noise (`start`; leave it out)");
  std::string start(Name(o->start));
  fields.Text(
      "start", &start,
      {.meaning = "where rounds begin: each half-step in the typical form of fast walks, "
                  "the dichotomy's walk, which `safest` always takes, or the planned motion",
       .choices = {"typical", "dichotomy", "planned"}});
  for (SearchStart each : {SearchStart::kTypical, SearchStart::kDichotomy, SearchStart::kPlanned}) {
    if (start == Name(each)) o->start = each;
  }
  fields.Integer(
      "max_iterations", &o->max_iterations,
      {.meaning =
           "that the solver may make in a round, NLopt's excepted, which count none; 0: 3 for "
           "`halfstep/sqp`, 30 for others",
       .min = 0,
       .max = 100000});
  fields.Number("effort", &o->effort,
                {.meaning = "work after which a method ends, `dichotomy/uniform`, too; 1 is about "
                            "a second of one core of 2026",
                 .min = 0.001,
                 .max = 86400});
  double deadline = std::isfinite(o->deadline) ? o->deadline : 0.0;
  fields.Number("deadline_s", &deadline,
                {.meaning = "emergency stop of a method by the clock, whose walk is not the same "
                            "twice; 0: none",
                 .unit = "s",
                 .min = 0,
                 .max = 86400});
  o->deadline = deadline > 0.0 ? deadline : std::numeric_limits<double>::infinity();
}

}  // namespace

SolverMethodOptions::SolverMethodOptions() {
  ChooseFamiliesOfHalfSteps(true, &options.program.parameters);
}

OptionGroup<SolverMethodOptions> OptimizerGroup() {
  return {"optimizer",
          "options of the methods that are solvers (smoothing/README.md, \"Overlap program\")"};
}

void DeclareFields(Fields& fields, SolverMethodOptions* c) {
  DeclareProgram(fields, c);
  DeclareFamilies(fields, c);
  DeclareObjective(fields, c);
  DeclareSearch(fields, &c->options);
}

std::string VariableNames(const ParameterChoice& choice) {
  std::string names;
  for (const ParameterFamily family : AllParameterFamilies()) {
    const ParameterFamilyTraits& traits = Traits(family);
    if (traits.key.empty() || !choice.moves(family)) continue;
    if (!names.empty()) names += '+';
    names += traits.key;
  }
  return names;
}

void DeclareSolverRequest(Fields& fields, SolverMethodOptions c) {
  OptimizerOptions& o = c.options;
  std::string variables = VariableNames(o.program.parameters);
  fields.Text("variables", &variables, {});
  fields.Text("objective", &c.program, {});
  fields.Number("duration_limit_s", &o.duration_limit, {});
  fields.Integer("instants", &o.program.watch.instants, {});
  std::string start(Name(o.start));
  fields.Text("start", &start, {});
  fields.Integer("rounds", &o.rounds, {});
  fields.Integer("max_iterations", &o.max_iterations, {});
  fields.Number("effort", &o.effort, {});
  fields.Number("tolerance_s", &o.tolerance, {});
}

}  // namespace halfstep
