// The options of the library as attributes of Python objects, from the one declaration that each
// has (host/core/options.h).
#pragma once

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <functional>
#include <string>
#include <vector>

#include "host/core/options.h"

namespace edgescout::python {

namespace py = pybind11;

// One option of a given struct.
struct OptionField {
  std::string name;  // "coarse_poses"
  std::string help;
  std::function<py::object()> get;
  std::function<void(const py::object&)> set;  // InputError out of bounds, py::cast_error
};

// Lists the options of the struct that it is given to; they hold references into it.
class OptionFields : public OptionVisitor {
 public:
  std::vector<OptionField> fields;

  // `type` is the Python class, for messages.
  explicit OptionFields(std::string type) : type_(std::move(type)) {}
  void group(const char*) override {}
  void number(const OptionInfo& option, int& field, int low, int high) override;
  void number(const OptionInfo& option, float& field, float low, float high) override;
  void number(const OptionInfo& option, double& field, double low, double high) override;
  void range(const OptionInfo& option, Range& field, double low, double high) override;
  void numbers(const OptionInfo& option, std::vector<double>& field, int count, double low,
               double high) override;
  void flag(const OptionInfo& option, bool& field) override;
  void off_flag(const OptionInfo& option, bool& field) override;

 private:
  void index(const OptionInfo& option, const Index& field,
             std::span<const char* const> names) override;
  std::string type_;
};

// AttributeError naming similar ones: there is no option of this name.
const OptionField& field_named(const std::vector<OptionField>& fields, const std::string& name);

// Of two structs of one type.
bool have_equal_values(const std::vector<OptionField>& a, const std::vector<OptionField>& b);
// From names to what the options mean.
py::dict help_of(const std::vector<OptionField>& fields);
// "DetectOptions(edges='gradient', ..)".
std::string repr_of(const std::string& type, const std::vector<OptionField>& fields);

// Adds a property for each option, and a constructor that takes them by name. `fields_of(options)`
// returns the OptionField of each.
template <typename Options, typename FieldsOf>
void add_properties(py::class_<Options>& type, const FieldsOf& fields_of) {
  const auto get = [fields_of](Options& options, const std::string& field) {
    return field_named(fields_of(options), field).get();
  };
  const auto set = [fields_of](Options& options, const std::string& field,
                               const py::object& value) {
    field_named(fields_of(options), field).set(value);
  };
  Options defaults;
  for (const OptionField& field : fields_of(defaults))
    type.def_property(
        field.name.c_str(),
        [get, name = field.name](Options& options) { return get(options, name); },
        [set, name = field.name](Options& options, const py::object& value) {
          set(options, name, value);
        },
        field.help.c_str());
  type.def(py::init([set](const py::kwargs& values) {
             Options options;
             for (const auto& [field, value] : values)
               set(options, py::cast<std::string>(field),
                   py::reinterpret_borrow<py::object>(value));
             return options;
           }),
           "The defaults, but for those that are named.");
  // For names that no property has.
  type.def("__getattr__", get).def("__setattr__", set);
}

// Adds a class of options. `describe_all(options, visitor)` names them.
template <typename Options, typename Describe>
void add_options_class(py::module_& module, const char* name, const char* doc,
                       const Describe& describe_all) {
  const auto fields_of = [describe_all, name](Options& options) {
    OptionFields fields(name);
    describe_all(options, fields);
    return std::move(fields.fields);
  };
  py::class_<Options> type(module, name, doc);
  add_properties(type, fields_of);
  type.def("__eq__",
           [fields_of](Options& a, Options& b) {
             return have_equal_values(fields_of(a), fields_of(b));
           })
      .def("__repr__",
           [fields_of, name](Options& options) { return repr_of(name, fields_of(options)); })
      .def(
          "copy", [](const Options& options) { return options; }, "Options of their own.")
      .def(
          "help", [fields_of](Options& options) { return help_of(fields_of(options)); },
          "What each option means: a dict from its name to one sentence.");
}

}  // namespace edgescout::python
