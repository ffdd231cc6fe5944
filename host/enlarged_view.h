// Enlarges the images in which small objects are searched.
//
// What decides about a pose is measured in pixels: the blur before edges are found, the reach of a
// registration, the distance at which an edge still explains a model point. It suits objects of
// 150 to 200 px. In an image of twice the size an object of 80 px spans as many.
#pragma once

#include <span>
#include <vector>

#include "host/edge/edges.h"
#include "host/model/template_set.h"
#include "host/register/object_view.h"

namespace edgescout {

// Bounds the memory: a tensor of the full resolution has 120 bytes a pixel.
inline constexpr double MOST_ENLARGED_PIXELS = 4e6;

// By how much all images of a scene are enlarged: 2 where in each of them an object spans less than
// `below_px` at the middle (geometric mean) of its distances and the enlarged image has at most
// MOST_ENLARGED_PIXELS, else 1.
int enlargement_for(std::span<const TemplateSet> sets, std::span<const ObjectView> views,
                    double below_px);

// Returns prepared views (pipeline.h: prepare_view) of `factor` times the width and height, with
// edges found anew; by 1, copies. Depth keeps its values: each fills factor x factor pixels.
// LogicError: a view to enlarge has no image, or tensors or occluders.
std::vector<ObjectView> enlarged(std::span<const ObjectView> views, int factor, Backend& backend,
                                 const EdgesOptions& edges);

}  // namespace edgescout
