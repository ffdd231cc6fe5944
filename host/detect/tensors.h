// Builds the DCD tensors of a view (paper, Sec. 3.3): one of full resolution and two at each of the
// reductions that suit the objects' sizes in the image.
//
// The reduced tensors have a wider basin: the scan and the coarse alignment work on them. Their
// orientation weight is lambda / reduction, so that all resolutions weigh direction against image
// distance alike.
#pragma once

#include <span>

#include "host/core/options.h"
#include "host/model/template_set.h"
#include "host/register/object_view.h"

namespace edgescout {

// Names the options of tensors to `visit`. The kernel's own validate() (kernels/tensor_layout.h)
// checks the same bounds.
void describe(TensorOptions& options, OptionVisitor& visit);
// Names the part of them that other verbs also have: without bins and lambda, and without a group.
void describe_values(TensorOptions& options, OptionVisitor& visit);

// Returns the reduction that makes `size_px` some REDUCED_SIZE_PX: a whole number in [1, 8].
double reduction_for(double size_px);

// Builds the tensors of a view, whose image and edges are set (pipeline.h: prepare_view). Reduces
// by what suits each object at each of its scales (distance_scales). LogicError: no templates, a
// camera pose that is not finite.
void add_tensors(ObjectView& view, std::span<const TemplateSet> sets, Backend& backend,
                 const TensorOptions& options);

// Builds them with one given reduction, image px per px of the reduced tensors.
void add_tensors(ObjectView& view, double reduction, Backend& backend,
                 const TensorOptions& options);

}  // namespace edgescout
