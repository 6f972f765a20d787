#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "opt/problem/plain_stream.h"
#include "opt/problem/problem.h"

namespace halfstep::opt {
namespace {

std::string Number(double value) {
  PlainStream text;
  text << value;
  return text.str();
}

/// Columns padded to their widest cell: the first to the left, the others to the right.
std::string Align(const std::vector<std::vector<std::string>>& table) {
  std::vector<size_t> width(table.front().size(), 0);
  for (const auto& line : table) {
    for (size_t c = 0; c < line.size(); ++c) width[c] = std::max(width[c], line[c].size());
  }
  std::string text;
  for (const auto& line : table) {
    std::string out;
    for (size_t c = 0; c < line.size(); ++c) {
      const std::string pad(width[c] - line[c].size(), ' ');
      out += c == 0 ? line[c] + pad : "  " + pad + line[c];
    }
    text += out.substr(0, out.find_last_not_of(' ') + 1) + '\n';
  }
  return text;
}

struct Row {
  std::string name, unit;
  double value, lower, upper;

  /// Distance to the nearer bound, negative outside; −inf when the value is not finite.
  double room() const {
    const double room = std::min(value - lower, upper - value);
    return std::isfinite(value) ? room : -std::numeric_limits<double>::infinity();
  }
};

}  // namespace

std::string Problem::Report(const Eigen::VectorXd& x, int max_rows) const {
  PlainStream out;
  out << num_variables() << " variables, " << num_constraints() << " constraint rows ("
      << num_equalities() << " equalities), " << pattern_.rows.size() << " Jacobian entries\n";

  std::vector<std::vector<std::string>> costs = {{"cost", "weight", "value", "unit"}};
  for (const WeightedCost& c : costs_) {
    costs.push_back(
        {c.term->name(), Number(c.weight), Number(c.term->Evaluate(x)), c.term->unit()});
  }
  costs.push_back({"sum", "", Number(Cost(x)), ""});
  out << Align(costs);

  const Eigen::VectorXd values = Constraints(x);
  std::vector<Row> rows;
  for (int i = 0; i < num_constraints(); ++i) {
    rows.push_back({RowName(i), RowUnit(i), values[i], constraint_lower_[i], constraint_upper_[i]});
  }
  for (int j = 0; j < num_variables(); ++j) {
    rows.push_back({VariableName(j), VariableUnit(j), x[j], lower_[j], upper_[j]});
  }
  std::stable_sort(rows.begin(), rows.end(),
                   [](const Row& a, const Row& b) { return a.room() < b.room(); });
  const auto violated =
      std::count_if(rows.begin(), rows.end(), [](const Row& row) { return row.room() < 0.0; });
  const size_t shown = std::min(rows.size(), static_cast<size_t>(std::max(max_rows, 0)));
  out << violated << " of " << rows.size() << " rows and variables violated; the " << shown
      << " with the least room:\n";
  std::vector<std::vector<std::string>> table = {
      {"row", "value", "lower", "upper", "room", "unit"}};
  for (size_t k = 0; k < shown; ++k) {
    const Row& row = rows[k];
    table.push_back({row.name, Number(row.value), Number(row.lower), Number(row.upper),
                     Number(row.room()), row.unit});
  }
  out << Align(table);
  return out.str();
}

}  // namespace halfstep::opt
