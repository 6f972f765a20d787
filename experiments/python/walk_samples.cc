#include "experiments/python/walk_samples.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "experiments/tables/result_tables.h"
#include "smoothing/margins/family_traits.h"
#include "wpg/elementary.h"
#include "wpg/nth.h"

namespace py = pybind11;

namespace halfstep::python {
namespace {

constexpr double kLeft = 0.0, kRight = 1.0, kBoth = 2.0;

// Arrays of one length, one a column, that are written without the GIL.
class Arrays {
 public:
  Arrays(const CsvColumns& columns, py::ssize_t rows) {
    for (size_t c = 0; c < columns.size(); ++c) {
      arrays_.emplace_back(rows);
      data_.push_back(arrays_.back().mutable_data());
    }
  }
  double& operator()(size_t column, py::ssize_t row) { return data_[column][row]; }
  py::list ToPython() const {
    py::list list;
    for (const py::array_t<double>& array : arrays_) list.append(array);
    return list;
  }

 private:
  std::vector<py::array_t<double>> arrays_;
  std::vector<double*> data_;
};

// Throws std::invalid_argument unless these are finite times in one row.
void RequireTimes(const Times& times) {
  if (times.ndim() != 1) throw std::invalid_argument("times: not one row of numbers (valid: (n))");
  for (py::ssize_t i = 0; i < times.size(); ++i) {
    if (!std::isfinite(times.at(i))) {
      throw std::invalid_argument("times: number " + std::to_string(i + 1) +
                                  " is not finite (valid: seconds)");
    }
  }
}

double CodeOf(std::string_view support) {
  return support == "left" ? kLeft : support == "right" ? kRight : kBoth;
}

// As MotionRow, without joints; `put` takes the cells in the order of MotionColumns.
template <typename Put>
void PutWithoutJoints(const RobotModel& robot, const SuperposedWalk& walk, double t,
                      const Put& put) {
  const LocalTime at = walk.Locate(t);
  const WalkJet jet = walk.At(at);
  const int step = walk.StepInAir(at);
  put(t);
  put(at.half_step + 1.0);
  put(step < 0 ? kBoth : CodeOf(Name(walk.half_step(2 * step).support)));
  const double rise = jet.value[kWaistZ];
  for (const double com : {jet.value[kComX], jet.value[kComY], robot.com_height + rise}) put(com);
  for (const WalkState* rate : {&jet.first, &jet.second}) {
    put((*rate)[kComX]);
    put((*rate)[kComY]);
  }
  put(jet.value[kZmpX]);
  put(jet.value[kZmpY]);
  const double yaw = jet.value[kWaistYaw];
  put(jet.value[kComX] - robot.com_x_B * Cos(yaw));
  put(jet.value[kComY] - robot.com_x_B * Sin(yaw));
  put(robot.waist_height + rise);
  put(yaw);
  for (int q = kLeftX; q <= kRightYaw; ++q) put(jet.value[q]);
}

}  // namespace

py::tuple SampleMotion(const PlacedWalk& placed, const Times& times, bool joints) {
  RequireTimes(times);
  const RobotModel& robot = placed.setting->problem.robot();
  CsvColumns columns = MotionColumns(robot);
  if (!joints) {
    std::erase_if(columns, [](const CsvColumn& column) { return column.name.starts_with("q_"); });
  }
  const py::ssize_t rows = times.size();
  Arrays arrays(columns, rows);
  const double* const t = times.data();
  {
    const py::gil_scoped_release released;
    for (py::ssize_t row = 0; row < rows; ++row) {
      const double at = std::clamp(t[row], 0.0, placed.walk.duration());
      size_t column = 0;
      const auto put = [&](double value) { arrays(column++, row) = value; };
      if (!joints) {
        PutWithoutJoints(robot, placed.walk, at, put);
        continue;
      }
      for (const MotionCell& cell : MotionRow(robot, placed.walk, at)) {
        if (const auto* text = std::get_if<std::string_view>(&cell)) {
          put(CodeOf(*text));
        } else if (const auto* number = std::get_if<long>(&cell)) {
          put(static_cast<double>(*number));
        } else {
          put(std::get<double>(cell));
        }
      }
    }
  }
  return py::make_tuple(ToPython(columns), arrays.ToPython());
}

py::tuple SampleMargins(const PlacedWalk& placed, const Times& times) {
  RequireTimes(times);
  CsvColumns columns = {{"t_s", CsvType::kNumber, "s", "time since the start"}};
  const MarginEvaluator& evaluator = placed.setting->problem.evaluator();
  for (const MarginFamily family : evaluator.families()) {
    const FamilyTraits& traits = Traits(family);
    columns.push_back({std::string(traits.key), CsvType::kNumber,
                       traits.unit == "1" ? "" : std::string(traits.unit),
                       "least margin of " + std::string(traits.name) + " at this instant"});
  }
  const py::ssize_t rows = times.size();
  Arrays arrays(columns, rows);
  const double* const t = times.data();
  {
    const py::gil_scoped_release released;
    MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
    for (py::ssize_t row = 0; row < rows; ++row) {
      const double at = std::clamp(t[row], 0.0, placed.walk.duration());
      const MarginSet margins = evaluator.At(placed.walk, placed.walk.Locate(at), &scratch);
      arrays(0, row) = at;
      size_t column = 1;
      for (const MarginFamily family : evaluator.families()) {
        arrays(column++, row) = Nth(margins, family).value;
      }
    }
  }
  return py::make_tuple(ToPython(columns), arrays.ToPython());
}

}  // namespace halfstep::python
