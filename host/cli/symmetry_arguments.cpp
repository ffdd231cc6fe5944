#include "host/cli/symmetry_arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "host/core/log.h"
#include "host/core/symmetry_group.h"
#include "host/model/axis_symmetry.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

std::optional<int> id_before(const std::string& word, std::size_t colon) {
  int id = -1;
  const auto [end, error] = std::from_chars(word.data(), word.data() + colon, id);
  if (error != std::errc{} || end != word.data() + colon) return {};
  return id;
}

void log_replaced(int object_id, const Symmetries& stated, const Symmetries& before,
                  const std::string& source) {
  log(LogLevel::Info,
      fmt::format("object {}: the symmetries of --symmetry, {} besides the identity, replace the "
                  "{} of {}",
                  object_id, stated.discrete.size() - 1, before.discrete.size() - 1, source));
}

}  // namespace

void add_symmetry(CLI::App& verb, std::vector<std::string>& words) {
  verb.add_option(
          "--symmetry", words,
          "Symmetry of the object, in place of what --models-info or a template file says: z2 for "
          "a half turn about z, x4 for quarter turns about x, z for a surface of revolution. "
          "Several give all their products. With several objects: ID:z2")
      ->type_name("WORD ...");
}

StatedSymmetries::StatedSymmetries(const std::vector<std::string>& words,
                                   const std::vector<int>& object_ids) {
  for (const std::string& word : words) {
    const std::size_t colon = word.find(':');
    if (colon == std::string::npos && object_ids.size() != 1)
      throw InputError("command line", "--symmetry", "\"" + word + "\" for several objects",
                       "ID:" + word + ", with the id of one");
    const std::optional<int> id =
        colon == std::string::npos ? object_ids.front() : id_before(word, colon);
    if (!id || std::ranges::find(object_ids, *id) == object_ids.end())
      throw InputError("command line", "--symmetry", "\"" + word + "\"",
                       "the id of an object before the colon");
    words_.emplace_back(*id, colon == std::string::npos ? word : word.substr(colon + 1));
  }
}

std::optional<Symmetries> StatedSymmetries::of(int object_id, const Mesh& mesh,
                                               int continuous_steps) const {
  std::vector<std::string> own;
  for (const auto& [id, word] : words_)
    if (id == object_id) own.push_back(word);
  if (own.empty()) return {};
  return axis_symmetries(mesh, own, continuous_steps);
}

void replace_symmetries(Object& object, const Symmetries& stated, const std::string& source) {
  if (!source.empty()) log_replaced(object.id, stated, object.symmetries, source);
  object.symmetries = stated;
}

void replace_symmetries(TemplateSet& set, const Symmetries& stated, const std::string& file) {
  const MemberTolerance same{0.02, 0.005 * set.model.mesh.diameter_m};
  std::vector<Se3> members = stated.discrete;
  for (const Se3& own : set.symmetries.discrete) add_unless_known(members, own, same);
  if (members.size() > stated.discrete.size())
    throw InputError(file, "--symmetry", "symmetries that lack some of the file's",
                     "all of the file's and others: it has no templates of the views that are "
                     "equal by its own (build it anew)");
  log_replaced(set.object_id, stated, set.symmetries, file);
  set.symmetries = stated;
}

}  // namespace edgescout
