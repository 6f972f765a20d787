#pragma once

#include <pybind11/pybind11.h>

#include <memory>

#include "experiments/tables/csv_columns.h"
#include "smoothing/methods/walk_problem.h"
#include "smoothing/proof/certificate.h"
#include "smoothing/walk/superposed_walk.h"
#include "wpg/robot/not_covered.h"

namespace halfstep::python {

/// What a walk belongs to: robot, scene, half-steps, demands, and how it is certified.
struct WalkSetting {
  WalkProblem problem;
  CertificationOptions certification;
};

/// A walk as Python holds it: it owns all that it needs.
struct PlacedWalk {
  std::shared_ptr<const WalkSetting> setting;
  SuperposedWalk walk;
};

/// What is not covered for Python: (kind, subject, sentence) of each thing.
pybind11::list ToPython(const std::vector<NotCovered>& list);

/// A table for Python: (columns, text), each column (name, type, unit, description).
pybind11::tuple ToPython(const CsvFile& file);
/// The columns alone.
pybind11::list ToPython(const CsvColumns& columns);

/// The families of parameters, a tuple each: the name of its values, such as "overlaps"; what it
/// has one of: "junction", "step" or "half_step"; unit, meaning; the key that lets methods move it
/// or "".
pybind11::list ParameterFamiliesForPython();
/// A point of the homotopy as a dict of arrays, by the names of values in those tuples.
pybind11::dict ToPython(const HomotopyParameters& parameters);
/// The walk of `parameters`, but for the families that are in such a dict. Throws InputError where
/// no walk of the setting has them.
PlacedWalk WalkWith(const std::shared_ptr<const WalkSetting>& setting,
                    HomotopyParameters parameters, const pybind11::dict& given);

/// (family, index from 0) of a parameter.
pybind11::tuple ToPython(const HomotopyParameter& parameter);

}  // namespace halfstep::python
