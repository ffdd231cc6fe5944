#include "host/cli/words_behind_lists.h"

#include <algorithm>
#include <filesystem>

#include "host/io/image.h"
#include "host/io/video.h"

namespace edgescout {

namespace {

bool is_option(const std::string& word) {
  return word.size() > 1 && word[0] == '-' &&
         std::string("0123456789.").find(word[1]) == std::string::npos;
}

bool takes_a_list(const CLI::App& verb, const std::string& word) {
  const CLI::Option* option = verb.get_option_no_throw(word.substr(0, word.find('=')));
  return option && option->get_items_expected_max() > option->get_items_expected_min();
}

bool is_input(const std::string& word) {
  std::error_code unknown;
  return std::filesystem::is_directory(word, unknown) || has_video_extension(word) ||
         is_image_file(word);
}

}  // namespace

std::vector<std::string> with_inputs_in_front(const CLI::App& program,
                                              std::vector<std::string> words) {
  const auto verbs = program.get_subcommands([](const CLI::App*) { return true; });
  const auto verb_of = [&](const std::string& word) {
    return std::ranges::find(verbs, word, &CLI::App::get_name);
  };
  auto at = std::ranges::find_if(
      words, [&](const std::string& word) { return verb_of(word) != verbs.end(); });
  if (at == words.end()) return words;
  const CLI::App& verb = **verb_of(*at);
  if (!verb.get_option_no_throw("inputs") && !verb.get_option_no_throw("source")) return words;
  const auto front = ++at;
  std::size_t moved = 0;
  for (; at != words.end() && *at != "--"; ++at) {
    if (!is_option(*at) || !takes_a_list(verb, *at)) continue;
    const bool has_value = at->find('=') != std::string::npos;
    const auto next = std::find_if(at + 1, words.end(), is_option);
    const auto first = at + (has_value ? 1 : 2);
    if (first >= next) continue;
    const auto inputs = std::find_if(first, next, is_input);
    std::rotate(front + std::ptrdiff_t(moved), inputs, next);
    moved += std::size_t(next - inputs);
    at = next - 1;
  }
  return words;
}

}  // namespace edgescout
