#pragma once

#include <string>
#include <vector>

#include "experiments/checker/proof_hints.h"
#include "experiments/checker/walk_run.h"

namespace halfstep::checker {

/// A proof that travels: a walk, the robot and the scene as far as statements are about them, what
/// is demanded, and directions that prove it. Format: experiments/proof.md.
struct ProofFile {
  WalkRun walk;             ///< what statements need of it; its rows of forms are complete
  ProofHints hints;         ///< `told`
  std::string run, method;  ///< where it comes from, for people
};

/// The file's text. `not_covered`: sentences on what is not stated. Every number is told to the
/// bit. Throws InputError for scenes that the format has no words for: levels.
std::string ProofText(const ProofFile& proof, const std::vector<std::string>& not_covered);

/// Throws InputError for what is no such file. That bodies lie in their spheres is tested, and that
/// frames are rotations and axes unit vectors, to 10⁻¹².
ProofFile ReadProof(const std::string& path, const std::string& text);

}  // namespace halfstep::checker
