// Mean tensor value of many templates, each at many places of the image (paper, Eq. 7).
//
// A template is a list of image points with orientation bins, relative to an anchor. A job is one
// template on a rectangle of anchors, `anchor_step` px apart: (x0 + step * column, y0 + step *
// row). Its answer is the anchor with the lowest sum (ties: lowest y, then lowest x). A job of one
// anchor is the plain Eq. 7.
//
// Values are read as v = min(TEMPLATE_SCORE_CAP, (v16 + 2^(s-1)) >> s) with s =
// TEMPLATE_SCORE_SHIFT, so in units of 1/4 px and with a cap of 4 px. This kernel runs on a coarse
// tensor (the image reduced by 2 to 6), where that is 8 to 24 px of the image: a point that is
// hidden costs no more than one a little off, or a half-hidden object would lose to clutter that
// fits everywhere a little. Points that fall outside the image count as
// TEMPLATE_SCORE_OUTSIDE, 3.25 px: about what chance gives. Counted as far from every edge, an
// object that reaches over the image's border by a tenth could never be found.
//
// Agreement: the sums are integers and equal on every path, bit for bit; mean_px = sum / (4 *
// points).
#ifndef EDGESCOUT_TEMPLATE_SCORE_H
#define EDGESCOUT_TEMPLATE_SCORE_H

#include "interop.h"

#ifdef __cplusplus
namespace edgescout {
#endif
EDGESCOUT_CONST(TEMPLATE_SCORE_SHIFT, 6);
EDGESCOUT_CONST(TEMPLATE_SCORE_CAP, 16);
EDGESCOUT_CONST(TEMPLATE_SCORE_OUTSIDE, 13);
EDGESCOUT_CONST(TEMPLATE_SCORE_MAX_POINTS, 256);
// Of a job: lavapipe ends a shader's loops after 65,535 turns in all, and an invocation takes one a
// point of every 64th anchor.
EDGESCOUT_CONST(TEMPLATE_SCORE_MAX_ANCHORS, 8192);
#ifdef __cplusplus
}  // namespace edgescout

#include <span>
#include <vector>

#include "kernels/tensor_layout.h"

namespace edgescout {

class ThreadPool;

struct TemplatePoint {  // two words, padding written out: a shader reads them so
  std::int16_t dx_px, dy_px;
  std::uint16_t bin;
  std::uint16_t padding = 0;
};

struct TemplateJob {
  std::uint32_t first_point;    // into the list of all templates' points
  std::uint32_t point_count;    // 1..TEMPLATE_SCORE_MAX_POINTS
  std::int32_t x0, y0;          // first anchor
  std::uint32_t columns, rows;  // 1..TEMPLATE_SCORE_MAX_ANCHORS anchors
};

struct TemplateHit {
  std::uint32_t sum;  // of v over the template's points, at the best anchor
  std::int32_t x, y;
};

// What every path asks of its input: LogicError for points, bins, jobs or an anchor step (1 to 16)
// out of bounds.
void check_template_jobs(const TensorShape& shape, std::span<const TemplatePoint> points,
                         std::span<const TemplateJob> jobs, int anchor_step, std::size_t hits);

void template_score_reference(std::span<const std::uint16_t> tensor, const TensorShape& shape,
                              std::span<const TemplatePoint> points,
                              std::span<const TemplateJob> jobs, int anchor_step,
                              std::span<TemplateHit> hits);
void template_score_fast(std::span<const std::uint16_t> tensor, const TensorShape& shape,
                         std::span<const TemplatePoint> points, std::span<const TemplateJob> jobs,
                         int anchor_step, std::span<TemplateHit> hits, ThreadPool& pool);

}  // namespace edgescout
#endif
#endif
