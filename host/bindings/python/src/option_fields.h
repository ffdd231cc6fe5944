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

// Adds a class of options. `describe(options, visitor)` names them.
template <typename Options, typename Describe>
void add_options_class(py::module_& module, const char* name, const char* doc,
                       const Describe& describe_all) {
  const auto fields_of = [describe_all, name](Options& options) {
    OptionFields fields(name);
    describe_all(options, fields);
    return std::move(fields.fields);
  };
  const auto set = [fields_of](Options& options, const std::string& field,
                               const py::object& value) {
    field_named(fields_of(options), field).set(value);
  };
  py::class_<Options>(module, name, doc)
      .def(py::init([set](const py::kwargs& values) {
             Options options;
             for (const auto& [field, value] : values)
               set(options, py::cast<std::string>(field),
                   py::reinterpret_borrow<py::object>(value));
             return options;
           }),
           "The defaults, but for those that are named.")
      .def("__getattr__",
           [fields_of](Options& options, const std::string& field) {
             return field_named(fields_of(options), field).get();
           })
      .def("__setattr__", set)
      .def("__dir__",
           [fields_of](Options& options) {
             std::vector<std::string> names{"copy", "help"};
             for (const OptionField& field : fields_of(options)) names.push_back(field.name);
             return names;
           })
      .def("__eq__",
           [fields_of](Options& a, Options& b) {
             const std::vector<OptionField> of_a = fields_of(a), of_b = fields_of(b);
             for (std::size_t i = 0; i < of_a.size(); ++i)
               if (!of_a[i].get().equal(of_b[i].get())) return false;
             return true;
           })
      .def(
          "copy", [](const Options& options) { return options; }, "Options of their own.")
      .def(
          "help",
          [fields_of](Options& options) {
            py::dict help;
            for (const OptionField& field : fields_of(options))
              help[py::str(field.name)] = field.help;
            return help;
          },
          "What each option means: a dict from its name to one sentence.")
      .def("__repr__", [fields_of, type = std::string(name)](Options& options) {
        std::string text = type + "(";
        for (const OptionField& field : fields_of(options))
          text += (text.back() == '(' ? "" : ", ") + field.name + "=" +
                  std::string(py::repr(field.get()));
        return text + ")";
      });
}

}  // namespace edgescout::python
