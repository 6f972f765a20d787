#include "smoothing/program/band_columns.h"

namespace halfstep {

BandColumns::BandColumns(const OverlapVariables& variables, const std::vector<int>& band,
                         const Eigen::VectorXd& x, const HomotopyParameters& at)
    : variables_(variables), band_(band) {
  for (const int variable : band) {
    const HomotopyParameter& parameter = variables.at(variable);
    if (parameter.family != ParameterFamily::kOverlap) continue;
    const Eigen::Index from = ColumnOf(variable);
    overlaps_.push_back(from);
    variables.Pull(parameter, 1.0, x, at, [&](int to, double factor) {
      terms_.push_back({from, ColumnOf(to), factor});
    });
  }
}

void BandColumns::Pull(const Eigen::VectorXd& along_parameters, double* by_x) const {
  Eigen::Map<Eigen::VectorXd> pulled(by_x, size());
  pulled = along_parameters;
  for (const Eigen::Index column : overlaps_) pulled[column] = 0.0;
  for (const Term& term : terms_) pulled[term.to] += along_parameters[term.from] * term.factor;
}

}  // namespace halfstep
