#include "experiments/python/walk_setting.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

namespace py = pybind11;

namespace halfstep::python {
namespace {

std::string PluralOf(ParameterFamily family) { return std::string(Traits(family).name) + "s"; }

}  // namespace

py::list ToPython(const CsvColumns& columns) {
  static constexpr std::array<const char*, 4> kTypes = {"integer", "number", "boolean", "string"};
  py::list list;
  for (const CsvColumn& column : columns) {
    list.append(py::make_tuple(column.name, kTypes[static_cast<size_t>(column.type)], column.unit,
                               column.description));
  }
  return list;
}

py::tuple ToPython(const CsvFile& file) {
  return py::make_tuple(ToPython(file.columns), file.text);
}

py::dict ToPython(const HomotopyParameters& parameters) {
  const auto array = [](const std::vector<double>& values) {
    return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
  };
  py::dict dict;
  for (const ParameterFamily family : AllParameterFamilies()) {
    dict[PluralOf(family).c_str()] = array(parameters.of(family));
  }
  return dict;
}

void Take(const py::dict& dict, HomotopyParameters* parameters) {
  for (const ParameterFamily family : AllParameterFamilies()) {
    const std::string name = PluralOf(family);
    if (dict.contains(name))
      parameters->of(family) = dict[name.c_str()].cast<std::vector<double>>();
  }
}

py::tuple ToPython(const HomotopyParameter& parameter) {
  return py::make_tuple(std::string(Traits(parameter.family).name), parameter.index);
}

}  // namespace halfstep::python
