#include "smoothing/walk/parameter_choice.h"

#include "smoothing/walk/parameter_families.h"
#include "wpg/check.h"

namespace halfstep {

ParameterBounds DefaultBounds() {
  ParameterBounds bounds;
  for (const ParameterFamily family : AllParameterFamilies()) {
    const auto keys = Traits(family).bounds();
    for (size_t k = 0; k < keys.size(); ++k) bounds[family][k] = keys[k].initial;
  }
  return bounds;
}

bool ParameterChoice::moves(ParameterFamily family) const {
  const ParameterFamilyTraits& traits = Traits(family);
  if (traits.always) return true;
  return traits.chosen != nullptr ? this->*traits.chosen : others[family];
}

bool ParameterChoice::moves(std::string_view key) const {
  for (const ParameterFamily family : AllParameterFamilies()) {
    if (Traits(family).key == key) return moves(family);
  }
  HALFSTEP_CHECK(false, "no family " << key);
  return false;
}

bool* ParameterChoice::flag(ParameterFamily family) {
  const ParameterFamilyTraits& traits = Traits(family);
  if (traits.always) return nullptr;
  return traits.chosen != nullptr ? &(this->*traits.chosen) : &others[family];
}

double& ParameterChoice::bound(std::string_view key) {
  for (const ParameterFamily family : AllParameterFamilies()) {
    const auto keys = Traits(family).bounds();
    for (size_t k = 0; k < keys.size(); ++k) {
      if (keys[k].key == key) return bounds[family][k];
    }
  }
  HALFSTEP_CHECK(false, "no bound " << key);
  return bounds.values[0][0];
}

double ParameterChoice::bound(std::string_view key) const {
  return ParameterChoice(*this).bound(key);
}

ParameterChoice EveryFamily() {
  ParameterChoice all;
  for (const ParameterFamily family : AllParameterFamilies()) {
    if (bool* const flag = all.flag(family)) *flag = true;
  }
  return all;
}

ParameterChoice WithoutForms(ParameterChoice choice) {
  for (const ParameterFamily family : AllParameterFamilies()) {
    if (Traits(family).of_form && !Traits(family).of_heights) *choice.flag(family) = false;
  }
  return choice;
}

}  // namespace halfstep
