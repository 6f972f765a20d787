#include "experiments/verify/verify_run.h"

#include <algorithm>
#include <filesystem>

#include "experiments/verify/csv_text.h"
#include "experiments/verify/episode_text.h"
#include "experiments/verify/findings.h"
#include "experiments/verify/not_examined.h"
#include "experiments/verify/run_manifest.h"
#include "experiments/verify/verify_episode.h"
#include "experiments/verify/verify_method.h"
#include "wpg/check.h"
#include "wpg/files/input_error.h"
#include "wpg/files/suggestion.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"

namespace halfstep::verify {
namespace {

namespace fs = std::filesystem;

bool HasCertificate(const fs::path& folder) {
  return fs::exists(folder / "certificate.json") || fs::exists(folder / "certificate.csv");
}

// The methods of a run, whether they have a certificate or not.
std::vector<fs::path> Folders(const VerifyOptions& options, const RunManifest& manifest) {
  const fs::path run(options.run);
  std::vector<fs::path> folders;
  for (const RunManifest::Method& method : manifest.methods) {
    folders.push_back(run / FolderOfMethod(method.name));
  }
  for (const auto& entry : fs::directory_iterator(run)) {
    if (!entry.is_directory()) continue;
    if (HasCertificate(entry.path()) || fs::exists(entry.path() / "trajectory.csv")) {
      folders.push_back(entry.path());
    }
  }
  std::sort(folders.begin(), folders.end());
  folders.erase(std::unique(folders.begin(), folders.end()), folders.end());
  if (std::none_of(folders.begin(), folders.end(), HasCertificate)) {
    throw InputError({options.run + ": no certificate in it (`halfstep certify` makes them)"});
  }
  if (!options.method) return folders;
  std::string name = *options.method;
  std::replace(name.begin(), name.end(), '/', '_');
  std::string names;
  for (const fs::path& folder : folders) {
    if (!HasCertificate(folder)) continue;
    if (folder.filename() == name) return {folder};
    names += (names.empty() ? "" : ", ") + folder.filename().string();
  }
  throw InputError({options.run + ": no certificate of the method " + Quote(*options.method) +
                    " (valid: " + names + ")"});
}

// Whether the run itself says of its plan, `raw`, that it is not feasible.
bool IsInfeasiblePlan(const std::string& method, const RunManifest& manifest) {
  return std::ranges::any_of(manifest.methods, [&](const RunManifest::Method& one) {
    return method == "raw" && one.name == method && one.status == "failed" &&
           one.verdict == "violated";
  });
}

// Makes the result of a check, which may throw InputError.
template <typename Check>
MethodVerification Verified(const std::string& method, const Check& check) {
  MethodVerification result;
  result.method = method;
  Findings findings;
  try {
    check(&result, &findings);
    result.too_coarse = findings.too_coarse();
    result.remark = findings.remark();
    result.verified = findings.disagreements() == 0 && result.too_coarse.empty();
  } catch (const InputError& error) {
    result.readable = false;
    result.complaints = error.complaints();
  }
  result.lines = findings.lines();
  result.not_examined = findings.not_examined();
  result.reasons = findings.reasons();
  result.disagreements = findings.disagreements();
  return result;
}

}  // namespace

std::vector<MethodVerification> VerifyRun(const VerifyOptions& options) {
  HALFSTEP_CHECK(options.prove.of_run && options.prove.of_episode, "nothing proves walks");
  if (options.tolerance && !(*options.tolerance >= 0 && *options.tolerance <= 1)) {
    throw InputError({"--tolerance: out of range (valid: 0 … 1 m)"});
  }
  const fs::path manifest_path = fs::path(options.run) / "manifest.json";
  if (!fs::is_directory(options.run) || !fs::exists(manifest_path)) {
    throw InputError({options.run + ": no such run folder (" + DidYouMeanRun(options.run) +
                      "valid: a folder that `halfstep run` wrote)"});
  }
  const std::string manifest_text = ReadBytes(manifest_path.string());
  if (IsOfEpisode(manifest_path.string(), manifest_text)) {
    if (options.method) {
      throw InputError({"--method: an episode has none (valid: without it)"});
    }
    return {Verified("episode", [&](MethodVerification* result, Findings* findings) {
      result->of_episode = true;
      result->not_covered = VerifyEpisode(options, manifest_text, findings);
    })};
  }
  const RunManifest manifest = ReadManifest(manifest_path.string(), manifest_text);
  std::vector<MethodVerification> results;
  for (const fs::path& folder : Folders(options, manifest)) {
    results.push_back(
        Verified(folder.filename().string(), [&](MethodVerification* result, Findings* findings) {
          if (HasCertificate(folder)) {
            const VerifiedStatement verified =
                VerifyMethod(options, manifest, result->method, findings);
            result->statement = verified.statement;
            result->not_covered = verified.not_covered;
            result->claimed = verified.claimed || !IsInfeasiblePlan(result->method, manifest);
          } else {
            findings->Disagree("there is no certificate (`halfstep certify` makes it)");
          }
        }));
  }
  if (std::ranges::none_of(results, &MethodVerification::verified)) {
    for (MethodVerification& result : results) result.claimed = true;
  }
  return results;
}

std::string Summary(const MethodVerification& result) {
  constexpr std::ptrdiff_t kMost = 3;
  std::string text = Formatted("%-22s ", result.method.c_str());
  if (!result.readable) return text + "cannot be read\n";
  if (!result.claimed) return text + "not certified, as its certificate says\n";
  if (result.verified) {
    text += Formatted("verified (%zu checks)", result.lines.size());
    if (!result.remark.empty()) text += ", but " + result.remark;
    for (const std::string& what : result.not_examined) text += "\n  not examined: " + what;
    return text + "\n";
  }
  if (result.disagreements == 0) return text + "too coarse to verify: " + result.too_coarse + "\n";
  text += "NOT verified\n";
  const std::ptrdiff_t told = std::min(kMost, std::ssize(result.reasons));
  for (std::ptrdiff_t i = 0; i < told; ++i) {
    text += "  " + Nth(result.reasons, i) + "\n";
  }
  const long more = result.disagreements - told;
  return text + (more > 0 ? "  … and " + Count(more) + " more\n" : "");
}

std::string TellNotExamined(const MethodVerification& result) {
  return NotExaminedText(result.of_episode ? NotExaminedOfEpisode() : NotExaminedOfRun());
}

std::string Describe(const MethodVerification& result) {
  std::string text = result.method + "\n";
  for (const std::string& line : result.lines) text += "  " + line + "\n";
  if (!result.not_covered.empty()) text += "  not covered:\n";
  for (const NotCovered& one : result.not_covered) text += "    " + one.sentence + "\n";
  for (const std::string& what : result.not_examined) text += "  not examined: " + what + "\n";
  if (!result.readable) {
    text += "  cannot be read:\n";
    for (const std::string& line : result.complaints) text += "    " + line + "\n";
  } else if (result.verified) {
    text += "  verified" + (result.remark.empty() ? "" : ", but " + result.remark) + "\n";
  } else if (result.disagreements == 0) {
    text += "  too coarse to verify: " + result.too_coarse + "\n";
  }
  if (result.disagreements > 0) {
    text += result.claimed ? "  NOT verified:\n" : "  not certified, as its certificate says:\n";
    for (const std::string& reason : result.reasons) text += "    " + reason + "\n";
    const long more = result.disagreements - std::ssize(result.reasons);
    if (more > 0) text += "    … and " + Count(more) + " more\n";
  }
  if (result.statement.empty()) return text;
  // A statement that could write anything on a terminal is not repeated.
  const bool clean = FindInvalidUtf8(result.statement) == std::string::npos &&
                     !HasControlCharacter(result.statement);
  text += "  The certificate's statement: " + (clean ? result.statement : Quote(result.statement)) +
          "\n";
  return text;
}

}  // namespace halfstep::verify
