#include "experiments/config/random_scenes.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "planner/search/plan_shortcut.h"
#include "wpg/check.h"
#include "wpg/elementary.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

// Written to 0.1 mm, so that the text says exactly what is there.
std::string Metres(double value) { return Formatted("%.4f", value); }

std::string CylinderYaml(int i, double x, double y, double radius, double length) {
  return "  - name: cylinder " + std::to_string(i) +
         "\n    cylinder: {radius_m: " + Metres(radius) + ", length_m: " + Metres(length) +
         "}\n    pose: {xyz: [" + Metres(x) + ", " + Metres(y) + ", " + Metres(0.5 * length) +
         "]}\n";
}

std::string BoxYaml(int i, double x, double y, double length, double width, double height,
                    double yaw_deg) {
  return "  - name: box " + std::to_string(i) + "\n    box: {size_m: [" + Metres(length) + ", " +
         Metres(width) + ", " + Metres(height) + "]}\n    pose: {xyz: [" + Metres(x) + ", " +
         Metres(y) + ", " + Metres(0.5 * height) + "], rpy_deg: [0, 0, " + Metres(yaw_deg) + "]}\n";
}

std::string DrawCylinder(int i, std::mt19937_64& random) {
  const double x = Uniform(0.2, 2.8, random), y = Uniform(-0.8, 0.8, random);
  const double radius = Uniform(0.01, 0.03, random);
  return CylinderYaml(i, x, y, radius, Uniform(0.01, 0.1, random));
}

std::string DrawFurniture(int i, std::mt19937_64& random) {
  constexpr double kCorner = 1.5, kRoom = 0.6;
  double x = 0.0, y = 0.0;
  do {
    x = Uniform(-2.0, 2.0, random);
    y = Uniform(-2.0, 2.0, random);
  } while (Hypot(std::fabs(x) - kCorner, std::fabs(y) - kCorner) < kRoom);
  const double height = 0.02 * Pow(50.0, Uniform(0.0, 1.0, random));
  if (i % 2 == 0) return CylinderYaml(i, x, y, Uniform(0.03, 0.15, random), height);
  const double length = Uniform(0.05, 0.4, random), width = Uniform(0.05, 0.4, random);
  return BoxYaml(i, x, y, length, width, height, Uniform(-90.0, 90.0, random));
}

// Blocks stand in a field of five rows of 40 cm, in front of who stands at the origin.
std::string DrawBlock(int i, std::mt19937_64& random) {
  constexpr double kEdge = 0.4, kFirst = 0.3;
  constexpr int kRows = 5, kHeights = 16;
  const double x = kFirst + kEdge * ((i - 1) / kRows), y = kEdge * ((i - 1) % kRows - 0.5 * kRows);
  const double height = 0.01 * std::floor(Uniform(0.0, kHeights, random));
  if (height == 0.0) return "";
  const auto corner = [](double cx, double cy) {
    return "[" + Metres(cx) + ", " + Metres(cy) + "]";
  };
  return "  - name: block_" + std::to_string(i) + "\n    polygon_m: [" + corner(x, y) + ", " +
         corner(x + kEdge, y) + ", " + corner(x + kEdge, y + kEdge) + ", " + corner(x, y + kEdge) +
         "]\n    height_m: " + Metres(height) + "\n";
}

std::string DrawItem(const std::string& name, int i, std::mt19937_64& random) {
  if (name == "blocks") return DrawBlock(i, random);
  return name == "cylinders" ? DrawCylinder(i, random) : DrawFurniture(i, random);
}

}  // namespace

std::vector<std::string> RandomSceneNames() { return {"cylinders", "random_room", "blocks"}; }

std::string DrawScene(const std::string& name, int count, std::uint64_t seed) {
  HALFSTEP_CHECK(count >= 0, "count = " << count);
  const std::vector<std::string> names = RandomSceneNames();
  HALFSTEP_CHECK(std::ranges::find(names, name) != names.end(), "no random scene " << name);
  std::mt19937_64 random(seed);
  std::string items;
  for (int i = 1; i <= count; ++i) items += DrawItem(name, i, random);
  const std::string list = name == "blocks" ? "surfaces" : "obstacles";
  return "# halfstep draw " + name + " --count " + std::to_string(count) + " --seed " +
         std::to_string(seed) + "\nname: " + name + "\n" + list + ":" +
         (items.empty() ? " []" : "") + "\n" + items;
}

}  // namespace halfstep
