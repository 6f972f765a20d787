#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tests/oracle/judge.h"

namespace halfstep::oracle {

/// A drawn walk in its scene, and what is demanded of it.
struct Judge::Case {
  std::string name;
  WalkPlan plan;
  PlainScene plain_scene;
  MarginLimits limits;
  std::unique_ptr<PlacedScene> placed;
  std::unique_ptr<MarginEvaluator> evaluator;
  std::vector<std::string>* falsehoods = nullptr;

  void Tell(const std::string& what) const { falsehoods->push_back(name + ": " + what); }
  // With overlaps of that share of what was drawn; rests stay.
  void Overlap(const std::vector<double>& overlaps, double share) {
    for (size_t i = 0; i < overlaps.size(); ++i) {
      plan.overlaps[i] = overlaps[i] < 0 ? overlaps[i] : share * overlaps[i];
    }
  }
};

}  // namespace halfstep::oracle
