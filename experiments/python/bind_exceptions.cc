#include <exception>
#include <stdexcept>
#include <string>
#include <string_view>

#include "experiments/python/bindings.h"
#include "wpg/files/input_error.h"
#include "wpg/files/text.h"

namespace py = pybind11;

namespace halfstep::python {
namespace {

// halfstep.InputError with all complaints.
void RaiseInputError(const InputError& error) {
  py::list complaints;
  for (const std::string& complaint : error.complaints()) complaints.append(Printable(complaint));
  const py::object type = py::module_::import("halfstep.errors").attr("InputError");
  PyErr_SetObject(type.ptr(), type(complaints).ptr());
}

// What a broken precondition of ours says, for people who do not read our sources: its values, and
// the name of the file without the folders in which it was built. Other errors say it themselves.
std::string WithoutInternals(const std::string& what) {
  constexpr std::string_view kBegins = ": precondition `", kEnds = "` does not hold: ";
  const size_t begin = what.find(kBegins), end = what.find(kEnds);
  if (begin == std::string::npos || end == std::string::npos) return what;
  const std::string place = what.substr(0, begin);
  return what.substr(end + kEnds.size()) + " (" + place.substr(place.rfind('/') + 1) + ")";
}

}  // namespace

void BindExceptions(py::module_&) {
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const InputError& error) {
      RaiseInputError(error);
    } catch (const std::invalid_argument& error) {  // a sentence on what was given
      RaiseInputError(InputError({error.what()}));
    } catch (const std::logic_error& error) {  // our mistake
      const std::string sentence =
          "halfstep's own check failed, please report it: " + WithoutInternals(error.what());
      PyErr_SetString(PyExc_RuntimeError, sentence.c_str());
    }
  });
}

}  // namespace halfstep::python
