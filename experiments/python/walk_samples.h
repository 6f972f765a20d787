#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include "experiments/python/walk_setting.h"

namespace halfstep::python {

/// Instants of a walk [s], as Python gives them (n).
using Times = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;

/// The columns of trajectory.csv at instants of a walk, those of the margins left out: (columns,
/// arrays), each array (n), of doubles. The column `support` has 0 for left, 1 for right and 2 for
/// both. Without `joints`, the columns of joint angles are left out, and no inverse kinematics is
/// solved. Times outside of the walk are its ends.
pybind11::tuple SampleMotion(const PlacedWalk& placed, const Times& times, bool joints);

/// Every family's least margin at instants of a walk: (columns, arrays) as above, in the order of
/// MarginFamily; the first column is the time.
pybind11::tuple SampleMargins(const PlacedWalk& placed, const Times& times);

}  // namespace halfstep::python
