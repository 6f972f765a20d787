#include "experiments/python/walk_setting.h"

#include <pybind11/numpy.h>

namespace py = pybind11;

namespace halfstep::python {

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
  dict["overlaps"] = array(parameters.overlaps);
  dict["height_scales"] = array(parameters.height_scales);
  dict["durations"] = array(parameters.durations);
  dict["support_points"] = array(parameters.support_points);
  return dict;
}

py::tuple ToPython(const HomotopyParameter& parameter) {
  return py::make_tuple(std::string(Traits(parameter.family).name), parameter.index);
}

}  // namespace halfstep::python
