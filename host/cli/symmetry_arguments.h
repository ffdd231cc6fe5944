// The option --symmetry: symmetries of an object about its axes, in words.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "host/core/types.h"
#include "host/model/template_set.h"

namespace edgescout {

void add_symmetry(CLI::App& verb, std::vector<std::string>& words);

// The words of --symmetry by object.
class StatedSymmetries {
 public:
  // InputError: a word without an id where there are several objects, or with the id of none.
  StatedSymmetries(const std::vector<std::string>& words, const std::vector<int>& object_ids);

  // What the words say of an object, with continuous symmetries in so many steps; absent where they
  // say nothing. InputError as axis_symmetries.
  std::optional<Symmetries> of(int object_id, const Mesh& mesh, int continuous_steps) const;

 private:
  std::vector<std::pair<int, std::string>> words_;  // with the object's id
};

// Gives an object the stated symmetries, and logs where they replace those of `source` (empty:
// there were none).
void replace_symmetries(Object& object, const Symmetries& stated, const std::string& source);

// The same of the templates in a file. InputError: the file has a symmetry that is not among the
// stated ones; it has templates of one only of the views that are equal by it.
void replace_symmetries(TemplateSet& set, const Symmetries& stated, const std::string& file);

}  // namespace edgescout
