// The parts of the module; module.cpp puts them together.
#pragma once

#include <pybind11/pybind11.h>

namespace edgescout::python {

void add_errors(pybind11::module_& module);
void add_cameras(pybind11::module_& module);
void add_images(pybind11::module_& module);
void add_models(pybind11::module_& module);
void add_backends(pybind11::module_& module);
void add_options(pybind11::module_& module);
void add_bop(pybind11::module_& module);
void add_detection(pybind11::module_& module);
void add_scout(pybind11::module_& module);
void add_tracker(pybind11::module_& module);

}  // namespace edgescout::python
