#include "experiments/commands/verify_command.h"

#include <algorithm>
#include <iostream>
#include <memory>

#include "experiments/checker/prove_walk.h"
#include "experiments/commands/command_line.h"
#include "experiments/verify/verification_json.h"

namespace halfstep {
namespace {

enum class Telling { kErrors, kSummary, kEverything, kJson };

// Nothing of the smoothing takes part.
ExitStatus Verify(const verify::VerifyOptions& options, Telling telling) {
  const bool quiet = telling == Telling::kErrors;
  std::vector<NotCovered> not_covered;  // by the certificates, which are of one robot and scene
  const std::vector<verify::MethodVerification> results = verify::VerifyRun(options);
  for (const verify::MethodVerification& result : results) {
    if (telling == Telling::kSummary || telling == Telling::kEverything) {
      std::cout << (telling == Telling::kSummary ? verify::Summary(result)
                                                 : verify::Describe(result));
    }
    if (!result.not_covered.empty()) not_covered = result.not_covered;
    for (const std::string& complaint : result.complaints) std::cerr << complaint << '\n';
    for (const std::string& what : result.not_examined) {
      if (quiet) std::cerr << result.method << ": not examined: " << what << '\n';
    }
    if (quiet && result.claimed && result.disagreements > 0) {
      std::cerr << result.method << ": NOT verified: " << result.reasons.front() << '\n';
    }
    if (quiet && result.disagreements == 0 && !result.too_coarse.empty()) {
      std::cerr << result.method << ": too coarse to verify: " << result.too_coarse << '\n';
    }
  }
  if (telling == Telling::kSummary) {
    std::cout << NotCoveredText(not_covered, "--verbose")
              << "(--verbose shows every check, what a verified certificate guarantees, and what "
                 "is not examined)\n";
  } else if (telling == Telling::kEverything) {
    std::cout << "\nNot examined:\n" << verify::TellNotExamined(results.front());
  } else if (telling == Telling::kJson) {
    std::cout << verify::VerificationJson(results);
  }
  return StatusOf(results);
}

}  // namespace

ExitStatus StatusOf(const std::vector<verify::MethodVerification>& results) {
  using Result = verify::MethodVerification;
  if (!std::ranges::all_of(results, &Result::readable)) return kBadInput;
  const auto is_refused = [](const Result& one) { return one.claimed && one.disagreements > 0; };
  if (std::ranges::any_of(results, is_refused)) return kNotVerified;
  const auto is_settled = [](const Result& one) { return one.verified || !one.claimed; };
  return std::ranges::all_of(results, is_settled) ? kSuccess : kTooCoarse;
}

CommandAction DeclareVerify(CLI::App* app, const Toolbox& tools) {
  const auto options = std::make_shared<verify::VerifyOptions>();
  options->prove = checker::ProverOfWalks();
  options->tools = tools;
  const auto quiet = std::make_shared<bool>(false), verbose = std::make_shared<bool>(false),
             json = std::make_shared<bool>(false);
  app->add_option("RUN", options->run, "run folder")->required();
  app->add_option("--method", options->method, "only this one (default: all)");
  app->add_option(
      "--tolerance", options->tolerance,
      "between the certified walk and its trajectory, 0.001 · ℓ/0.705 m by default [m]");
  app->add_option("--robot", options->robot, "robot file in place of the certificate's");
  app->add_option("--scene", options->scene, "scene file in place of it, or none");
  CLI::Option* only_errors = app->add_flag("--quiet", *quiet, "print nothing but what is wrong");
  CLI::Option* everything =
      app->add_flag("--verbose", *verbose,
                    "print every check, the certificate's statement, and what is not examined")
          ->excludes(only_errors);
  app->add_flag("--json", *json, "print all of it as JSON")
      ->excludes(only_errors)
      ->excludes(everything);
  return [options, quiet, verbose, json] {
    return Verify(*options, *quiet     ? Telling::kErrors
                            : *json    ? Telling::kJson
                            : *verbose ? Telling::kEverything
                                       : Telling::kSummary);
  };
}

}  // namespace halfstep
