// Mean tensor value of many templates, each at many places of the image (paper, Eq. 7).
//
// A template is a list of image points with orientation bins, relative to an anchor. A job is one template
// on a rectangle of anchors, step 1 px; its answer is the anchor with the lowest mean (ties: lowest y, then
// lowest x) and that mean. A job of one anchor is the plain Eq. 7.
//
// Values are read as v8 = min(255, (v16 + 2^(s-1)) >> s) with s = TEMPLATE_SCORE_SHIFT, so 1/16 px units and a cap of
// 15.94 px: this kernel runs on a coarse tensor (the image reduced by 2 to 6), where that is 30 to
// 100 px of the image. Points that fall outside the image count as 255. The sum of at most 256 points fits 16 bits.
//
// Agreement: the sums are integers and equal on every path, bit for bit; mean_px = sum / (16 * points).
#ifndef EDGESCOUT_TEMPLATE_SCORE_H
#define EDGESCOUT_TEMPLATE_SCORE_H

#include "interop.h"

#ifdef __cplusplus
namespace edgescout {
#endif
EDGESCOUT_CONST(TEMPLATE_SCORE_SHIFT, 4);
EDGESCOUT_CONST(TEMPLATE_SCORE_MAX_POINTS, 256);
#ifdef __cplusplus
}  // namespace edgescout

#include <span>
#include <vector>

#include "kernels/tensor_layout.h"

namespace edgescout {

class ThreadPool;

struct TemplatePoint {  // 32 bits beyond the struct's padding rules: three small fields packed by hand
  std::int16_t dx_px, dy_px;
  std::uint16_t bin;
  std::uint16_t padding = 0;
};

struct TemplateJob {
  std::uint32_t first_point;  // into the list of all templates' points
  std::uint32_t point_count;  // 1..TEMPLATE_SCORE_MAX_POINTS
  std::int32_t x0, y0;        // first anchor
  std::uint32_t columns, rows;
};

struct TemplateHit {
  std::uint32_t sum;  // of v8 over the template's points, at the best anchor
  std::int32_t x, y;
};

void template_score_reference(std::span<const std::uint16_t> tensor, const TensorShape& shape,
                              std::span<const TemplatePoint> points, std::span<const TemplateJob> jobs,
                              std::span<TemplateHit> hits);
void template_score_fast(std::span<const std::uint16_t> tensor, const TensorShape& shape,
                         std::span<const TemplatePoint> points, std::span<const TemplateJob> jobs,
                         std::span<TemplateHit> hits, ThreadPool& pool);

}  // namespace edgescout
#endif
#endif
