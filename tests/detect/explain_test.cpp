// Rendered parts whose loss is forced at every stage in turn.
#include "host/detect/explain.h"

#include <gtest/gtest.h>

#include <limits>

#include "host/register/pose_classifier.h"
#include "tests/detect/rendered_part.h"
#include "tests/io/expect_input_error.h"

namespace edgescout::test {
namespace {

// A detection that keeps what every stage held.
struct Traced {
  std::unique_ptr<Backend> backend = make_cpu_backend(2);
  const RenderedPart& rendered;
  std::vector<EdgeModel> models;
  PipelineOptions options;
  DetectTrace trace;
  std::vector<Detection> detections;

  explicit Traced(const RenderedPart& part, const PipelineOptions& given)
      : rendered(part), models(models_of(part.sets)), options(given) {
    detections =
        detect_objects(part.prepared(0, Se3{}, *backend), part.sets, *backend, options, &trace)
            .detections;
  }

  LossReport explain(const Se3& camera_from_object, const SamePoseOptions& same = {}) const {
    return explain_loss({models, {&trace.view, 1}, *backend}, rendered.sets[0], trace,
                        {0, camera_from_object}, options.detect, same);
  }
  LossReport explain_placed(std::size_t placed) const {
    return explain(rendered.truth_in(0, placed));
  }
};

PipelineOptions few_poses() {
  PipelineOptions options = RenderedPart::options();
  options.detect.coarse_poses = 400;
  options.detect.medium_poses = 100;
  return options;
}

TEST(ExplainLoss, FollowsAReportedPoseThroughAllStages) {
  const RenderedPart part("l_bracket");
  const Traced t(part, few_poses());
  const LossReport report = t.explain_placed(0);
  EXPECT_EQ(report.lost_at, LossStage::Reported);
  EXPECT_NEAR(report.range.distance_m, (part.truth_in(0) * part.sets[0].model.center_m).norm(),
              1e-12);
  EXPECT_TRUE(report.range.holds());
  EXPECT_TRUE(report.edges.exceeds_copies());
  EXPECT_EQ(report.scan.hits, t.trace.searches[0].hits.size());
  EXPECT_EQ(report.scan.aligned, 400u);
  ASSERT_TRUE(report.scan.rank.has_value());
  EXPECT_LE(*report.scan.rank, 400u);
  EXPECT_GT(report.scan.mean_px, report.scan.own_mean_px) << "templates stand beside the pose";
  EXPECT_GT(report.support.medium_near, 0u);
  EXPECT_EQ(report.support.medium, t.trace.searches[0].medium_starts.size());
  EXPECT_GE(report.support.best_near, report.support.last);
  EXPECT_GT(report.support.own, report.support.last);
  EXPECT_GT(report.alignment.same, 0u);
  EXPECT_TRUE(report.alignment.nearest->error.passes());
  EXPECT_TRUE(report.ranking.is_candidate);
  EXPECT_EQ(report.ranking.candidates, t.trace.searches[0].candidates.size());
  EXPECT_GE(report.ranking.log_odds, report.ranking.last_log_odds);
  ASSERT_TRUE(report.refinement.same.has_value());
  EXPECT_TRUE(report.refinement.same->error.passes());
  EXPECT_TRUE(report.refinement.own.error.passes());
  EXPECT_NEAR(report.refinement.own.probability, report.refinement.same->probability, 0.1);
  EXPECT_TRUE(report.selection.competes);
  ASSERT_TRUE(report.selection.selected.has_value());
  ASSERT_LE(report.selection.rank, t.detections.size());
  EXPECT_EQ(report.selection.selected->probability,
            t.detections[report.selection.rank - 1].probability);
  EXPECT_TRUE(report.selection.selected->error.passes());
  EXPECT_FALSE(report.rival.has_value());
}

TEST(DetectTrace, LeavesTheDetectionsAsTheyAre) {
  const RenderedPart part("l_bracket");
  const Traced t(part, few_poses());
  const std::vector<Detection> plain =
      detect_objects(part.prepared(0, Se3{}, *t.backend), part.sets, *t.backend, t.options)
          .detections;
  ASSERT_EQ(plain.size(), t.detections.size());
  for (std::size_t i = 0; i < plain.size(); ++i) {
    EXPECT_EQ(plain[i].world_from_object.translation_m,
              t.detections[i].world_from_object.translation_m);
    EXPECT_EQ(plain[i].probability, t.detections[i].probability);
  }
  const SearchTrace& search = t.trace.searches.at(0);
  EXPECT_EQ(search.coarse.size(), search.starts.size());
  EXPECT_EQ(search.medium.size(), search.medium_starts.size());
  EXPECT_LT(search.medium.size(), search.starts.size());
  EXPECT_EQ(search.fine.size(), search.candidates.size());
  EXPECT_EQ(t.trace.selection.selected.size(), t.detections.size());
}

TEST(ExplainLoss, NamesTheRange) {
  const RenderedPart part("l_bracket");
  PipelineOptions options = few_poses();
  options.detect.scan.within = {0, 0, 40, 40};
  const LossReport outside = Traced(part, options).explain_placed(0);
  EXPECT_EQ(outside.lost_at, LossStage::Range);
  EXPECT_FALSE(outside.range.in_region);
  EXPECT_TRUE(outside.range.in_distances);

  options.detect.scan.within = {};
  options.detect.scan.world.box_m = {0, 0, 0, 0.1, 0.1, 0.1};  // in front of the camera
  const LossReport beside = Traced(part, options).explain_placed(0);
  EXPECT_EQ(beside.lost_at, LossStage::Range);
  EXPECT_FALSE(beside.range.in_prior);
  EXPECT_TRUE(beside.range.in_region);
  EXPECT_TRUE(outside.range.in_prior);

  RenderedPart nearer = part;
  TemplateOptions templates = near_templates(0.03);
  templates.distance_min_m = 0.1, templates.distance_max_m = 0.12;
  nearer.sets = {build_templates(part.part, templates, *make_cpu_backend(2))};
  PipelineOptions fewest = few_poses();  // among many starts one ends at the part from anywhere
  fewest.detect.coarse_poses = 5;
  const LossReport far = Traced(nearer, fewest).explain_placed(0);
  EXPECT_EQ(far.lost_at, LossStage::Range);
  EXPECT_FALSE(far.range.in_distances);
  EXPECT_EQ(far.range.distance_max_m, 0.12);
  EXPECT_TRUE(far.range.in_region);

  const Eigen::Vector3d towards_camera =
      (inverse(part.truth_in(0)).translation_m - part.sets[0].model.center_m).normalized();
  templates = near_templates(0.03);
  (towards_camera.z() > 0 ? templates.range.latitude_max_deg : templates.range.latitude_min_deg) =
      towards_camera.z() > 0 ? -60 : 60;
  nearer.sets = {build_templates(part.part, templates, *make_cpu_backend(2))};
  const LossReport behind = Traced(nearer, few_poses()).explain_placed(0);
  EXPECT_FALSE(behind.range.in_viewpoints);
  EXPECT_GT(behind.range.viewpoint_angle_rad, 0.3);
}

TEST(ExplainLoss, NamesTheEdgesWhereThereIsNoPart) {
  RenderedPart part("l_bracket");
  const Se3 where_it_was = part.truth_in(0);
  part.scene.placed.clear();
  ThreadPool pool(2);
  part.renderings = render(part.scene, pool);
  const LossReport report = Traced(part, few_poses()).explain(where_it_was);
  EXPECT_EQ(report.lost_at, LossStage::Edges);
  EXPECT_FALSE(report.edges.exceeds_copies());
  EXPECT_FALSE(report.rival.has_value());
}

// Of two parts one has the better hits. The rank of the other's is the number of distinct hits that
// must be aligned to have it among them.
TEST(ExplainLoss, NamesTheScanAndTheRankThatWouldDo) {
  const RenderedPart parts("bearing_block", 1, 2);
  PipelineOptions options = few_poses();
  options.detect.coarse_poses = 1;
  const Traced t(parts, options);
  const LossReport first = t.explain_placed(0), second = t.explain_placed(1);
  const bool first_is_lost = first.lost_at == LossStage::Scan;
  const LossReport& lost = first_is_lost ? first : second;
  ASSERT_EQ(lost.lost_at, LossStage::Scan);
  EXPECT_EQ(lost.scan.aligned, 1u);
  EXPECT_EQ(lost.scan.aligned_near, 0u);
  ASSERT_TRUE(lost.scan.rank.has_value());
  for (const int more : {0, -1}) {
    options.detect.coarse_poses = int(*lost.scan.rank) + more;
    const LossReport again = Traced(parts, options).explain_placed(first_is_lost ? 0 : 1);
    EXPECT_EQ(again.scan.aligned_near, more == 0 ? 1u : 0u);
    EXPECT_EQ(again.scan.rank, lost.scan.rank);
  }
}

// Of two parts one has the best hit after the coarse stage.
TEST(ExplainLoss, NamesTheSupportThatOthersExceed) {
  const RenderedPart parts("bearing_block", 1, 2);
  PipelineOptions options = few_poses();
  options.detect.medium_poses = 1;
  const Traced t(parts, options);
  const LossReport first = t.explain_placed(0), second = t.explain_placed(1);
  const LossReport& lost = first.lost_at == LossStage::Support ? first : second;
  ASSERT_EQ(lost.lost_at, LossStage::Support);
  EXPECT_GT(lost.scan.aligned_near, 0u);
  EXPECT_EQ(lost.support.medium, 1u);
  EXPECT_EQ(lost.support.medium_near, 0u);
  EXPECT_LT(lost.support.best_near, lost.support.last);
  EXPECT_FALSE(lost.alignment.best_hit_became.has_value());
}

// No registration is exact to a micrometre.
TEST(ExplainLoss, NamesTheAlignmentAndWhereItWent) {
  const RenderedPart part("l_bracket");
  SamePoseOptions exact;
  exact.max_angle_rad = 1e-5, exact.max_distance_m = 1e-6;
  const LossReport report = Traced(part, few_poses()).explain(part.truth_in(0), exact);
  EXPECT_EQ(report.lost_at, LossStage::Alignment);
  EXPECT_EQ(report.alignment.same, 0u);
  ASSERT_TRUE(report.rival.has_value());
  const PoseError error =
      pose_error(report.rival->world_from_object, part.truth_in(0), part.part.symmetries);
  EXPECT_LT(error.distance_m, 0.02);
  EXPECT_NEAR(report.rival->error.distance_m, error.distance_m, 1e-9);
  EXPECT_GT(report.rival->probability, 0);
}

// As for the scan: with as many candidates as the rank the pose is one of them.
TEST(ExplainLoss, NamesTheRankingAndTheRankThatWouldDo) {
  const RenderedPart parts("bearing_block", 1, 2);
  PipelineOptions options = few_poses();
  options.detect.candidates = 1;
  const Traced t(parts, options);
  const LossReport first = t.explain_placed(0), second = t.explain_placed(1);
  const bool first_is_lost = first.lost_at == LossStage::Ranking;
  const LossReport& lost = first_is_lost ? first : second;
  ASSERT_EQ(lost.lost_at, LossStage::Ranking);
  EXPECT_EQ(lost.ranking.candidates, 1u);
  EXPECT_LT(lost.ranking.log_odds, lost.ranking.last_log_odds);
  for (const int more : {0, -1}) {
    options.detect.candidates = int(*lost.ranking.rank) + more;
    const LossReport again = Traced(parts, options).explain_placed(first_is_lost ? 0 : 1);
    EXPECT_EQ(again.ranking.is_candidate, more == 0);
  }
}

TEST(ExplainLoss, NamesTheRefinementThatWentAstray) {
  const RenderedPart part("l_bracket");
  Traced t(part, few_poses());
  for (PoseEstimate& pose : t.trace.searches[0].fine)
    pose.world_from_object.translation_m.x() += 0.02;
  t.trace.selection = {};
  const LossReport report = t.explain_placed(0);
  EXPECT_EQ(report.lost_at, LossStage::Refinement);
  ASSERT_TRUE(report.rival.has_value());
  EXPECT_GT(report.rival->error.distance_m, 0.005);
}

TEST(ExplainLoss, NamesTheProbability) {
  const RenderedPart part("l_bracket");
  PipelineOptions options = few_poses();
  options.detect.min_probability = 0.9999;
  const LossReport report = Traced(part, options).explain_placed(0);
  EXPECT_EQ(report.lost_at, LossStage::Probability);
  EXPECT_LT(report.refinement.same->probability, 0.9999);
  EXPECT_GT(report.refinement.same->features.psi, 0.7);
}

// A pose that is probable enough until it shares its odds with its alternatives.
TEST(ExplainLoss, NamesTheProbabilityWhereAlternativesShareIt) {
  const RenderedPart part("l_bracket");
  Traced t(part, few_poses());
  SelectionTrace& selection = t.trace.selection;
  ASSERT_FALSE(selection.selected.empty());
  Detection fallen = selection.selected[0];
  fallen.probability = 0.31;
  fallen.alternatives.resize(2);
  selection.less_probable = {fallen};
  EXPECT_EQ(t.explain(fallen.world_from_object).lost_at, LossStage::Reported);
  selection.selected.clear();
  const LossReport report = t.explain(fallen.world_from_object);
  EXPECT_EQ(report.lost_at, LossStage::Probability);
  EXPECT_EQ(report.selection.shared_probability, 0.31);
  EXPECT_EQ(report.selection.alternatives, 2u);
}

TEST(ExplainLoss, NamesTheSelectionThatReportsOthers) {
  const RenderedPart parts("bearing_block", 1, 2);
  PipelineOptions options = few_poses();
  options.detect.max_detections = 1;
  const Traced t(parts, options);
  const LossReport first = t.explain_placed(0), second = t.explain_placed(1);
  const LossReport& lost = first.lost_at == LossStage::Reported ? second : first;
  EXPECT_NE(first.lost_at, second.lost_at);
  EXPECT_EQ(lost.lost_at, LossStage::Selection);
  EXPECT_GT(lost.selection.rank, 1u);
  EXPECT_FALSE(lost.selection.is_reported);
  EXPECT_LT(lost.selection.claimed, 0.3) << "the parts lie apart";
}

// A pose a little beside the reported one, refined from a turned start, is chosen in its place.
TEST(ExplainLoss, NamesTheSelectionAndWhoClaimsTheEdges) {
  const RenderedPart part("l_bracket");
  Traced t(part, few_poses());
  SelectionTrace& selection = t.trace.selection;
  ASSERT_FALSE(selection.selected.empty());
  const Se3 reported = selection.selected[0].world_from_object;
  PoseEstimate winner = selection.competing[0];
  winner.world_from_object = reported;
  winner.world_from_object.translation_m.x() += 0.0015;
  selection.first_restarted = selection.competing.size();
  selection.competing.push_back(winner);
  selection.selected.resize(1);
  selection.selected[0].world_from_object = winner.world_from_object;
  SamePoseOptions near;
  near.max_distance_m = 0.001;
  const LossReport report = t.explain(reported, near);
  EXPECT_EQ(report.lost_at, LossStage::Selection);
  EXPECT_FALSE(report.selection.selected.has_value());
  EXPECT_GT(report.selection.claimed, 0.5);
  ASSERT_TRUE(report.rival.has_value());
  EXPECT_NEAR(report.rival->error.distance_m, 0.0015, 1e-9);
  EXPECT_EQ(report.rival->claimed, report.selection.claimed);
  EXPECT_TRUE(report.rival->is_restarted);

  // The same pose as a duplicate of a better one, which alone competes.
  std::vector<PoseEstimate>& fine = t.trace.searches[0].fine;
  t.trace.searches[0].candidates.resize(2);
  fine = {selection.competing[0], selection.competing[0]};
  for (PoseEstimate& pose : fine) pose.world_from_object = reported, pose.object = 0;
  fine[1].world_from_object.translation_m.x() += 0.0015;
  fine[1].features[0].psi = 1;
  classify(fine[1]);
  selection.competing = {fine[1]};
  const LossReport duplicate = t.explain(reported, near);
  EXPECT_EQ(duplicate.lost_at, LossStage::Selection);
  EXPECT_FALSE(duplicate.selection.competes);
  ASSERT_TRUE(duplicate.rival.has_value());
  EXPECT_NEAR(duplicate.rival->error.distance_m, 0.0015, 1e-9);
}

TEST(ExplainLoss, RefusesPosesThatNoImageShows) {
  const RenderedPart part("l_bracket");
  const Traced t(part, few_poses());
  const Se3 truth = part.truth_in(0);
  const auto refused = [&](const Se3& given, std::initializer_list<std::string> words) {
    expect_input_error([&] { t.explain(given); }, words);
  };
  refused({truth.rotation, -truth.translation_m}, {"given pose", "behind the camera"});
  refused({truth.rotation, {2, 0, 0.3}}, {"given pose", "the image shows no edge"});
  refused({Eigen::Quaterniond(2, 0, 0, 0), truth.translation_m}, {"given pose", "quaternion"});
  refused({truth.rotation, {0, 0, std::numeric_limits<double>::quiet_NaN()}}, {"not finite"});
  SamePoseOptions none;
  none.max_angle_rad = 0;
  expect_input_error([&] { t.explain(truth, none); }, {"same_pose.max_angle"});
}

}  // namespace
}  // namespace edgescout::test
