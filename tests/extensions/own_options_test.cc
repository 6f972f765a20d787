// A method of a user's own declares options, which are read as strictly as those that are built in.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "experiments/config/experiment_config.h"
#include "experiments/run/experiment_run.h"
#include "experiments/run/smoothing_of.h"
#include "experiments/verify/own_names.h"
#include "smoothing/methods/dichotomy.h"
#include "smoothing/methods/methods.h"
#include "tests/places.h"
#include "wpg/files/input_error.h"
#include "wpg/files/regular_file.h"

namespace halfstep {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

const std::string kConfig = InSources("experiments/configs/fig3_two_half_steps.yaml");

struct PartOptions {
  double part = 0.25;  // of every natural bound
  double tilt = 0.5;   // [rad]
  std::string order = "onwards";
  bool twice = false;
};

void DeclareFields(Fields& fields, PartOptions* o) {
  fields.Number("part", &o->part, {.meaning = "of every overlap's bound", .min = 0, .max = 1});
  fields.Number("tilt_deg", &o->tilt, {.meaning = "of nothing", .unit = "deg"});
  fields.Text("order", &o->order, {.meaning = "of junctions", .choices = {"onwards", "back"}});
  fields.Boolean("twice", &o->twice, {.meaning = "proposes it twice"});
}

const OptionGroup<PartOptions> kPart{"mine/part", "of the method mine/part"};

// Proposes one walk: part of every overlap.
class Part : public Smoother {
 public:
  explicit Part(std::string name = "mine/part", std::vector<DeclaredGroup> groups = {kPart})
      : name_(std::move(name)), groups_(std::move(groups)) {}
  std::string name() const override { return name_; }
  std::string meaning() const override { return "of a test"; }
  std::vector<DeclaredGroup> groups() const override { return groups_; }
  SmoothingResult Smooth(const WalkProblem& problem, const MethodOptions& options,
                         SmoothingMonitor& monitor) const override {
    if (!monitor.BeginFeasibly(problem, problem.Start())) return monitor.Refusal();
    HomotopyParameters candidate = problem.Start();
    for (int i = 0; i < problem.sequence().num_junctions(); ++i) {
      candidate.overlaps[static_cast<size_t>(i)] =
          options.Get(kPart).part * NaturalOverlapBound(candidate, i);
    }
    const bool proved = monitor.Propose(candidate);
    return monitor.Finish(opt::Ending::kConverged, proved ? "proved" : "refused");
  }

