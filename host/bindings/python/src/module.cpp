// The module edgescout._core; edgescout/__init__.py names what users see of it.
#include "host/bindings/python/src/parts.h"

PYBIND11_MODULE(_core, module) {
  namespace python = edgescout::python;
  python::add_errors(module);
  python::add_cameras(module);
  python::add_images(module);
  python::add_backends(module);
  python::add_options(module);
  python::add_models(module);
  python::add_bop(module);
  python::add_detection(module);
  python::add_scout(module);
  python::add_tracker(module);
  module.attr("__version__") = EDGESCOUT_VERSION;
}
