#include "tests/verify/scaled_hrp2.h"

#include <cmath>
#include <functional>
#include <regex>
#include <string>

#include "tests/temporary_folder.h"
#include "wpg/files/number_text.h"

namespace halfstep {
namespace {

// Replaces every match of a pattern by what a function makes of its first group.
std::string ReplaceEach(const std::string& text, const std::string& pattern,
                        const std::function<std::string(const std::string&)>& by) {
  const std::regex expression(pattern);
  std::string out;
  auto from = text.begin();
  for (std::sregex_iterator it(text.begin(), text.end(), expression), end; it != end; ++it) {
    const auto& group = (*it)[1];
    out.append(from, group.first).append(by(group.str()));
    from = group.second;
  }
  return out.append(from, text.end());
}

}  // namespace

void ScaleHrp2(const std::filesystem::path& folder, double size) {
  const auto times = [](double factor) {
    return [factor](const std::string& numbers) {
      return ReplaceEach(numbers, "([-+.0-9e]+)",
                         [&](const std::string& x) { return ShortestText(std::stod(x) * factor); });
    };
  };
  const std::filesystem::path urdf = folder / "hrp2.urdf", yaml = folder / "hrp2.yaml";
  std::string text = ReadText(urdf);
  text = ReplaceEach(text, "<origin xyz=\"([^\"]*)\"", times(size));
  text = ReplaceEach(text, "<mass value=\"([^\"]*)\"", times(std::pow(size, 3)));
  for (const char* moment : {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"}) {
    text = ReplaceEach(text, std::string(moment) + "=\"([^\"]*)\"", times(std::pow(size, 5)));
  }
  text = ReplaceEach(text, "velocity=\"([^\"]*)\"", times(1 / std::sqrt(size)));
  const std::string n = ShortestText(size);
  text = ReplaceEach(text, "<mesh filename=\"[^\"]*(\")/>", [&](const std::string&) {
    return "\" scale=\"" + n + " " + n + " " + n + "\"";
  });
  WriteText(urdf, text);
  text = ReadText(yaml);
  text = ReplaceEach(text, "com_height_m: (\\S+)", times(size));
  text = ReplaceEach(text, "sole_xyz: \\[([^\\]]*)\\]", times(size));
  text = ReplaceEach(text, "sole_size_m: \\[([^\\]]*)\\]", times(size));
  text = ReplaceEach(text, "LEG_JOINT[0-5]: (200)", times(std::pow(size, 4)));
  WriteText(yaml, text);
}

void GiveHrp2Efforts(const std::filesystem::path& folder) {
  WriteText(folder / "hrp2.yaml",
            std::regex_replace(ReadText(folder / "hrp2.yaml"), std::regex("(LEG_JOINT[0-5]): none"),
                               "$1: 200"));
}

}  // namespace halfstep
