// Internal to host/io: what assimp does not say of a scene file or does not check.
#pragma once

#include <cstdint>
#include <filesystem>

namespace edgescout {

constexpr std::uintmax_t most_scene_bytes = 256u << 20;  // of a scene, unpacked

// The length unit that the file or its format defines. glTF: metres. 3MF and COLLADA: what the file
// says, else mm and m. InputError: the file is missing or larger than most_scene_bytes;
// a glTF is compressed in a way that assimp cannot read; a 3MF is no archive with a model in it or
// a transform in it does not have 12 numbers.
double check_scene_text(const std::filesystem::path& file);

bool is_collada(const std::filesystem::path& file);

}  // namespace edgescout
