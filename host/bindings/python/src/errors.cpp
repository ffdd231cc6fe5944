#include "host/active/scout.h"
#include "host/bindings/python/src/parts.h"
#include "kernels/error.h"

namespace edgescout::python {

namespace py = pybind11;

// What the user gave is a ValueError, what failed on the way a RuntimeError.
void add_errors(py::module_& module) {
  py::register_exception<InputError>(module, "InputError", PyExc_ValueError).doc() =
      "What was given cannot be used. The message names the file, the field, what was found and "
      "what was expected.";
  py::register_exception<GpuError>(module, "DeviceError", PyExc_RuntimeError).doc() =
      "A call of the Vulkan device failed.";
  py::register_exception<LogicError>(module, "LogicError", PyExc_RuntimeError).doc() =
      "A call that breaks its own rules, such as an index that does not exist.";
  py::register_exception<Cancelled>(module, "Cancelled", PyExc_RuntimeError).doc() =
      "A call of the scout was cancelled. Ctrl-C raises KeyboardInterrupt in its place.";
}

}  // namespace edgescout::python
