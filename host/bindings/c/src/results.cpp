#include "host/bindings/c/src/results.h"

#include "host/bindings/c/src/poses.h"
#include "host/bindings/c/src/structs.h"

namespace edgescout::c {

FoundObject named(Detection detection, std::span<const TemplateSet> sets) {
  const TemplateSet& set = sets[std::size_t(detection.object)];
  return {std::move(detection), set.object_id, set.model.mesh.name, {}};
}

FoundObjects named(Detections detections, std::span<const TemplateSet> sets) {
  FoundObjects result{{}, detections.completion, std::move(detections.stages)};
  for (Detection& detection : detections.detections)
    result.found.push_back(named(std::move(detection), sets));
  return result;
}

namespace {

edgescout_detection shown_detection(const FoundObject& found) {
  edgescout_detection shown{};
  shown.object = found.object;
  shown.object_id = found.object_id;
  shown.name = found.name.c_str();
  write_pose(found.world_from_object, shown.world_from_object);
  write_covariance(found.covariance, shown.covariance);
  shown.probability = found.probability;
  shown.psi = found.psi;
  shown.psi_z_score = found.psi_z_score;
  shown.cost_px = found.cost_px;
  shown.matched_fraction = found.matched_fraction;
  shown.unexplained_grey = found.unexplained_grey;
  shown.convergence = found.convergence.c_str();
  shown.alternative_count = found.alternatives.size();
  shown.supporting_image_count = found.supporting_images.size();
  shown.supporting_images = found.supporting_images.data();
  return shown;
}

edgescout_alternative shown_alternative(const AlternativePose& alternative) {
  edgescout_alternative shown{};
  write_pose(alternative.world_from_object, shown.world_from_object);
  shown.probability = alternative.probability;
  return shown;
}

}  // namespace

}  // namespace edgescout::c

using namespace edgescout::c;

edgescout_status edgescout_detections_get(const edgescout_detections* detections,
                                          edgescout_summary* out) {
  return guarded([&] {
    const auto given = shared(detections);
    edgescout_summary shown{};
    shown.detection_count = given->found.size();
    shown.stage_count = given->stages.size();
    shown.completion = std::int32_t(given->completion);
    write_struct(shown, out, "out");
  });
}

edgescout_status edgescout_detections_at(const edgescout_detections* detections, size_t index,
                                         edgescout_detection* out) {
  return guarded([&] {
    const auto given = shared(detections);
    require_index(index, given->found.size(), "index");
    write_struct(shown_detection(given->found[index]), out, "out");
  });
}

edgescout_status edgescout_detections_alternative(const edgescout_detections* detections,
                                                  size_t index, size_t alternative,
                                                  edgescout_alternative* out) {
  return guarded([&] {
    const auto given = shared(detections);
    require_index(index, given->found.size(), "index");
    const auto& alternatives = given->found[index].alternatives;
    require_index(alternative, alternatives.size(), "alternative");
    write_struct(shown_alternative(alternatives[alternative]), out, "out");
  });
}

edgescout_status edgescout_detections_stage(const edgescout_detections* detections, size_t stage,
                                            edgescout_stage* out) {
  return guarded([&] {
    const auto given = shared(detections);
    require_index(stage, given->stages.size(), "stage");
    const edgescout::StageSeconds& timed = given->stages[stage];
    write_struct(edgescout_stage{0, timed.name.c_str(), timed.seconds}, out, "out");
  });
}
