#include "experiments/verify/walk_prover.h"

#include <array>
#include <limits>

#include "wpg/files/input_error.h"
#include "wpg/files/text.h"

namespace halfstep::verify {
namespace {

// By family; the last one is of statements that belong to none.
constexpr std::array<const char*, kNumFamilies> kNames = {"height of a moving sole",
                                                          "foot speed",
                                                          "foot yaw rate",
                                                          "ZMP",
                                                          "leg reach",
                                                          "joint limits",
                                                          "joint speeds",
                                                          "self clearance",
                                                          "clearance",
                                                          "bodies above the floor",
                                                          "no-step areas",
                                                          "ZMP of the whole robot",
                                                          "joint torques",
                                                          "friction",
                                                          "joint accelerations",
                                                          "ZMPs from foot to foot",
                                                          "landing speed",
                                                          "soles inside their levels",
                                                          "one foot in the air at most"};

void TellFamily(size_t number, const std::vector<ProvedStatement>& all, Findings* findings) {
  const std::string name = kNames[number];
  long count = 0;
  const ProvedStatement* nearest = nullptr;
  Faults faults;
  for (const ProvedStatement& one : all) {
    if (static_cast<size_t>(one.family.value_or(kOwn)) != number) continue;
    ++count;
    if (one.proved) {
      if (nearest == nullptr || one.least - one.demanded < nearest->least - nearest->demanded) {
        nearest = &one;
      }
      continue;
    }
    faults.Add(name + ": " + one.subject +
               Formatted(" at t = %.6g s: %.6g, demanded %.6g", one.at, one.least, one.demanded));
  }
  faults.Conclude(findings);
  if (count == 0) return;
  std::string line =
      "for all t: " + name + ": " + Count(count) + (count == 1 ? " statement" : " statements");
  if (nearest != nullptr && nearest->least < std::numeric_limits<double>::infinity()) {
    line += Formatted(", each by %.6g or more (", nearest->least) + nearest->subject +
            Formatted("), demanded %.6g", nearest->demanded);
  }
  findings->Say(line);
}

}  // namespace

const char* NameOf(Family family) { return kNames[static_cast<size_t>(family)]; }

void TellProved(const std::function<ProvedStatements()>& prove, Findings* findings) {
  ProvedStatements proved;
  try {
    proved = prove();
  } catch (const InputError& error) {
    for (const std::string& complaint : error.complaints()) findings->Disagree(complaint);
    return;
  }
  const long before = findings->disagreements();
  for (size_t f = 0; f < kNames.size(); ++f) TellFamily(f, proved.statements, findings);
  if (proved.branches > 0 && findings->disagreements() == before) {
    findings->Say("stop branches keep every margin to their end: " +
                  Count(static_cast<long>(proved.branches)));
  }
}

}  // namespace halfstep::verify
