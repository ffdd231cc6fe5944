// Writes the page of an active detection, step by step.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "host/cli/drawings.h"
#include "host/cli/page_parts.h"
#include "host/cli/scout_report.h"
#include "host/overlay.h"

namespace edgescout {

namespace {

std::string figure(const std::string& picture, const std::string& caption) {
  return "<figure>" + picture + "<figcaption>" + caption + "</figcaption></figure>";
}

std::string png_figure(const RgbImage& image, const std::string& caption) {
  return figure(fmt::format("<img class=picture alt='' src='{}'>", inline_png(encode_png(image))),
                caption);
}

std::string seconds_of(const std::vector<StageSeconds>& stages) {
  double sum = 0;
  for (const StageSeconds& stage : stages) sum += stage.seconds;
  return fmt::format("{:.2f} s", sum);
}

class Page {
 public:
  Page(const ScoutState& state, const ScoutReport& report, Backend& backend)
      : state_(state), report_(report), backend_(backend), models_(models_of(report.sets)) {
    for (const ScoutStep& step : state.steps)
      edges_.emplace_back(find_edges(step.image, report.edges, backend), step.image.width,
                          step.image.height);
  }

  std::string body() const {
    std::string html = header();
    if (!state_.steps.empty())
      html += first_image() + "<section><h2>Found</h2>" + found_table() + "<div class=row>" +
              final_overlays() + "</div></section>";
    for (std::size_t i = 0; i < state_.steps.size(); ++i) html += failures_after(i) + step(i);
    return html + failures_after(state_.steps.size()) + legend();
  }

 private:
  static std::string legend() {
    return "<section class=legend><h2>Legend</h2><dl>"
           "<dt>green, orange<dd>Edges of the model that have an edge of the image near, or none."
           "<dt>red, green, blue axes<dd>x, y, z of the CAD frame, drawn at the centre of its box."
           "<dt>image, view<dd>Images count from 1, in the order taken. Views are places of the "
           "camera and count from 0."
           "<dt>number beside an object<dd>Probability, rounded: 1.00 is 0.995 or more."
           "<dt>ψ<dd>Agreement of the image's gradients with the model's edges, 0 to 1; about 0.64 "
           "by chance."
           "<dt>rings<dd>Elevation of the views, degrees; the middle is straight above. A number "
           "in a black dot is the image taken there."
           "<dt>particle<dd>A sampled pose: a dot with the object's x and y axes, in a colour for "
           "each model; opaque: heavy. Sampled anew (resampled) where few carry the weight; the "
           "effective sample size says how many do."
           "<dt>nat<dd>Unit of information, 1.44 bit."
           "<dt>edges<dd>Share of the visible model edges that have an edge of the image near."
           "<dt>σ place, σ direction<dd>Standard deviation of the pose, mean over the axes."
           "<dt>none alone<dd>No single image supports the object; all images together do."
           "<dt>combination<dd>A set of candidates that can exist together. "
           "The pictures show the likeliest and the unlikeliest of those that were sampled for "
           "the decision."
           "<dt>entropy<dd>How undecided the belief is, nats: a sum over all places where an "
           "object may be, most of which are not reported. 0: each is certainly an object or none."
           "</dl></section>";
  }

  std::string header() const {
    const std::vector<ScoutStep>& steps = state_.steps;
    std::string html = fmt::format(
        "<header><h1>edgescout <em>scout</em></h1><p>{} · {} · strategy <b>{}</b></p></header><div "
        "class=tiles>",
        escaped_html(report_.source), escaped_html(report_.device), report_.strategy);
    html += tile(fmt::format("{} of {}", steps.size(), state_.views.size()), "views taken");
    html += tile(std::to_string(state_.detections.size()), "objects found");
    if (!report_.truth.empty())
      html += tile(fmt::format("{} of {}", count_right(), report_.truth.size()),
                   "right, of those that are there");
    if (!steps.empty())
      html += tile(fmt::format("{:.2f} → {:.2f}", steps.front().entropy_nats, state_.entropy_nats),
                   "entropy after the first and last image, nats");
    if (const std::string images = disagreeing_images(state_); !images.empty())
      html += tile(images, "images whose camera pose disagrees");
    html += tile(fmt::format("{:.1f} s", state_.seconds()), "computing");
    const bool ended = state_.end != ScoutEnd::No;
    return html +
           tile(ended ? to_string(state_.end) : "looking …", ended ? "why it ended" : "state") +
           "</div>";
  }

  // Counts each instance once, even with several right detections.
  std::size_t count_right() const {
    std::set<std::size_t> instances;
    for (const ModeDetection& mode : state_.detections)
      if (const auto off = distance_to_truth(mode.detection, report_); off && off->right)
        instances.insert(off->instance);
    return instances.size();
  }

