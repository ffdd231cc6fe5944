// mutual_information: its reference against sums of plain exponentials in long double, which reach
// down to exp(-11000); and what holds of any mutual information, on both processor paths.
#include "kernels/mutual_information.h"

#include <functional>

#include "kernels/error.h"
#include "kernels/thread_pool.h"
#include "tests/kernels/paths.h"

namespace edgescout {
namespace {

struct Table {
  std::uint32_t particles, combinations;
  std::vector<ChamferCell> cells;
  std::vector<ParticleBelief> beliefs;
  double cap_px = 255.0 / 16;
  ChamferTable view() const { return {particles, combinations, cap_px, cells}; }
  ChamferCell& at(std::uint32_t i, std::uint32_t j) {
    return cells[std::size_t(i) * combinations + j];
  }
};

ChamferCell cell_of(double mu_px, int seen, int unseen) {
  return {std::uint32_t(std::lround(16 * mu_px * seen)), std::uint16_t(seen),
          std::uint16_t(unseen)};
}

// Means in [low, high] px; now and then nothing is seen.
Table random_table(std::mt19937& rng, std::uint32_t particles, std::uint32_t combinations,
                   double low_px, double high_px) {
  std::uniform_real_distribution<double> mu(low_px, high_px), log_weight(-3, 3), upsilon(0, 20);
  std::uniform_int_distribution<int> seen(0, 60);
  Table table{particles, combinations, {}, {}};
  for (std::uint32_t i = 0; i < particles; ++i) {
    for (std::uint32_t j = 0; j < combinations; ++j) {
      const int s = seen(rng);
      table.cells.push_back(cell_of(mu(rng), s, s / 2));
    }
    table.beliefs.push_back(
        {log_weight(rng), std::uint32_t(i % 3 == 0 ? 0 : seen(rng)), 100, upsilon(rng)});
  }
  return table;
}

double direct(const Table& table, const InformationOptions& options) {
  const std::size_t n = table.particles, m = table.combinations;
  std::vector<long double> w(n), l(n * m), p(m, 0);
  long double weights = 0;
  for (std::size_t i = 0; i < n; ++i)
    weights += w[i] = std::exp((long double)(table.beliefs[i].log_weight));
  for (std::size_t i = 0; i < n; ++i) {
    const ParticleBelief& b = table.beliefs[i];
    long double row = 0;
    for (std::size_t j = 0; j < m; ++j) {
      const ChamferCell& cell = table.cells[i * m + j];
      const long double mu =
          cell.seen > 0 ? (long double)(cell.sum) / cell.seen / 16 : (long double)(table.cap_px);
      const long double points =
          b.already_seen + cell.unseen > 0 ? b.already_seen + cell.unseen : 0.5L;
      l[i * m + j] = points / b.total *
                     std::exp(-(mu * mu + (options.use_paper_formula ? b.upsilon_px2 : 0)) /
                              options.scale_px2);
      row += l[i * m + j];
    }
    for (std::size_t j = 0; j < m; ++j) {
      if (!options.use_paper_formula) l[i * m + j] /= row;
      p[j] += w[i] / weights * l[i * m + j];
    }
  }
  long double information = 0;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < m; ++j)
      if (l[i * m + j] > 0 && w[i] > 0)
        information += w[i] / weights * l[i * m + j] * std::log(l[i * m + j] / p[j]);
  return double(information);
}

class MutualInformation : public ::testing::TestWithParam<bool> {
 protected:
  double of(const Table& table, const InformationOptions& options) {
    return GetParam() ? mutual_information_fast(table.view(), table.beliefs, options, pool_)
                      : mutual_information_reference(table.view(), table.beliefs, options);
  }
  ThreadPool pool_{2};
};

TEST_P(MutualInformation, IsTheSumOfTheEquation) {
  std::mt19937 rng = test::test_rng();
  for (const double scale : {0.5, 8.0, 200.0})
    for (const bool use_paper_formula : {false, true})
      for (const auto& [particles, combinations] :
           std::vector<std::pair<int, int>>{{1, 1}, {1, 9}, {7, 1}, {5, 3}, {40, 70}}) {
        const Table table = random_table(rng, particles, combinations, 0, 12);
        const double expected = direct(table, {scale, use_paper_formula});
        EXPECT_NEAR(of(table, {scale, use_paper_formula}), expected, 1e-9 * (1 + expected))
            << particles << " x " << combinations;
      }
}

TEST_P(MutualInformation, StaysBetweenZeroAndBothEntropies) {
  std::mt19937 rng = test::test_rng();
  double largest = 0;
  for (int round = 0; round < 60; ++round) {
    const std::uint32_t particles = 1 + rng() % 12, combinations = 1 + rng() % 12;
    const Table table = random_table(rng, particles, combinations, 0, round % 2 == 0 ? 3 : 60);
    const double information = of(table, {round % 3 == 0 ? 0.01 : 20.0, false});
    EXPECT_GE(information, 0);
    EXPECT_LE(information, std::log(std::min(particles, combinations)) + 1e-12);
    EXPECT_GE(of(table, {20, true}), 0);
    largest = std::max(largest, information);
  }
  EXPECT_GT(largest, 0.5);
}

TEST_P(MutualInformation, ReachesTheBoundWhenEveryParticleHasItsOwnRealization) {
  Table table{8, 8, std::vector<ChamferCell>(64, cell_of(15, 50, 10)),
              std::vector<ParticleBelief>(8, {0, 20, 100, 0})};
  for (std::uint32_t i = 0; i < 8; ++i) table.at(i, (3 * i) % 8) = cell_of(1, 50, 10);
  EXPECT_NEAR(of(table, {2, false}), std::log(8.0), 1e-9);
}

// Totals, weights and points seen before differ, but not how a particle's own combinations compare.
TEST_P(MutualInformation, IsZeroWhereTheLikelihoodDoesNotDependOnTheParticle) {
  std::mt19937 rng = test::test_rng();
  Table table = random_table(rng, 30, 50, 0, 15);
  for (std::uint32_t i = 0; i < 30; ++i) {
    for (std::uint32_t j = 0; j < 50; ++j) table.at(i, j) = table.at(0, j);
    table.beliefs[i].already_seen = 17;
    table.beliefs[i].total = 100 + i;
  }
  EXPECT_NEAR(of(table, {8, false}), 0, 1e-12);
}

// exp(-60^2 / 0.5) is 1e-3127: no double holds it.
TEST_P(MutualInformation, DoesNotUnderflowAtSixtyPixels) {
  std::mt19937 rng = test::test_rng();
  const Table table = random_table(rng, 20, 30, 59.9, 60.1);
  const double expected = direct(table, {0.5, false}), information = of(table, {0.5, false});
  EXPECT_GT(expected, 0.5);
  EXPECT_NEAR(information, expected, 1e-8);
  EXPECT_LT(of(table, {0.5, true}), 1e-200);  // the paper's own form does
}

TEST_P(MutualInformation, ASplitParticleOrDoubledRealizationsTellNoMore) {
  std::mt19937 rng = test::test_rng();
  const Table table = random_table(rng, 9, 11, 0, 8);
  const double information = of(table, {8, false});
  Table particles = table;
  particles.particles = 10;
  particles.cells.insert(particles.cells.end(), table.cells.begin() + 4 * 11,
                         table.cells.begin() + 5 * 11);
  particles.beliefs.push_back(table.beliefs[4]);
  for (const std::size_t i : {4, 9}) particles.beliefs[i].log_weight -= std::log(2.0);
  EXPECT_NEAR(of(particles, {8, false}), information, 1e-12);
  Table doubled{9, 22, {}, table.beliefs};
  for (std::uint32_t i = 0; i < 9; ++i)
    for (std::uint32_t j = 0; j < 22; ++j) doubled.cells.push_back(table.cells[i * 11 + j / 2]);
  EXPECT_NEAR(of(doubled, {8, false}), information, 1e-12);
}

TEST_P(MutualInformation, AParticleWithoutWeightDoesNotCount) {
  std::mt19937 rng = test::test_rng();
  Table table = random_table(rng, 9, 11, 0, 8);
  const double information = of(table, {8, false});
  table.particles = 10;
  for (int j = 0; j < 11; ++j) table.cells.push_back(cell_of(j, 40, 3));
  table.beliefs.push_back({-std::numeric_limits<double>::infinity(), 3, 100, 0});
  EXPECT_NEAR(of(table, {8, false}), information, 1e-12);
  for (ParticleBelief& belief : table.beliefs) belief.log_weight += 5000;  // up to a constant
  EXPECT_NEAR(of(table, {8, false}), information, 1e-9);
}

TEST_P(MutualInformation, BrokenInputIsOurBug) {
  std::mt19937 rng = test::test_rng();
  const Table good = random_table(rng, 3, 4, 0, 8);
  const auto run = [&](const std::function<void(Table&)>& spoil,
                       const InformationOptions& options = {}) {
    Table table = good;
    spoil(table);
    of(table, options);
  };
  EXPECT_NO_THROW(run([](Table&) {}));
  EXPECT_THROW(run([](Table& t) { t.cells.pop_back(); }), LogicError);
  EXPECT_THROW(run([](Table& t) { t.beliefs.pop_back(); }), LogicError);
  EXPECT_THROW(run([](Table& t) { t.beliefs[1].total = 0; }), LogicError);
  EXPECT_THROW(run([](Table& t) { t.beliefs[1].log_weight = NAN; }), LogicError);
  EXPECT_THROW(run([](Table& t) {
                 for (ParticleBelief& b : t.beliefs) b.log_weight = -INFINITY;
               }),
               LogicError);
  EXPECT_THROW(run([](Table& t) { t = {0, 0, {}, {}}; }), LogicError);
  EXPECT_THROW(run([](Table&) {}, {0, false}), InputError);
  EXPECT_THROW(run([](Table&) {}, {NAN, false}), InputError);
}

INSTANTIATE_TEST_SUITE_P(Paths, MutualInformation, ::testing::Bool(),
                         [](const auto& path) { return path.param ? "fast" : "reference"; });

}  // namespace
}  // namespace edgescout
