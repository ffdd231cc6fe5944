#include "host/bindings/c/src/option_set.h"

#include <array>

#include "host/bindings/c/src/contents.h"
#include "host/bindings/c/src/structs.h"

namespace edgescout::c {

namespace {

constexpr std::array<const char*, std::variant_size_v<OptionValues>> kinds{
    "images", "templates", "detect", "register", "scout", "track", "depth"};

OptionValues defaults_of(std::int32_t kind) {
  switch (kind) {
    case EDGESCOUT_IMAGE_OPTIONS:
      return OptionValues(std::in_place_type<ImageOptions>);
    case EDGESCOUT_TEMPLATE_OPTIONS:
      return OptionValues(std::in_place_type<TemplateOptions>);
    case EDGESCOUT_DETECT_OPTIONS:
      return OptionValues(std::in_place_type<PipelineOptions>);
    case EDGESCOUT_REGISTER_OPTIONS:
      return OptionValues(std::in_place_type<RegistrationOptions>);
    case EDGESCOUT_SCOUT_OPTIONS:
      return OptionValues(std::in_place_type<ScoutOptions>);
    case EDGESCOUT_TRACK_OPTIONS:
      return OptionValues(std::in_place_type<TrackOptions>);
    case EDGESCOUT_DEPTH_OPTIONS:
      return OptionValues(std::in_place_type<DepthOptions>);
    default:
      refuse(EDGESCOUT_BAD_INPUT, "kind", std::to_string(kind),
             "EDGESCOUT_IMAGE_OPTIONS or another kind of options");
  }
}

void describe_all(ScoutOptions& options, OptionVisitor& visit) { describe_scout(options, visit); }
void describe_all(TrackOptions& options, OptionVisitor& visit) { describe_track(options, visit); }
template <typename Options>
void describe_all(Options& options, OptionVisitor& visit) {
  describe(options, visit);
}

}  // namespace

OptionSet::OptionSet(std::int32_t kind) : values_(defaults_of(kind)) { list(); }

OptionSet::OptionSet(const OptionSet& other) : values_(other.values_) {
  list();
  for (std::size_t i = 0; i < shown_.size(); ++i)
    shown_[i].default_value = other.shown_[i].default_value;
}

void OptionSet::list() {
  OptionTexts texts(kind());
  std::visit([&](auto& values) { describe_all(values, texts); }, values_);
  options_ = std::move(texts.options);
  for (const OptionText& option : options_) {
    const std::string value = option.get();
    Shown& shown = shown_.emplace_back(Shown{value, value, {}});
    for (const std::string& word : option.words) shown.words.push_back(word.c_str());
  }
}

const char* OptionSet::kind() const { return kinds[values_.index()]; }

std::size_t OptionSet::index_of(const std::string& name) const {
  return std::size_t(&option_named(options_, name, kind()) - options_.data());
}

void OptionSet::set(const std::string& name, const std::string& value) {
  const std::size_t index = index_of(name);
  options_[index].set(value);
  shown_[index].value = options_[index].get();
}

edgescout_option OptionSet::shown(std::size_t index) const {
  const OptionText& option = options_[index];
  const Shown& texts = shown_[index];
  edgescout_option shown{};
  shown.name = option.name.c_str();
  shown.group = option.group.c_str();
  shown.help = option.help.c_str();
  shown.type = std::int32_t(option.type);
  shown.is_expert = option.level == OptionLevel::Expert;
  shown.count = option.count;
  shown.word_count = std::int32_t(texts.words.size());
  shown.low = option.low;
  shown.high = option.high;
  shown.default_value = texts.default_value.c_str();
  shown.value = texts.value.c_str();
  shown.words = texts.words.data();
  return shown;
}

template <typename Options>
Options options_of(const edgescout_options* options) {
  if (!options) return Options();
  const auto given = shared(options);
  const auto* const values = std::get_if<Options>(&(*given)->values());
  if (!values)
    refuse(EDGESCOUT_WRONG_KIND, "options", std::string("those of ") + (*given)->kind(),
           std::string("those of ") + kinds[OptionValues(std::in_place_type<Options>).index()]);
  return *values;
}
template ImageOptions options_of(const edgescout_options*);
template TemplateOptions options_of(const edgescout_options*);
template PipelineOptions options_of(const edgescout_options*);
template RegistrationOptions options_of(const edgescout_options*);
template ScoutOptions options_of(const edgescout_options*);
template TrackOptions options_of(const edgescout_options*);
template DepthOptions options_of(const edgescout_options*);

}  // namespace edgescout::c

using namespace edgescout::c;

edgescout_status edgescout_options_create(int32_t kind, edgescout_options** out) {
  return create(out, [&] { return std::make_unique<OptionSet>(kind); });
}

edgescout_status edgescout_options_copy(const edgescout_options* options, edgescout_options** out) {
  return create(out, [&] { return std::make_unique<OptionSet>(**shared(options)); });
}

edgescout_status edgescout_options_set(edgescout_options* options, const char* name,
                                       const char* value) {
  return guarded([&] {
    const auto given = exclusive(options);
    require(name, "name");
    require(value, "value");
    (*given)->set(name, value);
  });
}

edgescout_status edgescout_options_get(const edgescout_options* options, const char* name,
                                       edgescout_option* out) {
  return guarded([&] {
    const auto given = shared(options);
    require(name, "name");
    write_struct((*given)->shown((*given)->index_of(name)), out, "out");
  });
}

edgescout_status edgescout_options_count(const edgescout_options* options, size_t* out) {
  return guarded([&] {
    require(out, "out");
    *out = (*shared(options))->size();
  });
}

edgescout_status edgescout_options_at(const edgescout_options* options, size_t index,
                                      edgescout_option* out) {
  return guarded([&] {
    const auto given = shared(options);
    require_index(index, (*given)->size(), "index");
    write_struct((*given)->shown(index), out, "out");
  });
}
