#pragma once

#include <memory>
#include <string>
#include <vector>

#include "smoothing/methods/smoother.h"

namespace halfstep {

/// All methods: the dichotomy and its variants, references, and one for each solver that is
/// compiled in or registered; then those of RegisterSmoother(). To build one in, add it to the list
/// in the source.
const std::vector<std::shared_ptr<const Smoother>>& Smoothers();
/// Their names, in the same order.
std::vector<std::string> SmootherNames();
/// The method of that name. Throws std::logic_error when there is none, since configs are checked
/// when they are read.
const Smoother& FindSmoother(const std::string& name);

/// Makes a method of one's own known by its name, in place of an earlier one of that name, so that
/// `smoothing.methods` may name it. Throws std::invalid_argument for the name of a method that is
/// built in. Before configs are read that name it, and not while another thread smooths.
void RegisterSmoother(std::shared_ptr<const Smoother> smoother);

}  // namespace halfstep