  // Every picture of particles refers to this image.
  std::string first_image() const {
    const Image& image = state_.steps[0].image;
    return fmt::format(
        "<svg class=hidden><defs><image id=first width={} height={} href='{}'/></defs></svg>",
        image.width, image.height, inline_png(encode_png(image)));
  }

  std::string found_table() const {
    std::string html =
        "<table><tr><th>object<th>probability<th>ψ<th>edges<th>σ place<th>σ direction<th>images "
        "that support it";
    if (!report_.truth.empty()) html += "<th>off the truth";
    for (const ModeDetection& mode : state_.detections) {
      const Detection& d = mode.detection;
      const double place_m = std::sqrt(d.covariance.topLeftCorner<3, 3>().trace() / 3),
                   turn_rad = std::sqrt(d.covariance.bottomRightCorner<3, 3>().trace() / 3);
      std::string support;
      for (const int image : mode.supporting_images) support += fmt::format(" {}", image + 1);
      html += fmt::format(
          "<tr><td>{}<td>{:.2f}<td>{:.2f}<td>{:.0f} %<td>{:.2f} mm<td>{:.2f}°<td>{}",
          escaped_html(name_of(d)), d.probability, d.psi, 100 * d.matched_fraction, 1000 * place_m,
          turn_rad * 57.29578, support.empty() ? "none alone" : support);
      if (const auto off = distance_to_truth(d, report_))
        html += fmt::format("<td class={}>{:.1f} mm, {:.1f}°", off->right ? "right" : "wrong",
                            1000 * off->distance_m, off->angle_rad * 57.29578);
    }
    return html + "</table>";
  }

  std::string final_overlays() const {
    std::string html;
    for (std::size_t i = 0; i < state_.steps.size(); ++i)
      html += png_figure(overlay(i, state_.detections), fmt::format("image {}", i + 1));
    return html;
  }

  RgbImage overlay(std::size_t image, const std::vector<ModeDetection>& detections) const {
    const ScoutStep& step = state_.steps[image];
    std::vector<OverlayPose> poses;
    for (const ModeDetection& mode : detections)
      poses.push_back({mode.detection.object,
                       step.camera_from_world * mode.detection.world_from_object,
                       mode.detection.probability, ""});
    return draw_overlay(step.image, report_.camera, poses, models_, &edges_[image], backend_);
  }

  std::string step(std::size_t i) const {
    const ScoutStep& s = state_.steps[i];
    const ScoutDecision& why = s.decision;
    std::string html =
        fmt::format("<section><h2>Image {} <small>view {}{}</small></h2>{}<div class=row>", i + 1,
                    why.view, expectation(why), warnings(s));
    html += figure(hemisphere(i), hemisphere_caption(why));
    html += png_figure(overlay(i, s.detections),
                       fmt::format("{} objects after this image", s.detections.size()));
    html += "</div><div class=row>" +
            figure(particles(s.before),
                   fmt::format("{} particles before, seen from image 1", s.before.size()));
    html += figure(particles(s.after),
                   fmt::format("and after: {}, {:.3f} nats gained, effective sample size {:.0f}{}",
                               s.after.size(), s.update.gained_nats, s.update.effective,
                               s.update.reseeded ? ", all had died and were drawn anew"
                               : s.resampled     ? ", resampled"
                                                 : ""));
    html += "</div>";
    if (!why.likeliest.empty() || !why.unlikeliest.empty())
      html += "<div class=row>" + combinations(why) + "</div>";
    return html + numbers(s) + "</section>";
  }

  // The expectation by which the view was chosen.
  static std::string expectation(const ScoutDecision& why) {
    if (why.views.empty()) return "";
    const ViewInformation& chosen = why.views[static_cast<std::size_t>(why.view)];
    if (why.strategy == Strategy::Information && why.use_paper_formula)
      return fmt::format(", {:.3g} by the paper's own formula", chosen.expected());
    if (why.strategy == Strategy::Information)
      return fmt::format(", {:.3f} nats expected{}", chosen.expected(), share_of_unknown(chosen));
    if (why.strategy == Strategy::Disocclusion)
      return fmt::format(", {:.0f} points that no image has shown", chosen.expected());
    return "";
  }

  static std::string hemisphere_caption(const ScoutDecision& why) {
    if (why.views.empty()) return "The views, from above. Nothing is known before the first image.";
    const char* by = why.strategy == Strategy::Information ? "the information expected of it"
                     : why.strategy == Strategy::Disocclusion
                         ? "the points it shows that no image has shown"
                     : why.strategy == Strategy::Random ? "its draw"
                                                        : "its place in the sequence";
    return fmt::format("Every view by {}, from above. Ringed: the one chosen.", by);
  }

