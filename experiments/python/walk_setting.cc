#include "experiments/python/walk_setting.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <utility>

#include "smoothing/walk/parameter_complaint.h"
#include "wpg/files/input_error.h"
#include "wpg/nth.h"

namespace py = pybind11;

namespace halfstep::python {
py::list ToPython(const CsvColumns& columns) {
  static constexpr std::array<const char*, 4> kTypes = {"integer", "number", "boolean", "string"};
  py::list list;
  for (const CsvColumn& column : columns) {
    list.append(
        py::make_tuple(column.name, Nth(kTypes, column.type), column.unit, column.description));
  }
  return list;
}

py::tuple ToPython(const CsvFile& file) {
  return py::make_tuple(ToPython(file.columns), file.text);
}

py::list ParameterFamiliesForPython() {
  py::list list;
  for (const ParameterFamily family : AllParameterFamilies()) {
    const ParameterFamilyTraits& traits = Traits(family);
    list.append(py::make_tuple(PluralOf(traits), std::string(Name(traits.of)),
                               std::string(traits.unit), std::string(traits.meaning),
                               traits.always ? std::string() : std::string(traits.key)));
  }
  return list;
}

py::dict ToPython(const HomotopyParameters& parameters) {
  const auto array = [](const std::vector<double>& values) {
    return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
  };
  py::dict dict;
  for (const ParameterFamily family : AllParameterFamilies()) {
    dict[PluralOf(Traits(family)).c_str()] = array(parameters.of(family));
  }
  return dict;
}

PlacedWalk WalkWith(const std::shared_ptr<const WalkSetting>& setting,
                    HomotopyParameters parameters, const py::dict& given) {
  for (const ParameterFamily family : AllParameterFamilies()) {
    const std::string name = PluralOf(Traits(family));
    if (!given.contains(name)) continue;
    parameters.of(family) = given[name.c_str()].cast<std::vector<double>>();
  }
  const HalfStepSequence& sequence = setting->problem.sequence();
  const std::string complaint = ComplaintAbout(sequence, parameters);
  if (!complaint.empty()) throw InputError({complaint});
  return {setting, SuperposedWalk(sequence, parameters)};
}

py::tuple ToPython(const HomotopyParameter& parameter) {
  return py::make_tuple(std::string(Traits(parameter.family).name), parameter.index);
}

}  // namespace halfstep::python
