#include "host/active/scout_state.h"

#include <concepts>

#include "host/io/binary_file.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

constexpr BinaryFormat format{{'E', 'S', 'C', 'O', 'U', 'T', 'S', 'T'}, 18, "scout state"};

template <typename T>
concept Number = std::is_arithmetic_v<T> || std::is_enum_v<T>;

// Writes and reads: `fields` below lists a struct's members for both.
class Put {
 public:
  explicit Put(BinaryWriter& out) : out_(out) {}
  void operator()(const auto&... values) { (put(values), ...); }

 private:
  void put(const Number auto& value) { out_.put(value); }
  void put(const std::string& text) { out_.put_text(text); }
  void put(const Se3& pose) { out_.put_pose(pose); }
  void put(const Matrix6d& matrix) {
    for (int i = 0; i < matrix.size(); ++i) out_.put(matrix.data()[i]);
  }
  void put(const LensCoefficients& numbers) {
    for (const double number : numbers) out_.put(number);
  }
  template <typename T>
  void put(const std::shared_ptr<const T>& maybe) {
    put(maybe != nullptr);
    if (maybe) put(*maybe);
  }
  template <typename T>
  void put(const std::vector<T>& list) {
    out_.put(static_cast<std::uint64_t>(list.size()));
    for (const T& element : list) put(element);
  }
  template <typename T>
  requires(!Number<T>) void put(const T& value) { fields(*this, value); }

  BinaryWriter& out_;
};

class Get {
 public:
  explicit Get(BinaryReader& in) : in_(in) {}
  void operator()(auto&... values) { (get(values), ...); }

 private:
  void get(Number auto& value) { value = in_.get<std::remove_reference_t<decltype(value)>>(); }
  void get(bool& value) { value = in_.get<std::uint8_t>() != 0; }
  void get(std::string& text) { text = in_.get_text(); }
  void get(Se3& pose) { pose = in_.get_pose(); }
  void get(Matrix6d& matrix) {
    for (int i = 0; i < matrix.size(); ++i) matrix.data()[i] = in_.get<double>();
  }
  void get(LensCoefficients& numbers) {
    for (double& number : numbers) number = in_.get<double>();
  }
  template <typename T>
  void get(std::shared_ptr<const T>& maybe) {
    bool is_there = false;
    get(is_there);
    if (!is_there) return;
    T value;
    get(value);
    maybe = std::make_shared<const T>(std::move(value));
  }
  template <typename T>
  void get(std::vector<T>& list) {
    // Every element takes at least one byte of the file, but many take a thousand in memory.
    for (std::size_t i = in_.count(1); i > 0; --i) get(list.emplace_back());
  }
  template <typename T>
  requires(!Number<T>) void get(T& value) { fields(*this, value); }

  BinaryReader& in_;
};

// The members of every struct, once for both; T may be const. A change here needs a new version
// above.
template <typename T, typename Struct>
concept A = std::same_as<std::remove_const_t<T>, Struct>;

