// A URDF as a tree, without a robot file and without meshes.

#include "tests/fuzz/fuzz.h"
#include "wpg/robot/urdf_file.h"

using namespace halfstep;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  UrdfTree tree;
  const std::string text = fuzz::Text(data, size);
  if (!fuzz::Reads("fuzz.urdf", [&] { tree = ParseUrdf("fuzz.urdf", text); })) return 0;
  fuzz::Require(tree.links.size() == tree.joints.size() + 1, "links and joints are no tree");
  for (const UrdfJoint& joint : tree.joints) {
    const auto links = static_cast<int>(tree.links.size());
    fuzz::Require(joint.parent >= 0 && joint.parent < joint.child && joint.child < links,
                  "a link comes before what it hangs on");
    fuzz::Require(joint.X_ParentChild.matrix().allFinite() && joint.axis.allFinite(),
                  "a joint's place is not finite");
  }
  (void)tree.LinkPoses(std::vector<double>(tree.joints.size(), 0.5));
  return 0;
}
