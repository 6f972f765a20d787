#include "experiments/live/live_config.h"
#include "experiments/config/data_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/config/experiment.h"
#include "experiments/live/spare_boxes.h"
#include "experiments/live/true_world.h"
#include "tests/fixture_check.h"
#include "tests/places.h"

namespace halfstep {
namespace {

class BadEpisode : public testing::TestWithParam<std::string> {};
TEST_P(BadEpisode, IsRefusedWithItsPlace) {
  CheckFixture(GetParam(), [](const std::string& path) { LoadLiveConfig(path, {}); });
}
INSTANTIATE_TEST_SUITE_P(Fixtures, BadEpisode, testing::ValuesIn(Fixtures("live")), FixtureName);

class EpisodeThatDoesNotFit : public testing::TestWithParam<std::string> {};
TEST_P(EpisodeThatDoesNotFit, IsRefusedAtItsPlaceInTheFile) {
  CheckFixture(GetParam(), [](const std::string& path) {
    LoadEpisode(path, {}, [](const LiveConfig& config) { return config; });
  });
}
INSTANTIATE_TEST_SUITE_P(Fixtures, EpisodeThatDoesNotFit, testing::ValuesIn(Fixtures("live_scene")),
                         FixtureName);

TEST(LiveConfig, TheShippedEpisodesAreRead) {
  for (const auto& path : YamlFiles(InSources("experiments/episodes"))) {
    const LiveConfig config = LoadLiveConfig(path.string(), {});
    const Place place = LoadPlace(config.experiment);
    EXPECT_NO_THROW(TrueWorld(place.scene, config.experiment.goal, config.live)) << path;
  }
}

TEST(LiveConfig, IsReadBackAsItIsWritten) {
  for (const auto& path : YamlFiles(InSources("experiments/episodes"))) {
    LiveConfig config = LoadLiveConfig(path.string(), {});
    const auto text = [](LiveConfig* c) {
      return WriteYaml([c](Fields& fields) { DeclareFields(fields, c); });
    };
    const std::string once = text(&config);
    LiveConfig again = ParseLiveConfig(path.string(), once, {});
    EXPECT_EQ(text(&again), once) << path;
  }
}

}  // namespace
}  // namespace halfstep
