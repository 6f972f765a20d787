#pragma once

#include <memory>
#include <string>
#include <vector>

#include "halfstep/smoothing/methods/smoother.h"

namespace halfstep {

/// All methods: the dichotomy and its variants, references, and one for each solver that is
/// compiled in. To add one, add it to the list in the source.
const std::vector<std::unique_ptr<const Smoother>>& Smoothers();
std::vector<std::string> SmootherNames();
/// The method of that name. Throws std::logic_error when there is none, since configs are checked
/// when they are read.
const Smoother& FindSmoother(const std::string& name);

}  // namespace halfstep
