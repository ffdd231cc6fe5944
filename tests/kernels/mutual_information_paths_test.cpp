// mutual_information on every path, on cells that combination_chamfer made there, against the
// reference (mutual_information.h).
#include "kernels/cases/chamfer_cases.h"
#include "kernels/error.h"
#include "tests/kernels/paths.h"

namespace edgescout {
namespace {

std::vector<ParticleBelief> random_beliefs(std::mt19937& rng, std::size_t count) {
  std::uniform_real_distribution<double> log_weight(-4, 2), upsilon(0, 200);
  std::vector<ParticleBelief> beliefs;
  for (std::size_t i = 0; i < count; ++i)
    beliefs.push_back({i % 7 == 6 ? -INFINITY : log_weight(rng),
                       std::uint32_t(i % 4 == 0 ? 0 : rng() % 50), 100, upsilon(rng)});
  return beliefs;
}

constexpr float test_cap_px = 255.0f / 16;

class MutualInformationPaths : public test::PathTest {
 protected:
  void expect_equal(const test::ChamferInput& input, const std::vector<ParticleBelief>& beliefs,
                    const std::vector<InformationOptions>& all_options) {
    constexpr ChamferOptions chamfer{test_cap_px};
    const ChamferHandle own =
        tested->combination_chamfer(input.view(), input.combinations(), chamfer);
    const auto cells = own->cells();  // those of the reference, says combination_chamfer's own test
    const auto tolerance = [&](double expected, double scale_px2) {
      return tested->is_gpu() ? 1e-4 * (1 + expected) + 1e-6 * test_cap_px * test_cap_px / scale_px2
                              : 1e-9 * (1 + expected);
    };
    for (const InformationOptions& options : all_options) {
      const double expected = mutual_information_reference(
          {own->particles, own->combinations, chamfer.cap_px, cells}, beliefs, options);
      const double found = tested->mutual_information(*own, beliefs, options);
      EXPECT_NEAR(found, expected, tolerance(expected, options.scale_px2))
          << "scale " << options.scale_px2
          << (options.use_paper_formula ? ", use_paper_formula" : "");
      EXPECT_GE(found, 0);
      worst = std::max(worst, std::abs(found - expected) / (1 + expected));
      largest = std::max(largest, expected);
    }
  }
  double worst = 0, largest = 0;
};

TEST_P(MutualInformationPaths, AgreesWithTheReference) {
  std::mt19937 rng = test::test_rng();
  for (const test::ChamferInputSize& size :
       std::vector<test::ChamferInputSize>{{30, 20, 3, 9, 1, 12, 1},
                                           {40, 30, 9, 30, 6, 20, 5},
                                           {60, 60, 20, 40, 33, 30, 257},
                                           {60, 60, 40, 40, 200, 30, 1000}}) {
    const test::ChamferInput input = test::random_chamfer_input(rng, size);
    const std::vector<ParticleBelief> beliefs = random_beliefs(rng, input.view().particles());
    const double least = test_cap_px * test_cap_px / INFORMATION_MAX_SHARPNESS;
    expect_equal(input, beliefs,
                 {{least, false},
                  {least, true},
                  {0.5, false},
                  {8, false},
                  {300, false},
                  {0.5, true},
                  {8, true},
                  {300, true}});
  }
  std::printf("differ by %.1e at most; up to %.3f nats\n", worst, largest);
  EXPECT_GT(largest, 0.3);
}

// The most particles there may be.
TEST_P(MutualInformationPaths, ManyParticles) {
  std::mt19937 rng = test::test_rng();
  const test::ChamferInput input =
      test::random_chamfer_input(rng, {60, 60, 20, 40, int(INFORMATION_MAX_PARTICLES), 2, 9});
  expect_equal(input, random_beliefs(rng, INFORMATION_MAX_PARTICLES), {{}});
}

TEST_P(MutualInformationPaths, IsZeroWhereAllParticlesAreTheSame) {
  std::mt19937 rng = test::test_rng();
  test::ChamferInput input = test::random_chamfer_input(rng, {40, 30, 9, 30, 1, 20, 50});
  const std::vector<ParticlePoint> points = input.points;
  for (int i = 0; i < 20; ++i) input.add_particle(points);
  const ChamferHandle chamfer = tested->combination_chamfer(input.view(), input.combinations(), {});
  std::vector<ParticleBelief> beliefs(21, {0, 10, 100, 0});
  EXPECT_NEAR(tested->mutual_information(*chamfer, beliefs, {}), 0,
              tested->is_gpu() ? 1e-6 : 1e-12);
}

// In one call as one by one, also where several tiles and several groups of them are needed.
TEST_P(MutualInformationPaths, OfSeveralViewsIsThatOfEach) {
  std::mt19937 rng = test::test_rng();
  std::vector<test::ChamferInput> inputs;
  for (int view = 0; view < 7; ++view)
    inputs.push_back(test::random_chamfer_input(rng, {60, 60, 20, 40, 33, 30, 257}));
  std::vector<ChamferView> views;
  for (const test::ChamferInput& input : inputs) views.push_back(input.view());
  const CombinationBits combinations = inputs[0].combinations();
  const std::vector<ParticleBelief> beliefs = random_beliefs(rng, views[0].particles());
  for (const bool use_paper_formula : {false, true}) {
    const InformationOptions options{8, use_paper_formula};
    const std::vector<double> found =
        tested->view_information(views, combinations, {test_cap_px}, beliefs, options);
    ASSERT_EQ(found.size(), views.size());
    for (std::size_t v = 0; v < views.size(); ++v) {
      const double alone = tested->mutual_information(
          *tested->combination_chamfer(views[v], combinations, {test_cap_px}), beliefs, options);
      EXPECT_NEAR(found[v], alone, 1e-12 * (1 + alone)) << "view " << v;
    }
    EXPECT_GT(std::ranges::max(found), std::ranges::min(found));
  }
  EXPECT_TRUE(tested->view_information({}, combinations, {test_cap_px}, beliefs, {}).empty());
}

TEST_P(MutualInformationPaths, CellsOfAnotherBackendAreOurBug) {
  std::mt19937 rng = test::test_rng();
  const test::ChamferInput input = test::random_chamfer_input(rng, {40, 30, 9, 30, 2, 20, 5});
  const std::vector<ParticleBelief> beliefs(2);
  const auto other =
      GetParam() == test::Path::cpu ? test::make_path(test::Path::vulkan) : make_cpu_backend(1);
  if (other) {
    EXPECT_THROW(
        tested->mutual_information(
            *other->combination_chamfer(input.view(), input.combinations(), {}), beliefs, {}),
        LogicError);
  }
  const ChamferHandle own = tested->combination_chamfer(input.view(), input.combinations(), {});
  EXPECT_NO_THROW(tested->mutual_information(*own, beliefs, {}));
  EXPECT_THROW(tested->mutual_information(*own, std::vector<ParticleBelief>(3), {}), LogicError);
}

INSTANTIATE_TEST_SUITE_P(Paths, MutualInformationPaths, test::all_paths, test::param_name);

}  // namespace
}  // namespace edgescout
