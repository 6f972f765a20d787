#pragma once

#include <string>

#include "experiments/verify/derived_promise.h"
#include "experiments/verify/episode_text.h"
#include "experiments/verify/findings.h"
#include "experiments/verify/promise_text.h"

namespace halfstep::verify {

/// What manifest.json says of an episode's promise, and of what it could be judged by.
struct EpisodePromise {
  PromiseText said;               ///< `promise` of the manifest
  bool in_physics = false;        ///< a simulated robot executed the walk
  bool has_physics_file = false;  ///< it lists physics.csv
  bool killed = false;            ///< what clients did to the world is not in the script
  double waited = 0;              ///< before time 0 [s]
};

/// Reads it. Throws InputError when there is no promise in it.
EpisodePromise ReadEpisodePromise(const std::string& path, const std::string& manifest_text,
                                  const EpisodeManifest& manifest);

/// Whether what manifest.json says of the promise is so: which obstacles and areas did not keep it,
/// from when, by how much, when the robot walked without proof of its clearance from them, which
/// keys would have covered it, and which obstacles were touched from when on. All of this is
/// derived anew, from measured places, and from the script where it says what was true. Of an
/// episode in physics what was true is not examined: there the record must say at least what
/// measurements tell. events.csv must have a row `contradicted` for each obstacle or area of a
/// frame that contradicts what was known. Says what it found, also as a remark when the promise did
/// not hold. Precondition: numbers that name rows name one (CheckEpisodeNumbers,
/// CheckGrantNumbers).
void CheckEpisodePromise(const EpisodePromise& promise, const PromiseRecord& record,
                         Findings* findings);

}  // namespace halfstep::verify
