#pragma once

#include <optional>
#include <string>

#include "planner/swept/swept_volume_bake.h"

namespace halfstep {

/// $XDG_CACHE_HOME/halfstep, or $HOME/.cache/halfstep; "" when neither variable is a path from /.
std::string DefaultCacheFolder();

/// All that swept volumes depend on, as text, one thing a line: versions of format and generator,
/// the robot's hash (of legs, heights and bodies, as they were loaded), half-step parameters,
/// placements' hash, resolution, clearance. Numbers are written exactly.
std::string SweptVolumeProvenance(const RobotModel& robot, const MotionModel& model,
                                  const StepSet& set, const SweptVolumeOptions& options);

/// The result of LoadOrBakeSweptVolumes.
struct CachedVolumes {
  std::optional<SweptVolumes> volumes;  ///< none when stopped
  bool baked = false;                   ///< baked now, else read from the cache
  std::string path;                     ///< of the cache file
  std::string refused;   ///< a sentence why a file that was there was not used, or ""
  std::string not_kept;  ///< a sentence why the result could not be written, or ""
};

/// Volumes from the file `<robot>-<hash of the provenance>.swept` in `folder`, or baked and written
/// there. Each element that is done is written to a part file, so that a bake that was stopped or
/// killed continues where it was; several bakes at once share them. Files of another provenance,
/// cut or damaged ones are refused and baked again. Hooks `recall` and `keep` shall be empty.
/// Without a folder, or when it cannot be written, the volumes are returned but not cached.
CachedVolumes LoadOrBakeSweptVolumes(const RobotModel& robot, const MotionModel& model,
                                     const StepSet& set, const SweptVolumeOptions& options,
                                     const std::string& folder, BakeHooks hooks = {});

/// Where one element's part file is, while the bake is under way.
std::string PartPath(const std::string& cache_path, int element);

}  // namespace halfstep
