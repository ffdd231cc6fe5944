// Keeps the templates of objects in a folder, so that a later run need not build them.
//
// Public header.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "host/model/template_set.h"

namespace edgescout {

// Returns $XDG_CACHE_HOME/edgescout/templates, without an absolute XDG_CACHE_HOME
// $HOME/.cache/edgescout/templates. Empty: HOME is not an absolute path either.
std::filesystem::path default_template_folder();

struct TemplateCacheOptions {
  std::filesystem::path folder = default_template_folder();  // empty: nothing is kept
  double max_size_gib = 2;  // of all entries; the least recently used ones are removed
  // Tells programs apart that may build other templates: one never reads entries of another.
  std::string program;
  void validate() const;  // InputError naming the field and the violated bound
};

// Names the options to `visit`, without the folder and the program, which are no numbers.
void describe(TemplateCacheOptions& options, OptionVisitor& visit);

struct CachedTemplates {
  TemplateSet set;
  bool are_cached = false;  // read from the folder; else they were built
  double seconds = 0;       // to read or to build them
};

class FileCache;

// Several programs may use one folder at the same time. One thread at a time may use a
// TemplateCache.
class TemplateCache {
 public:
  // Opens the cache. InputError: options out of bounds. The folder is made when the first templates
  // are written.
  explicit TemplateCache(const TemplateCacheOptions& options = {});
  TemplateCache(TemplateCache&&) noexcept;
  TemplateCache& operator=(TemplateCache&&) noexcept;
  ~TemplateCache();

  // Returns the templates of build_templates, bit by bit, and with its errors. They are read where
  // they were built before for the same vertices, triangles, symmetries, options and backend, by
  // the same version of the library, the same compiler and the same instruction set. `progress` is
  // called where they are built. A fault of the folder is no error: a damaged file is logged as a
  // warning and replaced, a folder that cannot be written is logged once.
  CachedTemplates get(const Object& object, const TemplateOptions& options, Backend& backend,
                      const std::function<void(int, int)>& progress = {});

 private:
  std::string program_;
  std::unique_ptr<FileCache> files_;
};

}  // namespace edgescout
