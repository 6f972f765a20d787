#pragma once

#include <string>
#include <vector>

#include "experiments/export/body_motion.h"

namespace halfstep {

/// A format of frames at a fixed rate, for those who learn or track motions.
struct FrameFormat {
  std::string name;    ///< after --format
  std::string ending;  ///< of its files: ".npz"
  int fps = 0;         ///< frames a second where nothing else is asked for [1/s]
};

/// `mjlab`, `lafan1` and `json`.
const std::vector<FrameFormat>& FrameFormats();
/// The format of that name; null: none.
const FrameFormat* FindFrameFormat(const std::string& name);

/// What else a file of frames depends on.
struct FrameFileOptions {
  int fps = 0;              ///< of the frames [1/s]
  std::vector<int> joints;  ///< of lafan1: all revolute joints in their order (OrderedJoints)
  bool all_links = false;   ///< of mjlab and json: see BodyMotion::Order
};

/// The bytes of a file of that format (experiments/files.md, "Export"). `path` stands for it in
/// complaints. Throws InputError for archives of 4 GiB or more. Source: [BeyondMimic], [Lafan1].
std::string FrameFile(const FrameFormat& format, const BodyMotion& motion,
                      const std::vector<BodyFrame>& frames, const FrameFileOptions& options,
                      const std::string& path);

}  // namespace halfstep
