#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "template_score.h"
#include "template_score_push.h"
#include "tensor_read.glsl"

layout(local_size_x = TEMPLATE_SCORE_GROUP) in;
layout(push_constant) uniform Push { TemplateScorePush push; };
layout(binding = 4) readonly buffer Points { uvec2 points[]; };
layout(binding = 5) readonly buffer Jobs { uint jobs[]; };
layout(binding = 6) writeonly buffer Hits { uint hits[]; };

shared uint partial[TEMPLATE_SCORE_GROUP];
shared uint best_sum;
shared uint best_anchor;

struct Job {
  uint first_point;
  uint point_count;
  ivec2 origin;
  uint columns;
  uint anchors;
};

Job read_job(uint j) {
  const uint at = j * TEMPLATE_JOB_WORDS;
  return Job(jobs[at], jobs[at + 1], ivec2(int(jobs[at + 2]), int(jobs[at + 3])), jobs[at + 4],
             jobs[at + 4] * jobs[at + 5]);
}

ivec2 anchor_of(Job job, uint a) {
  return job.origin + int(push.anchor_step) * ivec2(int(a % job.columns), int(a / job.columns));
}

uint value_at(ivec2 p, uint bin) {
  // Negative coordinates are large ones.
  if (uint(p.x) >= push.grid.width || uint(p.y) >= push.grid.height) return TEMPLATE_SCORE_OUTSIDE;
  const uint v16 = tensor_at(push.grid, uint(p.x), uint(p.y), bin);
  return min(TEMPLATE_SCORE_CAP, (v16 + (1u << (TEMPLATE_SCORE_SHIFT - 1u))) >> TEMPLATE_SCORE_SHIFT);
}

// Every `step`-th point of the template from `first` on, at one anchor.
uint sum_points(Job job, ivec2 anchor, uint first, uint step) {
  uint sum = 0;
  [[dont_unroll]] for (uint i = first; i < job.point_count; i += step) {
    const uvec2 point = points[job.first_point + i];
    const ivec2 offset = ivec2(bitfieldExtract(int(point.x), 0, 16), bitfieldExtract(int(point.x), 16, 16));
    sum += value_at(anchor + offset, point.y & 0xffffu);
  }
  return sum;
}

void main() {
  const uint j = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
  if (j >= push.job_count) return;
  const uint lane = gl_LocalInvocationID.x;
  const Job job = read_job(j);
  if (lane == 0u) {
    best_sum = 0xffffffffu;
    best_anchor = 0xffffffffu;
  }
  uint sum = 0xffffffffu, anchor = 0;
  const bool shares_anchors = job.anchors <= TEMPLATE_SCORE_GROUP / 2u;
  const uint lanes = shares_anchors ? TEMPLATE_SCORE_GROUP / job.anchors : 1u;  // of an anchor
  if (!shares_anchors) {
    [[dont_unroll]] for (uint a = lane; a < job.anchors; a += TEMPLATE_SCORE_GROUP) {
      const uint here = sum_points(job, anchor_of(job, a), 0u, 1u);
      if (here < sum) {
        sum = here;
        anchor = a;
      }
    }
  } else {
    // Lanes of one anchor share its points.
    const uint a = lane / lanes;
    partial[lane] = a < job.anchors ? sum_points(job, anchor_of(job, a), lane % lanes, lanes) : 0u;
  }
  // For every job: barriers must not depend on what a buffer holds.
  barrier();
  if (shares_anchors && lane < job.anchors) {
    sum = 0;
    [[dont_unroll]] for (uint i = 0; i < lanes; ++i) sum += partial[lane * lanes + i];
    anchor = lane;
  }
  atomicMin(best_sum, sum);
  barrier();
  // Equal sums: the first anchor in the order of rows.
  if (sum == best_sum) atomicMin(best_anchor, anchor);
  barrier();
  if (lane == 0u) {
    const ivec2 at = anchor_of(job, best_anchor);
    hits[j * TEMPLATE_HIT_WORDS] = best_sum;
    hits[j * TEMPLATE_HIT_WORDS + 1] = uint(at.x);
    hits[j * TEMPLATE_HIT_WORDS + 2] = uint(at.y);
  }
}
