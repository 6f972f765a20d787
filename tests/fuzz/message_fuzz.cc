// A message of a client of an episode, where clients measure and where they do not.

#include "experiments/server/client_message.h"
#include "tests/fuzz/fuzz.h"

using namespace halfstep;

namespace {

Scene TwoObstacles() {
  Scene scene;
  scene.obstacles = {{.name = "bar", .shape = Box{{0.1, 0.2, 0.3}}},
                     {.name = "ball", .shape = Sphere{0.1}}};
  scene.no_step.resize(2);
  return scene;
}

ClientMessageReader ReaderOf(const char* source) {
  LiveOptions options;
  options.sensing.source = source;
  return {TwoObstacles(), options};
}

bool IsMeaningful(const ClientMessage& message) {
  if (const auto* frame = std::get_if<MeasuredFrame>(&message)) {
    for (const MeasuredFrame::Seen& seen : frame->seen) {
      const Eigen::Matrix3d R = seen.X_WO.linear();
      if (seen.obstacle >= 2 || !(seen.X_WO.translation().norm() <= 2e3) ||
          !((R * R.transpose()).isIdentity(1e-9)) || !(R.determinant() > 0)) {
        return false;
      }
    }
    for (const size_t area : frame->areas.value_or(std::vector<size_t>{})) {
      if (area >= 2) return false;
    }
    return frame->age >= 0 && (!frame->goal || frame->goal->norm() <= 2e3);
  }
  if (const auto* edit = std::get_if<Edit>(&message)) {
    if (const auto* command = std::get_if<Command>(edit)) {
      const ScriptEvent& event = command->event;
      return Commands(event) && (event.what != "walk" || event.velocity.size() == 3) &&
             (event.what != "follow" || IsPath(event.path)) &&
             (event.what != "footsteps" || !event.footsteps.empty());
    }
    const auto* carry = std::get_if<Carry>(edit);
    return carry == nullptr || (carry->obstacle < 2 && carry->to.norm() <= 2e3);
  }
  return true;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const ClientMessageReader readers[] = {ReaderOf("client"), ReaderOf("stand_in")};
  const std::string text = fuzz::Text(data, size);
  for (const ClientMessageReader& reader : readers) {
    fuzz::Reads("", [&] { fuzz::Require(IsMeaningful(reader.Read(text)), "means nothing", text); });
  }
  return 0;
}
