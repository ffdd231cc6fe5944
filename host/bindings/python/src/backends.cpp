#include <pybind11/stl.h>

#include "host/bindings/python/src/parts.h"
#include "host/bindings/python/src/shared_backend.h"

namespace edgescout::python {

namespace py = pybind11;

BackendPointer backend_or_usual(const BackendPointer& given) {
  static BackendPointer usual;  // guarded by the interpreter's lock
  if (given) return given;
  if (!usual) usual = std::make_shared<SharedBackend>(make_backend("auto"));
  return usual;
}

void add_backends(py::module_& module) {
  py::class_<SharedBackend, BackendPointer>(
      module, "Backend",
      "Where the kernels run. Threads may share one; their calls follow one another.")
      .def(py::init([](const std::string& device, int threads) {
             if (device != "cpu" && threads != 0)
               throw py::value_error("threads: found " + std::to_string(threads) + " for " +
                                     device + ", expected them for cpu alone");
             return std::make_shared<SharedBackend>(device == "cpu" ? make_cpu_backend(threads)
                                                                    : make_backend(device));
           }),
           py::arg("device") = "auto", py::kw_only(), py::arg("threads") = 0,
           "device: auto (a graphics card, else the CPU), cpu, cpu-reference, vulkan or "
           "vulkan:INDEX. threads: of the CPU, 0 for one a core.")
      .def_property_readonly(
          "name", [](const SharedBackend& b) { return b.info().name(); },
          "The device and what it is made of.")
      .def_property_readonly(
          "is_hardware", [](const SharedBackend& b) { return b.info().is_hardware(); },
          "Whether it is a graphics card.")
      .def("__repr__", [](const SharedBackend& b) { return "Backend(" + b.info().name() + ")"; });
  py::class_<DeviceInfo>(module, "Device", "A Vulkan device.")
      .def_readonly("index", &DeviceInfo::index, "Backend(\"vulkan:INDEX\") is on it.")
      .def_readonly("name", &DeviceInfo::name, "Of the device.")
      .def_readonly("driver", &DeviceInfo::driver, "Its Vulkan driver.")
      .def_readonly("is_hardware", &DeviceInfo::hardware, "False: the driver computes on the CPU.")
      .def_readonly("memory_bytes", &DeviceInfo::memory_bytes, "Of its own.")
      .def("__repr__", [](const DeviceInfo& d) {
        return "Device(vulkan:" + std::to_string(d.index) + " " + d.name + ")";
      });
  module.def("devices", &vulkan_devices, "The Vulkan devices of this machine.");
}

}  // namespace edgescout::python
