#include <exception>
#include <stdexcept>

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

}  // namespace

void BindExceptions(py::module_&) {
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const InputError& error) {
      RaiseInputError(error);
    } catch (const std::logic_error& error) {  // a precondition that the package did not check
      PyErr_SetString(PyExc_ValueError, error.what());
    }
  });
}

}  // namespace halfstep::python
