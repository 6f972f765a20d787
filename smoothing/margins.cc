#include "smoothing/margins.h"

namespace halfstep {
namespace {

struct FamilyInfo {
  std::string_view name;
  std::string_view unit;
  double scale;
};

constexpr std::array<FamilyInfo, kNumMarginFamilies> kFamilies = {{
    {"floor", "m", 0.01},
    {"foot_speed", "m/s", 0.1},
    {"foot_yaw_rate", "rad/s", 0.2},
    {"zmp", "m", 0.01},
    {"reach", "m", 0.01},
    {"joint", "rad", 0.05},
    {"joint_speed", "rad/s", 0.5},
    {"self_clearance", "m", 0.01},
    {"clearance", "m", 0.01},
    {"ground", "m", 0.01},
    {"no_step", "m", 0.01},
}};

const FamilyInfo& Info(MarginFamily family) { return kFamilies[static_cast<size_t>(family)]; }

}  // namespace

std::string_view Name(MarginFamily family) { return Info(family).name; }
std::string_view Unit(MarginFamily family) { return Info(family).unit; }
double Scale(MarginFamily family) { return Info(family).scale; }

}  // namespace halfstep
