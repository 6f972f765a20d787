#include "experiments/verify/findings.h"

namespace halfstep::verify {

std::string Count(long n) {
  std::string text = std::to_string(n);
  for (size_t i = text.size(); i > 3; i -= 3) text.insert(i - 3, 1, ',');
  return text;
}

void Check::Conclude(Findings* findings) const {
  std::string line = name_ + ": " + Count(count_) + (count_ == 1 ? " value" : " values");
  if (count_ > 0 && smallest_ < std::numeric_limits<double>::infinity()) {
    line += Formatted(", smallest %.6g%s%s", smallest_, unit_.empty() ? "" : " ", unit_.c_str());
    if (!where_.empty()) line += " (" + where_ + ")";
  }
  line += Formatted(", demanded %.6g − %.3g", demanded_, tolerance_);
  findings->Say(line);
  if (failures_ == 0) return;
  std::string reason = name_ + ": " + first_failure_;
  if (count_ > 0)
    reason += Formatted("; smallest %.6g, demanded %.6g − %.3g", smallest_, demanded_, tolerance_);
  if (failures_ > 1) reason += ", and " + Count(failures_ - 1) + " more";
  findings->Disagree(reason);
}

}  // namespace halfstep::verify
