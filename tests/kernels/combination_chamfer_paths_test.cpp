// combination_chamfer on every path: integer cells, equal bit for bit (combination_chamfer.h).
#include "kernels/cases/chamfer_cases.h"
#include "kernels/error.h"
#include "tests/kernels/paths.h"

namespace edgescout {

static bool operator==(const ChamferCell& a, const ChamferCell& b) {
  return a.sum == b.sum && a.seen == b.seen && a.unseen == b.unseen;
}
static std::ostream& operator<<(std::ostream& out, const ChamferCell& cell) {
  return out << "sum " << cell.sum << " seen " << cell.seen << " unseen " << cell.unseen;
}

namespace {

class CombinationChamferPaths : public test::PathTest {
 protected:
  void expect_equal(const test::ChamferInput& input, const ChamferOptions& options) {
    const ChamferHandle found =
        tested->combination_chamfer(input.view(), input.combinations(), options);
    const ChamferHandle expected =
        reference->combination_chamfer(input.view(), input.combinations(), options);
    EXPECT_EQ(found->particles, input.view().particles());
    EXPECT_EQ(found->combinations, input.combination_count);
    EXPECT_EQ(found->cells(), expected->cells());
  }
};

TEST_P(CombinationChamferPaths, EqualsTheReference) {
  std::mt19937 rng = test::test_rng();
  for (const test::ChamferInputSize& size :
       std::vector<test::ChamferInputSize>{{1, 1, 1, 2, 1, 2, 1},
                                           {7, 5, 3, 9, 6, 20, 3},
                                           {60, 40, 12, 60, 9, 40, 65},
                                           {50, 70, 33, 30, 7, 50, 200},
                                           {40, 40, 70, 25, 4, 30, 64},
                                           {30, 30, 0, 0, 3, 10, 5},
                                           {30, 30, 5, 10, 0, 0, 5},
                                           {30, 30, 5, 10, 3, 10, 0}}) {
    SCOPED_TRACE(std::to_string(size.candidates) + " candidates, " +
                 std::to_string(size.combinations) + " combinations");
    const test::ChamferInput input = test::random_chamfer_input(rng, size);
    expect_equal(input, {255.0f / 16});
    expect_equal(input, {5});
  }
}

// More points than the sums of bytes hold without being emptied, all of them far off, hidden or
// not.
TEST_P(CombinationChamferPaths, ManyPointsInAParticle) {
  std::mt19937 rng = test::test_rng();
  test::ChamferInput input = test::random_chamfer_input(rng, {40, 30, 9, 12, 3, 2000, 70});
  expect_equal(input, {255.0f / 16});
  input.add_particle(std::vector<ParticlePoint>(CHAMFER_MAX_POINTS, {11, 9, 0.9f, 1}));
  expect_equal(input, {255.0f / 16});
}

// More rows than the smallest device binds at once for all combinations.
TEST_P(CombinationChamferPaths, RealizationsInTiles) {
  std::mt19937 rng = test::test_rng();
  const test::ChamferInput input = test::random_chamfer_input(rng, {60, 40, 12, 60, 30, 60, 1500});
  expect_equal(input, {255.0f / 16});
}

// Lists that other views share: nothing of them begins at 0.
TEST_P(CombinationChamferPaths, PartsOfLongerLists) {
  std::mt19937 rng = test::test_rng();
  const test::ChamferInput input = test::random_chamfer_input(rng, {60, 40, 12, 60, 9, 40, 65});
  ChamferView part = input.view();
  part.candidates = part.candidates.subspan(4, 6);
  part.tolerance_m = part.tolerance_m.subspan(4, 6);
  part.first_point = part.first_point.subspan(2, 5);
  const std::vector<std::uint32_t> words(33, 0x35u);
  const CombinationBits combinations{33, 6, words};
  EXPECT_EQ(tested->combination_chamfer(part, combinations, {})->cells(),
            reference->combination_chamfer(part, combinations, {})->cells());
}

// More particles and combinations than a device takes workgroups along one dimension.
TEST_P(CombinationChamferPaths, ManyParticlesAndManyRealizations) {
  std::mt19937 rng = test::test_rng();
  test::ChamferInput input = test::random_chamfer_input(rng, {20, 20, 3, 9, 66000, 1, 2});
  expect_equal(input, {8});
  input = test::random_chamfer_input(rng, {20, 20, 6, 9, 2, 9, 70001});
  expect_equal(input, {8});
}

TEST_P(CombinationChamferPaths, BrokenInputIsOurBug) {
  std::mt19937 rng = test::test_rng();
  const test::ChamferInput good = test::random_chamfer_input(rng, {20, 20, 3, 9, 3, 5, 4});
  const auto run = [&](const auto& spoil, const ChamferOptions& options = {}) {
    test::ChamferInput input = good;
    spoil(input);
    tested->combination_chamfer(input.view(), input.combinations(), options);
  };
  EXPECT_NO_THROW(run([](auto&) {}));
  EXPECT_THROW(run([](auto& s) { s.words.pop_back(); }), LogicError);
  EXPECT_THROW(run([](auto& s) { s.surface_m.pop_back(); }), LogicError);
  EXPECT_THROW(run([](auto& s) {
                 for (std::uint32_t& word : s.nearest)
                   word |= word == CANDIDATE_MAP_EMPTY ? 0 : 0xffffu;
               }),
               LogicError)
      << "maps of other edge points";
  EXPECT_THROW(run([](auto& s) { s.points.pop_back(); }), LogicError);
  EXPECT_THROW(run([](auto& s) { s.points.back().unseen = 2; }), LogicError);
  EXPECT_THROW(run([](auto& s) { s.first_point = {5, 3}; }), LogicError);
  EXPECT_THROW(run([](auto& s) { s.first_point.clear(); }), LogicError);
  EXPECT_THROW(run([](auto& s) { s.tolerance_m.pop_back(); }), LogicError);
  EXPECT_THROW(run([](auto& s) { s.tolerance_m[1] = -1; }), LogicError);
  EXPECT_THROW(run([](auto& s) { s.tolerance_m[1] = NAN; }), LogicError);
  EXPECT_THROW(run([](auto&) {}, {16}), InputError);
}

INSTANTIATE_TEST_SUITE_P(Paths, CombinationChamferPaths, test::all_paths, test::param_name);

}  // namespace
}  // namespace edgescout