void fields(auto& io, A<StageSeconds> auto& x) { io(x.name, x.seconds); }
void fields(auto& io, A<ViewInformation> auto& x) {
  io(x.open, x.information, x.share, x.discovery, x.motion_cost);
}
void fields(auto& io, A<ExtrinsicsCheck> auto& x) {
  io(x.residual_px, x.objects, x.missing, x.disagrees);
}
void fields(auto& io, A<PoseFeatures> auto& x) {
  io(x.psi, x.mean_px, x.matched, x.points, x.length_px, x.in_image, x.visible, x.shading.pixels,
     x.shading.squares, x.shading.unexplained, x.support.log_ratio, x.support.interior_log_ratio,
     x.support.support, x.support.best_displaced, x.depth);
}
void fields(auto& io, A<DepthEvidence> auto& x) {
  io(x.agreeing, x.contradicting, x.hidden, x.missing, x.offset_m);
}
void fields(auto& io, A<ParticleUpdate> auto& x) { io(x.effective, x.reseeded, x.gained_nats); }
void fields(auto& io, A<FailedView> auto& x) { io(x.view, x.reason, x.after_step, x.stages); }
void fields(auto& io, A<ScoutObject> auto& x) { io(x.id, x.fingerprint); }
void fields(auto& io, A<Camera> auto& x) {
  io(x.width, x.height, x.fx, x.fy, x.cx, x.cy, x.distortion, x.lens, x.skew, x.field_of_view_rad);
}
void fields(auto& io, A<Image> auto& x) { io(x.width, x.height, x.pixels); }
void fields(auto& io, A<DepthImage> auto& x) { io(x.width, x.height, x.z_m); }
void fields(auto& io, A<DepthNoise> auto& x) { io(x.floor_m, x.at_one_metre_m); }
void fields(auto& io, A<MeasuredDepth> auto& x) { io(x.image, x.noise); }
void fields(auto& io, A<ModeDetection> auto& x) { io(x.detection, x.weight, x.supporting_images); }
void fields(auto& io, A<Detection> auto& x) {
  io(x.object, x.world_from_object, x.covariance, x.probability, x.psi, x.cost_px,
     x.matched_fraction, x.psi_z_score, x.unexplained_grey, x.convergence);
}
void fields(auto& io, A<Particle> auto& x) {
  io(x.object, x.world_from_object, x.covariance, x.log_weight, x.upsilon_px2, x.resampled_px2,
     x.features);
}
void fields(auto& io, A<ScoutDecision> auto& x) {
  io(x.view, x.strategy, x.use_paper_formula, x.views, x.candidates, x.likeliest, x.unlikeliest,
     x.stages);
}
void fields(auto& io, A<ScoutStep> auto& x) {
  io(x.decision, x.camera_from_world, x.image, x.depth, x.searches, x.new_candidates, x.before,
     x.after, x.update, x.resampled, x.detections, x.extrinsics_checks, x.mode_probabilities,
     x.entropy_nats, x.stages);
}
void fields(auto& io, A<ScoutState> auto& x) {
  io(x.objects, x.camera, x.views, x.steps, x.failed, x.candidates, x.particles, x.unseen_px2,
     x.detections, x.entropy_nats, x.end, x.last_decision, x.overruled_seconds);
}

double sum(const std::vector<StageSeconds>& stages) {
  double seconds = 0;
  for (const StageSeconds& stage : stages) seconds += stage.seconds;
  return seconds;
}

}  // namespace

std::string to_string(ScoutEnd end) {
  switch (end) {
    case ScoutEnd::No:
      return "";
    case ScoutEnd::ViewBudget:
      return "view budget";
    case ScoutEnd::NoViewLeft:
      return "no view left";
    case ScoutEnd::Certain:
      return "certain";
    case ScoutEnd::LittleToLearn:
      return "little to learn";
    case ScoutEnd::LittleLearned:
      return "little learned";
    case ScoutEnd::TimeLimit:
      return "time limit";
  }
  throw LogicError("to_string: no such ScoutEnd");
}

std::vector<char> ScoutState::closed() const {
  std::vector<char> closed(views.size(), 0);
  for (const ScoutStep& step : steps) closed.at(static_cast<std::size_t>(step.decision.view)) = 1;
  for (const FailedView& view : failed) closed.at(static_cast<std::size_t>(view.view)) = 1;
  return closed;
}

double ScoutState::seconds() const {
  double seconds = 0;
  for (const ScoutStep& step : steps) seconds += sum(step.stages) + sum(step.decision.stages);
  for (const FailedView& view : failed) seconds += sum(view.stages);
  return seconds + sum(last_decision.stages) + overruled_seconds;
}

void ScoutState::overrule() {
  overruled_seconds += sum(last_decision.stages);
  last_decision = {};
}

void save_scout_state(const ScoutState& state, const std::filesystem::path& file) {
  BinaryWriter out;
  Put{out}(state);
  write_binary_file(file, format, out.bytes);
}

ScoutState load_scout_state(const std::filesystem::path& file) {
  BinaryReader in(file, format);
  ScoutState state;
  Get{in}(state);
  if (!in.at_end())
    throw InputError(file.string(), "payload", "more than a state", "a whole scout state");
  return state;
}

}  // namespace edgescout
