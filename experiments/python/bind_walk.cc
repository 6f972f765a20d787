#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <stdexcept>

#include "experiments/python/bindings.h"
#include "experiments/python/long_call.h"
#include "experiments/python/walk_samples.h"
#include "experiments/python/walk_setting.h"
#include "experiments/tables/answer_words.h"
#include "experiments/tables/certificate_files.h"
#include "experiments/tables/parameter_tables.h"
#include "smoothing/margins/not_covered_by.h"
#include "smoothing/margins/slack_evaluator.h"
#include "wpg/nth.h"

namespace py = pybind11;

namespace halfstep::python {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

double RequireTime(double t) {
  if (!std::isfinite(t)) throw std::invalid_argument("t: not finite (valid: seconds)");
  return t;
}

// The derivatives at a fixed absolute time in place of a fixed (half-step, τ).
void HoldTime(const SuperposedWalk& walk, double t, const LocalTime& at,
              std::vector<WalkSensitivity>* sensitivities) {
  const WalkJet jet = walk.At(at);
  const WalkState third = walk.ThirdRanges(t, t).center;
  std::vector<std::pair<HomotopyParameter, double>> starts;
  walk.StartSensitivities(at.half_step, &starts);
  for (const auto& [parameter, rate] : starts) {
    auto found = std::find_if(sensitivities->begin(), sensitivities->end(),
                              [&](const WalkSensitivity& s) { return s.parameter == parameter; });
    if (found == sensitivities->end()) {
      sensitivities->push_back({parameter, {}});
      found = sensitivities->end() - 1;
    }
    found->jet.value -= rate * jet.first;
    found->jet.first -= rate * jet.second;
    found->jet.second -= rate * third;
  }
}

// (parameters, values, first, second), each array (parameters × 14).
py::tuple SensitivitiesAt(const PlacedWalk& placed, double t, bool hold_time) {
  const LocalTime at = placed.walk.Locate(RequireTime(t));
  std::vector<WalkSensitivity> all;
  placed.walk.Sensitivities(at, &all);
  if (hold_time) HoldTime(placed.walk, placed.walk.Absolute(at), at, &all);
  const auto rows = static_cast<Eigen::Index>(all.size());
  RowMajor value(rows, kNumQuantities), first(rows, kNumQuantities), second(rows, kNumQuantities);
  py::list parameters;
  for (Eigen::Index i = 0; i < rows; ++i) {
    const WalkSensitivity& s = Nth(all, i);
    parameters.append(ToPython(s.parameter));
    value.row(i) = s.jet.value.transpose();
    first.row(i) = s.jet.first.transpose();
    second.row(i) = s.jet.second.transpose();
  }
  return py::make_tuple(parameters, value, first, second);
}

// (families, margins, parameters, gradient (statements × parameters)) at a fixed (half-step, τ).
py::tuple MarginGradientsAt(const PlacedWalk& placed, double t, double cutoff) {
  const MarginEvaluator& evaluator = placed.setting->problem.evaluator();
  SlackEvaluator slacks(evaluator, cutoff);
  InstantSlacks out;
  slacks.At(placed.walk, placed.walk.Locate(RequireTime(t)), {}, /*gradient=*/true, &out);
  std::vector<HomotopyParameter> parameters = out.parameters;
  for (const auto& [moving, rate] : out.times) {
    if (std::find(parameters.begin(), parameters.end(), moving) == parameters.end()) {
      parameters.push_back(moving);
    }
  }
  RowMajor gradient(static_cast<Eigen::Index>(out.rows.size()),
                    static_cast<Eigen::Index>(parameters.size()));
  std::vector<std::string> families;
  std::vector<double> margins;
  py::list names;
  for (const HomotopyParameter& parameter : parameters) names.append(ToPython(parameter));
  for (size_t row = 0; row < out.rows.size(); ++row) {
    const MarginFamily family = out.rows[row].family;
    const double scale = Scale(family);
    families.emplace_back(Name(family));
    margins.push_back(out.rows[row].slack * scale + evaluator.limits().demanded_of(family));
    for (size_t i = 0; i < parameters.size(); ++i) {
      gradient(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(i)) =
          scale * out.Slope(row, parameters[i]);
    }
  }
  return py::make_tuple(
      families, py::array_t<double>(static_cast<py::ssize_t>(margins.size()), margins.data()),
      names, gradient);
}

std::vector<NotCovered> NotCoveredOfWalk(const PlacedWalk& placed) {
  const MarginEvaluator& of = placed.setting->problem.evaluator();
  return NotCoveredBy(of.robot(), of.scene(), of.limits());
}

// (status, sentence, table of the proof).
py::tuple CertifyPlaced(const PlacedWalk& placed) {
  const WalkProblem& problem = placed.setting->problem;
  const CertifiedFeasibility test(problem.evaluator(), placed.setting->certification);
  CertifiedWalk certified;
  CallLong(py::none(), [&](const LongCallHooks& hooks) {
    certified = CertifyWalk(test, problem.sequence(), placed.walk.parameters(), hooks.stop);
  });
  const bool holds = certified.answer.verdict == Verdict::kFeasible;
  const std::string sentence =
      holds ? "every demanded margin is kept at every instant, by " +
                  std::to_string(certified.rows.size()) + " statements; " +
                  std::to_string(NotCoveredOfWalk(placed).size()) + " things are not covered"
            : AnswerWords(problem.evaluator(), test.options(), certified.answer);
  return py::make_tuple(std::string(VerdictName(certified.answer.verdict)), sentence,
                        ToPython(CertificateCsv(problem.evaluator(), certified.rows)));
}

}  // namespace

void BindWalk(py::module_& module) {
  module.def("parameter_families", &ParameterFamiliesForPython);
  py::class_<PlacedWalk, std::shared_ptr<PlacedWalk>>(module, "Walk")
      .def_property_readonly("duration", [](const PlacedWalk& p) { return p.walk.duration(); })
      .def_property_readonly("num_half_steps",
                             [](const PlacedWalk& p) { return p.walk.num_half_steps(); })
      .def_property_readonly("parameters",
                             [](const PlacedWalk& p) { return ToPython(p.walk.parameters()); })
      .def_property_readonly("starts",
                             [](const PlacedWalk& p) {
                               std::vector<double> starts;
                               for (int i = 0; i < p.walk.num_half_steps(); ++i)
                                 starts.push_back(p.walk.start_of(i));
                               return py::array_t<double>(static_cast<py::ssize_t>(starts.size()),
                                                          starts.data());
                             })
      .def_property_readonly("robot",
                             [](const PlacedWalk& p) { return p.setting->problem.robot(); })
      .def_property_readonly("not_covered",
                             [](const PlacedWalk& p) { return ToPython(NotCoveredOfWalk(p)); })
      .def_property_readonly(
          "half_steps",
          [](const PlacedWalk& p) {
            return ToPython(HalfStepsCsv(p.setting->problem.sequence(), p.walk.parameters()));
          })
      .def("sample", &SampleMotion)
      .def("margins", &SampleMargins)
      .def("sensitivities", &SensitivitiesAt)
      .def("margin_gradients", &MarginGradientsAt)
      .def("certify", &CertifyPlaced);
}

}  // namespace halfstep::python
