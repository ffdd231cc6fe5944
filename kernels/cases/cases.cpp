#include "kernels/cases/cases.h"

#include <cstdio>
#include <numbers>

#include "kernels/cases/combination_cases.h"
#include "kernels/cases/synthetic.h"

namespace edgescout::bench {

namespace {

struct Scale {
  int width, height, edge_points;   // of the image
  int coarse_width, coarse_height;  // of the tensor that templates are scored on
  int templates, problems, pose_points;
  int maps, map_width, map_height, rings;
  NextViewSize next_view;
};

constexpr Scale scale_of(Size size) {
  if (size == Size::full)
    return {1024, 768, 30000, 256, 192, 5000, 40, 1500, 40, 320, 240, 60, paper_size};
  return {256, 192, 1900, 64, 48, 300, 4, 500, 4, 80, 60, 20, {2, 8, 10, 100, 64, 48, 100}};
}

std::string by(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

Intrinsics camera_of(const Scale& s) {
  return {1.2f * float(s.width), 1.2f * float(s.width), 0.5f * float(s.width),
          0.5f * float(s.height)};
}

std::size_t tensor_bytes(int width, int height, int bins) {
  return 2 * TensorShape{width, height, bins}.size();
}

Case tensor_case(Backend& backend, const Scale& s) {
  std::mt19937 rng(1);
  const auto edges = random_segments(rng, s.width, s.height, s.edge_points);
  const TensorOptions options;
  return {"dcd_tensor",
          by(s.width, s.height) + "x" + std::to_string(options.bins) + ", " +
              std::to_string(s.edge_points) + " points",
          tensor_bytes(s.width, s.height, options.bins), [&backend, edges, s, options] {
            backend.make_view(edges, s.width, s.height, {}, {}, options);
          }};
}

// The templates of one region: the points of a template set's viewpoints under many poses.
Case projection_case(Backend& backend, const Scale& s) {
  std::mt19937 rng(7);
  constexpr std::uint32_t viewpoints = 162, points = 60;
  const Poses poses = random_poses(rng, s.templates, viewpoints * points);
  const ModelPointsHandle kept = backend.make_model_points(poses.points);
  const float focal = 1.2f * float(s.coarse_width), x = 0.5f * float(s.coarse_width),
              y = 0.5f * float(s.coarse_height);
  const TemplateProjectOptions options{{focal, focal, x, y}, TensorOptions{}.bins, 0.01f};
  std::vector<TemplateProjectJob> jobs;
  for (std::uint32_t t = 0; t < poses.problems.size(); ++t)
    jobs.push_back(
        {poses.problems[t].camera_from_object, t % viewpoints * points, points, t * points, x, y});
  const auto projected = std::make_shared<std::vector<TemplatePoint>>(jobs.size() * points);
  const auto too_near = std::make_shared<std::vector<std::uint32_t>>(jobs.size());
  return {"template_project",
          std::to_string(s.templates) + " templates of " + std::to_string(points) + " points",
          poses.points.size() * sizeof(ModelPoint) + jobs.size() * sizeof(TemplateProjectJob) +
              projected->size() * sizeof(TemplatePoint),
          [&backend, kept, options, jobs, projected, too_near] {
            backend.template_project(*kept, jobs, options, *projected, *too_near);
          }};
}

// What a TemplateScan refers to: all templates of a set at two regions.
struct ScanInput {
  ViewHandle view;
  ModelPointsHandle points;
  std::vector<ViewpointPoints> viewpoints;
  std::vector<float> distances_m{0.3f};
  std::vector<TemplateRegion> regions;
  std::vector<TemplateAnchors> anchors;
  std::vector<Pose> turned;
  std::vector<std::uint32_t> numbers;
  std::vector<TemplateHit> hits;
};

Case scan_case(Backend& backend, const Scale& s) {
  std::mt19937 rng(8);
  constexpr std::uint32_t viewpoints = 20, points = 60;
  const TensorOptions tensor;
  const auto input = std::make_shared<ScanInput>();
  input->view =
      backend.make_view(random_segments(rng, s.coarse_width, s.coarse_height, s.edge_points / 10),
                        s.coarse_width, s.coarse_height, {}, {}, tensor);
  const int steps = s.templates / int(viewpoints);
  const Poses poses = random_poses(rng, s.templates, viewpoints * points);
  input->points = backend.make_model_points(poses.points);
  for (std::uint32_t v = 0; v < viewpoints; ++v) input->viewpoints.push_back({v * points, points});
  const float x = 0.5f * float(s.coarse_width), y = 0.5f * float(s.coarse_height);
  for (int region = 0; region < 2; ++region) {
    input->regions.push_back({x, y, 0, 0, 1});
    input->anchors.push_back({region * s.coarse_width / 2, 0, 16, 12});
    for (const PoseProblem& problem : poses.problems) {
      input->turned.push_back(problem.camera_from_object);
      input->turned.back().m[11] -= input->distances_m[0];
    }
  }
  for (int t = 0; t < s.templates; ++t) input->numbers.push_back(static_cast<std::uint32_t>(t));
  const float focal = 1.2f * float(s.coarse_width);
  const TemplateScan scan{{{focal, focal, x, y}, tensor.bins, 0.01f},
                          2,
                          static_cast<std::uint32_t>(steps),
                          input->viewpoints,
                          input->distances_m,
                          input->regions,
                          input->anchors,
                          input->turned,
                          input->numbers,
                          true};
  input->hits.resize(scan.hits());
  return {"template_scan",
          std::to_string(s.templates) + " templates of " + std::to_string(points) +
              " points in 2 regions of 192 anchors",
          tensor_bytes(s.coarse_width, s.coarse_height, tensor.bins) +
              input->turned.size() * sizeof(Pose) + input->hits.size() * sizeof(TemplateHit),
          [&backend, input, scan] {
            backend.template_scan(*input->view, *input->points, scan, input->hits);
          }};
}

Case template_case(Backend& backend, const Scale& s, std::uint32_t columns, std::uint32_t rows) {
  std::mt19937 rng(2);
  const TensorOptions options;
  const ViewHandle view =
      backend.make_view(random_segments(rng, s.coarse_width, s.coarse_height, s.edge_points / 10),
                        s.coarse_width, s.coarse_height, {}, {}, options);
  const Templates work = random_templates(rng, s.coarse_width, s.coarse_height, options.bins,
                                          s.templates, columns, rows);
  const auto hits = std::make_shared<std::vector<TemplateHit>>(work.jobs.size());
  constexpr int step = 2;
  return {
      "template_score",
      std::to_string(s.templates) + " templates at " + std::to_string(columns * rows) + " anchors",
      tensor_bytes(s.coarse_width, s.coarse_height, options.bins) +
          work.points.size() * sizeof(TemplatePoint) + work.jobs.size() * sizeof(TemplateHit),
      [&backend, view, work, hits] {
        backend.template_score(*view, work.points, work.jobs, step, *hits);
      }};
}

struct PoseInput {
  std::vector<ViewHandle> views;
  Poses poses;
  std::string size;
  std::size_t bytes;
};

PoseInput pose_input(Backend& backend, const Scale& s) {
  std::mt19937 rng(3);
  const std::vector<std::uint8_t> pixels = disc_image(rng, s.width, s.height);
  const ImageView image{s.width, s.height, pixels.data()};
  constexpr std::size_t reads = sizeof(ModelPoint) + 8 * sizeof(std::uint16_t);
  return {{backend.make_view(random_segments(rng, s.width, s.height, s.edge_points), s.width,
                             s.height, image, camera_of(s), {})},
          random_poses(rng, s.problems, s.pose_points),
          std::to_string(s.problems) + " poses of " + std::to_string(s.pose_points) + " points",
          reads * s.problems * s.pose_points};
}

std::vector<Case> pose_cases(Backend& backend, const Scale& s) {
  const auto input = std::make_shared<PoseInput>(pose_input(backend, s));
  const auto systems = std::make_shared<std::vector<NormalEquations>>(input->poses.problems.size());
  const auto scores = std::make_shared<std::vector<PoseScore>>(input->poses.problems.size());
  return {{"pose_normal_equations", input->size, input->bytes,
           [&backend, input, systems] {
             backend.pose_normal_equations(input->views, input->poses.points, input->poses.problems,
                                           {}, *systems);
           }},
          {"pose_score", input->size, input->bytes, [&backend, input, scores] {
             backend.pose_score(input->views, input->poses.points, input->poses.problems, {},
                                *scores);
           }}};
}

// Depths about those of the points, which face any direction.
Case pose_depth_case(Backend& backend, const Scale& s) {
  std::mt19937 rng(10);
  std::uniform_real_distribution<float> depth(0.34f, 0.46f);
  std::vector<float> depth_m(std::size_t(s.width) * std::size_t(s.height));
  for (float& z : depth_m) z = depth(rng);
  const Poses poses = random_poses(rng, s.problems, s.pose_points);
  Unfilled<SurfacePoint> points;
  for (const ModelPoint& p : poses.points)
    points.push_back({p.x_m, p.y_m, p.z_m, p.tx, p.ty, p.tz});
  const std::vector<DepthHandle> views{
      backend.make_depth({depth_m, s.width, s.height, camera_of(s)})};
  const SurfacePointsHandle kept = backend.make_surface_points(points);
  const auto found = std::make_shared<std::vector<PoseDepth>>(poses.problems.size());
  constexpr std::size_t reads = sizeof(SurfacePoint) + sizeof(float);
  return {"pose_depth",
          std::to_string(s.problems) + " poses of " + std::to_string(s.pose_points) + " points",
          reads * s.problems * s.pose_points, [&backend, views, kept, poses, found] {
            backend.pose_depth(views, *kept, poses.problems, {}, *found);
          }};
}

// Points all over the image, as many a pose as pose_cases has.
Case support_case(Backend& backend, const Scale& s) {
  std::mt19937 rng(9);
  const std::vector<std::uint8_t> pixels = disc_image(rng, s.width, s.height);
  const std::vector<ViewHandle> views{backend.make_view(
      {}, s.width, s.height, {s.width, s.height, pixels.data()}, camera_of(s), {})};
  std::vector<SupportPoint> points;
  std::vector<SupportProblem> problems;
  for (int i = 0; i < s.problems; ++i) {
    problems.push_back({std::uint32_t(points.size()), std::uint32_t(s.pose_points), 0});
    for (int n = 0; n < s.pose_points; ++n)
      points.push_back({std::uint16_t(rng() % std::uint32_t(s.width)),
                        std::uint16_t(rng() % std::uint32_t(s.height)), SUPPORT_WEIGHT_ONE / 4,
                        std::uint8_t(rng() % SUPPORT_BINS), std::uint8_t(rng() % SUPPORT_PARTS)});
  }
  constexpr std::size_t reads = sizeof(SupportPoint) + (1 + SUPPORT_COPIES) * sizeof(std::uint32_t);
  const auto supports = std::make_shared<std::vector<EdgeSupport>>(problems.size());
  return {"edge_support",
          std::to_string(s.problems) + " poses of " + std::to_string(s.pose_points) + " points",
          reads * points.size(), [&backend, views, points, problems, supports] {
            backend.edge_support(views, points, problems, *supports);
          }};
}

Case depth_case(Backend& backend, const Scale& s) {
  const Mesh mesh = bumpy_ball(s.rings, 2 * s.rings);
  const std::vector<DepthJob> jobs = views_around(s.maps, s.map_width, s.map_height);
  const auto depth =
      std::make_shared<std::vector<float>>(std::size_t(s.maps) * s.map_width * s.map_height);
  return {"depth_raster",
          std::to_string(s.maps) + " maps of " + by(s.map_width, s.map_height) + ", " +
              std::to_string(mesh.triangles.size() / 3) + " triangles",
          depth->size() * sizeof(float), [&backend, mesh, jobs, depth, s] {
            backend.depth_raster(mesh.view(), jobs, s.map_width, s.map_height, *depth);
          }};
}

Case visibility_case(Backend& backend, const Scale& s) {
  const Mesh mesh = bumpy_ball(s.rings, 2 * s.rings);
  const std::uint32_t points = static_cast<std::uint32_t>(mesh.vertices_m.size() / 3);
  std::vector<VisibilityJob> jobs;
  for (const DepthJob& job : views_around(s.maps, s.map_height, s.map_height))
    jobs.push_back({job.camera_from_object, job.intrinsics, 1e-3f, 0, 0});
  const auto flags = std::make_shared<std::vector<std::uint8_t>>(jobs.size() * points);
  return {"point_visibility",
          std::to_string(points) + " points in " + std::to_string(s.maps) + " maps of " +
              by(s.map_height, s.map_height),
          jobs.size() * std::size_t(s.map_height) * std::size_t(s.map_height) * sizeof(float) +
              flags->size(),
          [&backend, mesh, jobs, flags, points, s] {
            backend.point_visibility(mesh.view(), {mesh.vertices_m, points}, jobs, s.map_height,
                                     *flags);
          }};
}

Case shading_case(Backend& backend, const Scale& s) {
  std::mt19937 rng(10);
  const Mesh mesh = bumpy_ball(s.rings, 2 * s.rings);
  const std::vector<std::uint8_t> pixels = disc_image(rng, s.width, s.height);
  const std::vector<ShadedView> views{
      {backend.make_view({}, s.width, s.height, {s.width, s.height, pixels.data()}, camera_of(s),
                         {}),
       nullptr}};
  const auto stride = std::uint32_t(s.width) / SHADING_MAP_PX;
  std::vector<ShadingJob> jobs;
  for (const DepthJob& job : views_around(s.maps, s.width, s.height))
    jobs.push_back({job.camera_from_object, 0, 0, stride, 0});
  const auto sums = std::make_shared<std::vector<ShadingSums>>(jobs.size());
  constexpr std::size_t map = std::size_t(SHADING_MAP_PX) * SHADING_MAP_PX;
  return {
      "shading_sums",
      std::to_string(s.maps) + " maps, " + std::to_string(mesh.triangles.size() / 3) + " triangles",
      s.maps * (map * (sizeof(float) + 1) + sizeof(ShadingSums)),
      [&backend, mesh, views, jobs, sums] {
        backend.shading_sums(views, mesh.view(), jobs, 0, *sums);
      }};
}

Case edge_case(Backend& backend, const Scale& s) {
  std::mt19937 rng(5);
  const std::vector<std::uint8_t> pixels = disc_image(rng, s.width, s.height);
  return {"edge_detect", by(s.width, s.height), pixels.size(), [&backend, pixels, s] {
            backend.detect_edges({s.width, s.height, pixels.data()}, {});
          }};
}

// All views of a choice of the next view; `cells` of every one of them for the information.
struct NextView {
  std::vector<test::ChamferInput> inputs;
  std::vector<ParticleBelief> beliefs;
  std::vector<ChamferHandle> cells;
  std::size_t pixels = 0, edges = 0, points = 0, cell_count = 0;
};

std::shared_ptr<NextView> next_view(Backend& backend, const NextViewSize& size) {
  const NextViewInput boxes(size);
  auto made = std::make_shared<NextView>();
  made->beliefs = boxes.beliefs();
  for (int v = 0; v < size.views; ++v) {
    test::ChamferInput& input = made->inputs.emplace_back(boxes.view(v));
    backend.candidate_map(input.edges, input.maps, input.width, input.height, input.nearest);
    made->cells.push_back(backend.combination_chamfer(input.view(), input.combinations(), {}));
    made->pixels += input.nearest.size();
    made->edges += input.edges.size();
    made->points += input.points.size();
    made->cell_count +=
        std::size_t(made->cells.back()->particles) * made->cells.back()->combinations;
  }
  return made;
}

// Operations: of the maps, an edge point tried on the pixels in its reach; of the chamfer
// distances, a point's lookup for one combination; of the information, a likelihood.
std::string counted(const NextViewSize& size, double operations) {
  char text[96];
  std::snprintf(text, sizeof text, "%d views, %d, %d, %u: %.2g operations", size.views,
                size.candidates, size.particles, size.combinations, operations);
  return text;
}

std::vector<Case> next_view_cases(Backend& backend, const NextViewSize& size) {
  const std::shared_ptr<NextView> work = next_view(backend, size);
  constexpr double reach_px = std::numbers::pi * CANDIDATE_MAP_REACH_PX * CANDIDATE_MAP_REACH_PX;
  const std::size_t map_bytes =
      work->edges * sizeof(MapEdge) + work->pixels * sizeof(std::uint32_t);
  const std::size_t cell_bytes = work->cell_count * sizeof(ChamferCell);
  return {
      {"candidate_map", counted(size, reach_px * double(work->edges)), map_bytes,
       [&backend, work] {
         for (test::ChamferInput& s : work->inputs)
           backend.candidate_map(s.edges, s.maps, s.width, s.height, s.nearest);
       }},
      {"combination_chamfer", counted(size, double(work->points) * size.combinations),
       map_bytes + work->pixels * sizeof(float) + work->points * sizeof(ParticlePoint) + cell_bytes,
       [&backend, work] {
         for (const test::ChamferInput& s : work->inputs)
           backend.combination_chamfer(s.view(), s.combinations(), {});
       }},
      {"mutual_information", counted(size, double(work->cell_count)), cell_bytes, [&backend, work] {
         for (const ChamferHandle& cells : work->cells)
           backend.mutual_information(*cells, work->beliefs, {});
       }}};
}

}  // namespace

std::vector<Case> make_cases(Backend& backend, Size size) {
  const Scale s = scale_of(size);
  std::vector<Case> cases{edge_case(backend, s),
                          tensor_case(backend, s),
                          projection_case(backend, s),
                          template_case(backend, s, 1, 1),
                          template_case(backend, s, 16, 12),
                          scan_case(backend, s)};
  for (Case& c : pose_cases(backend, s)) cases.push_back(std::move(c));
  cases.push_back(pose_depth_case(backend, s));
  cases.push_back(support_case(backend, s));
  cases.push_back(depth_case(backend, s));
  cases.push_back(visibility_case(backend, s));
  cases.push_back(shading_case(backend, s));
  for (Case& c : next_view_cases(backend, s.next_view)) cases.push_back(std::move(c));
  return cases;
}

}  // namespace edgescout::bench
