#include "experiments/replay/mujoco_compile.h"

#include <array>
#include <clocale>
#include <cstring>
#include <locale>
#include <stdexcept>

#include "wpg/files/plain_locale.h"

namespace halfstep::replay {
namespace {

// MuJoCo would end the process, or write a file into the working directory.
void CatchErrors() {
  mju_user_error = RefuseMujoco;
  mju_user_warning = [](const char*) {};
}

// MuJoCo reads a model's numbers by strtod and by streams of the program's global locale. As long
// as this lives, both are C's; a program whose streams are C's already is not touched.
class ClassicStreams {
 public:
  ClassicStreams() : streams_(), locale_(std::setlocale(LC_ALL, nullptr)) {
    if (streams_ != std::locale::classic()) std::locale::global(std::locale::classic());
  }
  ~ClassicStreams() {
    if (streams_ == std::locale::classic()) return;
    std::locale::global(streams_);
    std::setlocale(LC_ALL, locale_.c_str());
  }
  ClassicStreams(const ClassicStreams&) = delete;
  ClassicStreams& operator=(const ClassicStreams&) = delete;

 private:
  const std::locale streams_;
  const std::string locale_;
  const PlainLocale plain_;
};

}  // namespace

void RefuseMujoco(const char* message) {
  throw std::runtime_error(std::string("MuJoCo: ") + message);
}

std::shared_ptr<const mjModel> CompileMujoco(const std::string& mjcf) {
  CatchErrors();
  const ClassicStreams classic;
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  mj_makeEmptyFileVFS(files.get(), "robot.xml", static_cast<int>(mjcf.size()));
  std::memcpy(files->filedata[0], mjcf.data(), mjcf.size());
  std::array<char, 1000> reason{};
  mjModel* model = mj_loadXML("robot.xml", files.get(), reason.data(), reason.size());
  mj_deleteVFS(files.get());
  if (model == nullptr) RefuseMujoco(reason.data());
  const std::shared_ptr<const mjModel> compiled(model, mj_deleteModel);
  if (reason[0] != '\0')
    RefuseMujoco(reason.data());  // a warning: it took something in another way
  return compiled;
}

}  // namespace halfstep::replay
