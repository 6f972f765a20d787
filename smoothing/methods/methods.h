#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "opt/solvers/solver.h"
#include "smoothing/margins/own_margin.h"
#include "smoothing/methods/smoother.h"
#include "smoothing/program/walk_cost.h"

namespace halfstep {

/// The methods that a config may name, and what a program adds to what they heed: margins and
/// costs. A value: a program takes Standard(), adds its own, and hands it to what reads configs.
class Methods {
 public:
  /// The dichotomy and its variants, references, and one method for each solver that is compiled
  /// in.
  static Methods Standard();
  /// These are built in: Add() replaces none of them.
  explicit Methods(std::vector<std::shared_ptr<const Smoother>> built_in);

  /// Adds a method of one's own, in place of an earlier one of that name. Throws
  /// std::invalid_argument for the name of a method that is built in, and for a group of options
  /// whose key is no name (letters, digits, `_`, `-`, `/`) or has other options already.
  void Add(std::shared_ptr<const Smoother> smoother);

  /// Adds a solver of one's own, in place of an earlier one, and the method of its name: its
  /// programs, as those of solvers that are built in. Throws as Add(), and for a solver's name that
  /// is built in.
  void AddSolver(std::shared_ptr<const opt::Solver> solver);

  /// Adds a margin of one's own (not null) to the family `own`: what configs then demand by
  /// `smoothing.margins.own`.
  void AddMargin(std::shared_ptr<const OwnStatement> margin);
  /// Adds a cost of one's own (not null), in place of an earlier one of that name: a key of
  /// `smoothing.optimizer.weights`.
  void AddCost(std::shared_ptr<const WalkCost> cost);

  const OwnMargins& own_margins() const { return margins_; }  ///< those that were added, in order
  /// The same of costs, each of weight 0.
  const std::vector<WeightedWalkCost>& own_costs() const { return costs_; }
  /// The solvers that were added.
  const std::vector<std::shared_ptr<const opt::Solver>>& own_solvers() const& { return solvers_; }
  /// All methods, those that were added last.
  const std::vector<std::shared_ptr<const Smoother>>& all() const& { return all_; }
  const std::vector<std::shared_ptr<const Smoother>>& all() const&& = delete;  // `for` would dangle
  std::vector<std::string> Names() const;  ///< in the same order
  /// The method of that name. Throws std::logic_error when there is none, since configs are checked
  /// when they are read.
  const Smoother& Find(const std::string& name) const;

  /// The groups of options of the methods that are built in, each once, in their order: the keys of
  /// `smoothing`.
  std::vector<DeclaredGroup> BuiltInGroups() const;
  /// Those that only added methods have: the keys of `smoothing.own`.
  std::vector<DeclaredGroup> OwnGroups() const;

 private:
  std::vector<std::shared_ptr<const Smoother>> all_;
  size_t built_in_;  // so many of them
  std::vector<std::shared_ptr<const opt::Solver>> solvers_;
  OwnMargins margins_;
  std::vector<WeightedWalkCost> costs_;
};

}  // namespace halfstep
