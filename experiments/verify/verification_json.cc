#include "experiments/verify/verification_json.h"

#include <nlohmann/json.hpp>

#include "experiments/verify/not_examined.h"

namespace halfstep::verify {

using nlohmann::ordered_json;

std::string VerificationJson(const std::vector<MethodVerification>& results) {
  ordered_json methods = ordered_json::array(), not_examined = ordered_json::array();
  bool of_episode = false;
  for (const MethodVerification& result : results) {
    ordered_json not_covered = ordered_json::array();
    for (const auto& [kind, subject, sentence] : result.not_covered) {
      not_covered.push_back({{"kind", Name(kind)}, {"subject", subject}, {"sentence", sentence}});
    }
    of_episode = of_episode || result.of_episode;
    methods.push_back({{"method", result.method},
                       {"verified", result.verified},
                       {"claimed", result.claimed},
                       {"readable", result.readable},
                       {"checks", result.lines},
                       {"too_coarse", result.too_coarse},
                       {"reasons", result.reasons},
                       {"disagreements", result.disagreements},
                       {"complaints", result.complaints},
                       {"statement", result.statement},
                       {"not_examined", result.not_examined},
                       {"remark", result.remark},
                       {"not_covered", not_covered}});
  }
  for (const NotExamined& one : of_episode ? NotExaminedOfEpisode() : NotExaminedOfRun()) {
    not_examined.push_back({{"file", one.file}, {"name", one.name}, {"why", one.why}});
  }
  return ordered_json{{"methods", methods}, {"not_examined", not_examined}}.dump(
             2, ' ', false, ordered_json::error_handler_t::replace) +
         "\n";
}

}  // namespace halfstep::verify
