#include "wpg/robot/urdf_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/temporary_folder.h"
#include "tests/wpg/repeated.h"
#include "wpg/files/input_error.h"

namespace halfstep {
namespace {

using testing::HasSubstr;

std::string Link(const std::string& name) { return "<link name=\"" + name + "\"/>\n"; }

std::string Joint(const std::string& parent, const std::string& child) {
  return "<joint name=\"to_" + child + "\" type=\"fixed\"><parent link=\"" + parent +
         "\"/><child link=\"" + child + "\"/></joint>\n";
}

// Links that hang on one another, the first on `root`.
std::string Chain(const std::string& root, int links) {
  std::string text = Link(root);
  for (int i = 1; i <= links; ++i) {
    const std::string name = "l" + std::to_string(i);
    text += Link(name) + Joint(i == 1 ? root : "l" + std::to_string(i - 1), name);
  }
  return text;
}

std::vector<std::string> UrdfComplaints(const std::string& robot) {
  const TemporaryFolder place;
  try {
    ReadUrdf(WriteText(place / "robot.urdf", "<robot name='r'>" + robot + "</robot>"));
  } catch (const InputError& error) {
    return error.complaints();
  }
  return {};
}

TEST(ReadUrdf, RefusesDeepElementsBeforeTheyAreParsed) {
  for (const int levels : {64, 40'000, 400'000}) {
    EXPECT_THAT(UrdfComplaints(Repeated("<a>", levels) + Repeated("</a>", levels)),
                testing::ElementsAre(HasSubstr("nests too deeply")))
        << levels;
  }
  EXPECT_THAT(UrdfComplaints(Link("l") + Repeated("<a>", 63) + Repeated("</a>", 63)),
              testing::IsEmpty());
}

TEST(ReadUrdf, TakesALongChainAndRefusesALongerOne) {
  const TemporaryFolder place;
  const UrdfTree tree = ReadUrdf(
      WriteText(place / "chain.urdf", "<robot name='r'>" + Chain("root", 4999) + "</robot>"));
  EXPECT_EQ(tree.links.size(), 5000u);
  EXPECT_EQ(tree.joints.size(), 4999u);
  EXPECT_THAT(UrdfComplaints(Chain("root", 5000)),
              testing::ElementsAre(HasSubstr("has 5001 links (valid: at most 5000)")));
}

TEST(ReadUrdf, NamesEveryLinkThatLeadsToARing) {
  const std::string ring = Link("a") + Link("b") + Link("c") + Joint("a", "b") + Joint("b", "c") +
                           Joint("c", "a") + Link("below") + Joint("b", "below");
  const std::vector<std::string> complaints = UrdfComplaints(Chain("root", 3) + ring);
  EXPECT_EQ(complaints.size(), 4u);
  for (const std::string& complaint : complaints) {
    EXPECT_THAT(complaint, HasSubstr("hangs on itself through a ring of joints"));
  }
}

}  // namespace
}  // namespace halfstep
