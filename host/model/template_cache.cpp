#include "host/model/template_cache.h"

#include <chrono>
#include <cstdlib>

#include "host/core/stopwatch.h"
#include "host/io/file_cache.h"
#include "host/model/template_parts.h"
#include "kernels/backend.h"

namespace edgescout {

namespace fs = std::filesystem;

namespace {

// To be raised where the same object and options give other templates than before. A test compares
// the templates of a part with those of this version.
constexpr int templates_version = 1;

constexpr BinaryFormat entry_format{
    {'E', 'S', 'C', 'O', 'U', 'T', 'T', 'C'}, 1, "template cache file"};

// Where results may be rounded in another way: the kernels have variants for instruction sets
// (kernels/simd.h).
std::string rounding_text() {
  std::string text = __VERSION__;
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) text += " avx2";
  if (__builtin_cpu_supports("fma")) text += " fma";
  if (__builtin_cpu_supports("avx512f")) text += " avx512f";
#endif
  return text;
}

std::string key_of(const Object& object, const TemplateOptions& options, const Backend& backend,
                   const std::string& program) {
  BinaryWriter key;
  key.put(templates_version);
  key.put_text(program);
  key.put_text(rounding_text());
  key.put_text(backend.name());
  put_options(key, options);
  put_symmetries(key, object.symmetries);
  put_mesh(key, object.mesh);
  return std::move(key.bytes);
}

fs::path folder_in_environment(const char* variable) {
  const char* value = std::getenv(variable);
  const fs::path folder = value ? value : "";
  return folder.is_absolute() ? folder : fs::path();
}

}  // namespace

fs::path default_template_folder() {
  fs::path caches = folder_in_environment("XDG_CACHE_HOME");
  if (caches.empty() && !folder_in_environment("HOME").empty())
    caches = folder_in_environment("HOME") / ".cache";
  return caches.empty() ? caches : caches / "edgescout" / "templates";
}

void describe(TemplateCacheOptions& o, OptionVisitor& visit) {
  visit.group("Template cache");
  visit.number({"template-cache-size",
                "Largest size of the folder of kept templates, GiB. The least recently used "
                "templates are removed"},
               o.max_size_gib, 0.0, 1e6);
}

void TemplateCacheOptions::validate() const { check_bounds(*this, "templates"); }

TemplateCache::TemplateCache(const TemplateCacheOptions& options) : program_(options.program) {
  options.validate();
  files_ = std::make_unique<FileCache>(
      options.folder, entry_format, static_cast<std::uint64_t>(options.max_size_gib * (1 << 30)));
}
TemplateCache::TemplateCache(TemplateCache&&) noexcept = default;
TemplateCache& TemplateCache::operator=(TemplateCache&&) noexcept = default;
TemplateCache::~TemplateCache() = default;

CachedTemplates TemplateCache::get(const Object& object, const TemplateOptions& options,
                                   Backend& backend,
                                   const std::function<void(int, int)>& progress) {
  const auto start = std::chrono::steady_clock::now();
  const std::string key = key_of(object, options, backend, program_);
  CachedTemplates found;
  TemplateSet& set = found.set;
  found.are_cached = files_->read(key, [&set](BinaryReader& in) {
    set.views = get_views(in);
    set.model.occluding = get_occluding(in);
  });
  if (found.are_cached) {
    set.object_id = object.id;
    set.symmetries = object.symmetries;
    set.options = options;
    set.model = edge_model_with(object.mesh, options.edges, std::move(set.model.occluding));
  } else {
    set = build_templates(object, options, backend, progress);
    files_->write(key, [&set](BinaryWriter& out) {
      put_views(out, set.views);
      put_occluding(out, set.model.occluding);
    });
  }
  found.seconds = seconds_since(start);
  return found;
}

}  // namespace edgescout
