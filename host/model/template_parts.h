// Internal to model: the parts of a template set that its file and the cache share.
#pragma once

#include <vector>

#include "host/io/binary_file.h"
#include "host/model/template_set.h"

namespace edgescout {

// The model of make_edge_model, with the occluding surface that it computed before. To compute that
// surface takes longest where a mesh is dense.
EdgeModel edge_model_with(const Mesh& mesh, const EdgeModelOptions& options,
                          OccludingSurface occluding);

// Every field of the options.
void put_options(BinaryWriter& out, const TemplateOptions& options);
TemplateOptions get_options(BinaryReader& in);  // InputError: out of bounds

void put_symmetries(BinaryWriter& out, const Symmetries& symmetries);
Symmetries get_symmetries(BinaryReader& in);

// Vertices and triangles. All else that a mesh holds is computed from them.
void put_mesh(BinaryWriter& out, const Mesh& mesh);
Mesh get_mesh(BinaryReader& in, const std::string& name);

void put_occluding(BinaryWriter& out, const OccludingSurface& occluding);
OccludingSurface get_occluding(BinaryReader& in);

void put_views(BinaryWriter& out, const std::vector<TemplateView>& views);
std::vector<TemplateView> get_views(BinaryReader& in);

}  // namespace edgescout
