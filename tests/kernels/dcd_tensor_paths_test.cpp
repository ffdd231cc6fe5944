// dcd_seed, distance_pass and dcd_sweep together: the whole tensor, bit for bit (dcd_tensor.h).
#include <cmath>

#include "kernels/dcd_tensor.h"
#include "kernels/error.h"
#include "tests/kernels/paths.h"

namespace edgescout {
namespace {

using test::random_edges;

struct Case {
  int width, height, edges;
  TensorOptions options;
};

TensorOptions options_of(int bins, float lambda, float variance, float cap) {
  TensorOptions options;
  options.bins = bins;
  options.lambda_px_per_rad = lambda;
  options.smoothing_variance = variance;
  options.cap_px = cap;
  return options;
}

const std::vector<Case> cases{
    {1, 1, 2, {}},
    {1, 1, 0, {}},
    {7, 5, 6, {}},
    {33, 17, 60, {}},
    {70, 100, 300, {}},
    {64, 32, 0, {}},
    {70, 100, 200, options_of(60, 100, 1, 255)},
    {70, 100, 200, options_of(60, 100, 0, 7.3f)},
    {33, 40, 50, options_of(4, 6, 1, 60)},
    {33, 40, 50, options_of(6, 0, 4, 60)},
    {40, 20, 90, options_of(60, 10000, 16, 0.3f)},
    {45, 20, 90, options_of(128, 3, 2, 30)},
    {31, 64, 5000, options_of(10, 100, 1, 60)},
};

class DcdTensorPaths : public test::PathTest {};

TEST_P(DcdTensorPaths, EqualsTheReferenceBitForBit) {
  std::mt19937 rng = test::test_rng();
  for (const Case& c : cases) {
    SCOPED_TRACE(std::to_string(c.width) + "x" + std::to_string(c.height) + "x" +
                 std::to_string(c.options.bins) + " cap " + std::to_string(c.options.cap_px));
    const std::vector<EdgePoint> edges = random_edges(rng, c.width, c.height, c.edges);
    const auto expected = dcd_tensor_reference(edges, c.width, c.height, c.options);
    const ViewHandle view = tested->make_view(edges, c.width, c.height, {}, {}, c.options);
    EXPECT_EQ(view->tensor(), expected);
  }
}

// Half-way positions round away from zero, angles beyond [0, pi) wrap, what is not finite or
// outside is dropped.
TEST_P(DcdTensorPaths, SeedsRoundAsTheReferenceDoes) {
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              inf = std::numeric_limits<float>::infinity();
  const float half_bin = 0.5f / (60 / std::numbers::pi_v<float>);
  const std::vector<EdgePoint> edges{{0.49999997f, 0.5f, 0, 1},
                                     {-0.49999997f, 1.5f, 0, 1},
                                     {-0.5f, 3, 0, 1},
                                     {8.5f, 2.5f, 3.2f, 1},
                                     {nan, 1, 0, 1},
                                     {1, nan, 0, 1},
                                     {1, 1, nan, 1},
                                     {inf, 1, 0, 1},
                                     {1, -inf, 0, 1},
                                     {2, 2, inf, 1},
                                     {30.49f, 16.5f, 3.11f, 1},
                                     {32.5f, 3, 1, 1},
                                     {5, 9, half_bin, 1},
                                     {6, 9, 3 * half_bin, 1},
                                     {7, 9, -half_bin, 1},
                                     {9, 9, -1.2f, 1},
                                     {3, 3, std::numbers::pi_v<float>, 1}};
  const auto expected = dcd_tensor_reference(edges, 33, 17, {});
  EXPECT_EQ(tested->make_view(edges, 33, 17, {}, {}, {})->tensor(), expected);
}

// One backend, images of changing size: nothing of the last one may show through.
TEST_P(DcdTensorPaths, ScratchIsReused) {
  std::mt19937 rng = test::test_rng();
  const std::vector<EdgePoint> many = random_edges(rng, 70, 100, 800),
                               few = random_edges(rng, 20, 10, 3);
  const ViewHandle first = tested->make_view(many, 70, 100, {}, {}, {});
  const ViewHandle second = tested->make_view(few, 20, 10, {}, {}, {});
  EXPECT_EQ(second->tensor(), dcd_tensor_reference(few, 20, 10, {}));
  EXPECT_EQ(first->tensor(), dcd_tensor_reference(many, 70, 100, {}));
}

TEST_P(DcdTensorPaths, BadOptionsNameTheField) {
  const auto expect_bad = [&](const TensorOptions& options, const char* field) {
    try {
      tested->make_view({}, 8, 8, {}, {}, options);
      ADD_FAILURE() << field << " was accepted";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(field), std::string::npos) << error.what();
    }
  };
  TensorOptions options;
  options.cap_px = 256;
  expect_bad(options, "cap");
  options = {};
  options.bins = -4;
  expect_bad(options, "tensor.bins");
}

INSTANTIATE_TEST_SUITE_P(Paths, DcdTensorPaths, test::all_paths, test::param_name);

}  // namespace
}  // namespace edgescout