  static std::string share_of_unknown(const ViewInformation& view) {
    return view.discovery > 0 ? fmt::format(", {:.3f} of them of what is unknown", view.discovery)
                              : "";
  }

  // Of this image and of earlier ones, which are checked again with every image.
  static std::string warnings(const ScoutStep& s) {
    std::string html;
    for (std::size_t i = 0; i < s.extrinsics_checks.size(); ++i)
      if (const ExtrinsicsCheck& view = s.extrinsics_checks[i]; view.disagrees)
        html += fmt::format(
            "<p class=warning>The camera pose of image {} disagrees with the others: {}.</p>",
            i + 1,
            view.missing > 0
                ? fmt::format("it shows none of {} objects, or something unknown hides them",
                              view.missing)
                : fmt::format("the objects lie {:.1f} px off", view.residual_px));
    return html;
  }

  std::string hemisphere(std::size_t step) const {
    const ScoutDecision& why = state_.steps[step].decision;
    std::vector<DrawnView> drawn;
    for (const Se3& view : state_.views) drawn.push_back({view, {}, 0, false, false});
    for (std::size_t v = 0; v < why.views.size(); ++v)
      if (why.views[v].open) drawn[v].information = why.views[v].expected();
    for (std::size_t k = 0; k < step; ++k)
      drawn[state_.steps[k].decision.view].taken = static_cast<int>(k) + 1;
    for (const FailedView& failed : state_.failed)
      if (failed.after_step <= step) drawn[failed.view].unreachable = true;
    drawn[why.view].chosen = true;
    return hemisphere_svg(drawn, unit_of(why));
  }

  std::string particles(const std::vector<Particle>& particles) const {
    double total = 0;
    for (const Particle& particle : particles) total += std::exp(particle.log_weight);
    std::vector<DrawnParticle> drawn;
    for (const Particle& p : particles)
      drawn.push_back({p.object, state_.steps[0].camera_from_world * p.world_from_object,
                       total > 0 ? std::exp(p.log_weight) / total : 0});
    return particles_svg("first", report_.camera, drawn, models_);
  }

  std::string combinations(const ScoutDecision& why) const {
    const auto drawn = [&](const std::vector<int>& members, const char* caption) {
      std::vector<DrawnObject> objects;
      for (const int c : members) objects.push_back({{why.candidates[c]}, c});
      ObjectView view;
      view.camera = report_.camera;
      view.camera_from_world = state_.views[why.view];
      const RgbImage map = edge_map(models_, objects, view, 560, backend_);
      return png_figure(map, fmt::format("{} combination seen from this view: {} of {} candidates",
                                         caption, members.size(), why.candidates.size()));
    };
    return drawn(why.likeliest, "Likeliest") + drawn(why.unlikeliest, "Unlikeliest");
  }

  std::string numbers(const ScoutStep& s) const {
    const auto row = [](const std::vector<StageSeconds>& stages) {
      std::string cells;
      for (const StageSeconds& stage : stages)
        cells += fmt::format("<span class=stage>{} <b>{:.0f} ms</b></span> ", stage.name,
                             1000 * stage.seconds);
      return cells;
    };
    return fmt::format(
        "<p class=numbers>entropy <b>{:.3f} nats</b> · {} new candidates in {} · decision {} {}· "
        "image {} {}</p>",
        s.entropy_nats, s.new_candidates,
        s.searches == 1 ? "one search" : fmt::format("{} searches", s.searches),
        seconds_of(s.decision.stages), row(s.decision.stages), seconds_of(s.stages), row(s.stages));
  }

  std::string failures_after(std::size_t step) const {
    std::string html;
    for (const FailedView& failed : state_.failed)
      if (failed.after_step == step)
        html += fmt::format("<p class=warning>View {} could not be had: {}</p>", failed.view,
                            escaped_html(failed.reason));
    return html;
  }

  std::string name_of(const Detection& d) const {
    const TemplateSet& set = report_.sets[static_cast<std::size_t>(d.object)];
    return fmt::format("{} {}", set.object_id, set.model.mesh.name);
  }

  const ScoutState& state_;
  const ScoutReport& report_;
  Backend& backend_;
  std::vector<EdgeModel> models_;
  std::vector<EdgeIndex> edges_;  // of every image
};

}  // namespace

std::string scout_page(const ScoutState& state, const ScoutReport& report, bool refreshing,
                       Backend& backend) {
  return html_page("edgescout scout", refreshing ? "<meta http-equiv=refresh content=2>" : "",
                   Page(state, report, backend).body());
}

}  // namespace edgescout