 private:
  std::string name_;
  std::vector<DeclaredGroup> groups_;
};

Methods WithPart() {
  Methods methods = Methods::Standard();
  methods.Add(std::make_shared<Part>());
  return methods;
}

ExperimentConfig Load(std::vector<YamlOverride> overrides, const Methods& methods = WithPart()) {
  overrides.push_back({"smoothing.methods", "[mine/part]"});
  return LoadConfig(kConfig, overrides, {methods});
}

std::string ComplaintOf(const std::vector<YamlOverride>& overrides,
                        const Methods& methods = WithPart()) {
  try {
    (void)LoadConfig(kConfig, overrides, {methods});
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string Written(ExperimentConfig config) {
  return WriteYaml([&](Fields& fields) { DeclareFields(fields, &config); });
}

TEST(OwnOptions, AreReadAndWrittenBack) {
  EXPECT_EQ(Load({}).smoothing.options.Get(kPart).part, 0.25);
  const ExperimentConfig config =
      Load({{"smoothing.own.mine/part.part", "0.125"}, {"smoothing.own.mine/part.order", "back"}});
  EXPECT_EQ(config.smoothing.options.Get(kPart).part, 0.125);
  EXPECT_EQ(config.smoothing.options.Get(kPart).order, "back");
  const std::string text = Written(config);
  EXPECT_THAT(text, HasSubstr("  own:\n    mine/part:\n      part: 0.125\n"));
  const ExperimentConfig again = ParseConfig(kConfig, text, {}, {WithPart()});
  EXPECT_EQ(again.smoothing.options.Get(kPart).part, 0.125);
  EXPECT_EQ(Written(again), text);
}

TEST(OwnOptions, AreReadStrictly) {
  EXPECT_THAT(ComplaintOf({{"smoothing.own.mine/part.part", "2"}}),
              HasSubstr("smoothing.own.mine/part.part: 2 is out of range (valid: 0 … 1)"));
  EXPECT_THAT(ComplaintOf({{"smoothing.own.mine/part.parts", "1"}}),
              HasSubstr("smoothing.own.mine/part.parts: unknown key (did you mean 'part'?"));
  EXPECT_THAT(ComplaintOf({{"smoothing.own.mine/other.part", "1"}}),
              HasSubstr("smoothing.own.mine/other: unknown key"));
}

TEST(OwnOptions, AreUnknownToAProgramWithoutTheMethod) {
  const Methods none = Methods::Standard();
  const char* const refusal = "smoothing.own: there is none: this program added no methods";
  EXPECT_THAT(ComplaintOf({{"smoothing.own.mine/part.part", "0.1"}}, none), HasSubstr(refusal));
  EXPECT_THAT(ComplaintOf({{"smoothing.own", "{}"}}, none), HasSubstr(refusal));
  EXPECT_THAT(Written(LoadConfig(kConfig, {}, {none})), Not(HasSubstr("\n  own:")));
  const auto has_own = [](const std::vector<KeyDescription>& keys) {
    for (const KeyDescription& key : keys) {
      if (key.path != "smoothing") continue;
      return std::ranges::any_of(key.keys, [](const auto& k) { return k.path == "smoothing.own"; });
    }
    return false;
  };
  EXPECT_FALSE(has_own(ConfigKeys({none})));
  EXPECT_TRUE(has_own(ConfigKeys({WithPart()})));
}

TEST(OwnOptions, ComeToTheMethodAndIntoTheManifest) {
  const RunHooks hooks{.progress = [](const std::string&, double) {}, .stop = {}};
  ExperimentRun run(
      Load({{"smoothing.own.mine/part.part", "0.125"}, {"smoothing.own.mine/part.tilt_deg", "30"}}),
      hooks);
  run.Smooth(hooks);
  run.Certify({});
  EXPECT_EQ(run.runs().back().result.message, "proved");
  const HomotopyParameters& walk = run.runs().back().result.parameters;
  EXPECT_DOUBLE_EQ(walk.overlaps[0], 0.125 * NaturalOverlapBound(walk, 0));
  const std::filesystem::path place = testing::TempDir() + "/own_options_run";
  RunFolder folder(place, /*overwrite=*/true);
  run.Write(&folder);
  folder.Publish();
  const auto read = [&](const char* name) {
    return ReadRegularFile((place / name).string(), 1 << 20);
  };
  const json manifest = json::parse(read("manifest.json"));
  EXPECT_EQ(manifest["methods"][1]["requested"], json::parse(R"({"variables": "overlaps",
      "part": 0.125, "tilt_deg": 30.0, "order": "onwards", "twice": false})"));
  EXPECT_THAT(read("config.yaml"), HasSubstr("part: 0.125"));

  // A program that does not have the method reads the config with what it does not know left out.
  const verify::OwnNames own = verify::FindOwnNames("config.yaml", read("config.yaml"));
  EXPECT_THAT(own.told, testing::ElementsAre("the method mine/part", "the options mine/part"));
  EXPECT_TRUE(ParseConfig((place / "config.yaml").string(), read("config.yaml"), own.overrides)
                  .smoothing.methods.empty());
  EXPECT_TRUE(
      verify::FindOwnNames("config.yaml", read("config.yaml"), {WithPart()}).overrides.empty());
}

struct OtherOptions {
  int number = 1;
};
void DeclareFields(Fields& fields, OtherOptions* o) {
  fields.Integer("number", &o->number, {.meaning = "of a test"});
}

TEST(OwnOptions, HaveAKeyThatIsANameAndOneType) {
  Methods methods = WithPart();
  const auto add = [&](const char* name, DeclaredGroup group) {
    methods.Add(std::make_shared<Part>(name, std::vector<DeclaredGroup>{std::move(group)}));
  };
  for (const char* key : {"", "a.b", "a b", "a:"}) {
    EXPECT_THROW(add("mine/a", OptionGroup<PartOptions>{key, ""}), std::invalid_argument) << key;
  }
  EXPECT_THROW(add("mine/a", OptionGroup<OtherOptions>{"mine/part", ""}), std::invalid_argument);
  EXPECT_THROW(add("mine/a", OptionGroup<OtherOptions>{"dichotomy", ""}), std::invalid_argument);
  EXPECT_EQ(methods.Names(), WithPart().Names());
  add("mine/a", kPart);             // shared
  add("mine/b", DichotomyGroup());  // that of a method that is built in
  EXPECT_EQ(methods.OwnGroups().size(), 1u);
  MethodOptions options;
  options.Edit(kPart).part = 0.5;
  EXPECT_THROW((void)options.Get(OptionGroup<OtherOptions>{"mine/part", ""}), std::logic_error);
}

}  // namespace
}  // namespace halfstep
