// Asks both exact tests of moving elements about odd queries and compares every answer with the
// oracle's:
//   odd_impacts [--seed N] [--count N] [--seconds N]
//
//   --seed      of the first query; the next queries have the next seeds (default 1)
//   --count     ends after so many (default: no limit)
//   --seconds   begins no query later (default 10)
//
// Exit code 1: an answer differs from the oracle's. The lines name the seed: --seed N --count 1
// runs that query alone.
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <random>
#include <string>

#include "core/narrow/impact.h"
#include "core/narrow/impact_filter.h"
#include "reference/oracle/elementary_impact.h"
#include "tests/odd/seed_arguments.h"
#include "tests/support/impact_queries.h"

namespace contactcheck::test {
namespace {

using Clock = std::chrono::steady_clock;

struct Totals {
  std::uint64_t queries = 0, contacts = 0, at_start = 0, undecided = 0, wrong = 0;
  double core_seconds = 0, exact_seconds = 0, oracle_seconds = 0;
};

template <typename Function>
auto timed(double& seconds, const Function& function) {
  const auto start = Clock::now();
  auto result = function();
  seconds += std::chrono::duration<double>(Clock::now() - start).count();
  return result;
}

class Comparison {
 public:
  void run(std::uint64_t seed) {
    std::mt19937_64 random(seed);
    const ImpactFamily family = draw_impact_family(random);
    const ImpactQuery query = draw_impact_query(random, family);
    const Impact core = timed(totals_.core_seconds, [&] { return find_impact(query); });
    const Impact exact = timed(totals_.exact_seconds, [&] { return find_impact_exact(query); });
    const Impact truth =
        timed(totals_.oracle_seconds, [&] { return oracle::elementary_impact(query); });
    ++totals_.queries;
    totals_.contacts += truth.contact;
    totals_.at_start += truth.starts_in_contact;
    totals_.undecided += filter_impact(query).verdict == FilterVerdict::undecided;
    const bool right = say(seed, family, query, "find_impact", core, truth) &&
                       say(seed, family, query, "find_impact_exact", exact, truth);
    totals_.wrong += !right;
  }

  const Totals& totals() const { return totals_; }

 private:
  /// Whether the answer is right; prints the first one that is not.
  bool say(std::uint64_t seed, ImpactFamily family, const ImpactQuery& query, const char* name,
           const Impact& answer, const Impact& truth) const {
    const std::string wrong = contradiction(answer, truth);
    if (wrong.empty()) return true;
    if (totals_.wrong == 0)
      std::printf("seed %llu, %s: %s\n  %s: %s\n  oracle: %s\n%s",
                  static_cast<unsigned long long>(seed), name_of(family), wrong.c_str(), name,
                  text(answer).c_str(), text(truth).c_str(), text(query).c_str());
    return false;
  }

  Totals totals_;
};

int run(const SeedArguments& arguments) {
  const auto end = Clock::now() + std::chrono::seconds(arguments.seconds);
  Comparison comparison;
  const Totals& totals = comparison.totals();
  while (totals.queries < arguments.count && Clock::now() < end)
    comparison.run(arguments.seed + totals.queries);
  std::printf(
      "%llu queries from seed %llu: %llu contacts, %llu of them at the start; the filter left %llu "
      "undecided; find_impact %.2f s, find_impact_exact %.2f s, oracle %.2f s; %llu answers differ "
      "from the oracle's\n",
      static_cast<unsigned long long>(totals.queries),
      static_cast<unsigned long long>(arguments.seed),
      static_cast<unsigned long long>(totals.contacts),
      static_cast<unsigned long long>(totals.at_start),
      static_cast<unsigned long long>(totals.undecided), totals.core_seconds, totals.exact_seconds,
      totals.oracle_seconds, static_cast<unsigned long long>(totals.wrong));
  // Of many queries some are of each kind, or the queries are no test.
  const bool some =
      totals.queries < 100 || (totals.at_start > 0 && totals.contacts > totals.at_start &&
                               totals.undecided > 0 && totals.undecided < totals.queries);
  return totals.wrong == 0 && some ? 0 : 1;
}

}  // namespace
}  // namespace contactcheck::test

int main(int argc, char** argv) {
  contactcheck::test::SeedArguments arguments;
  if (!contactcheck::test::parse(argc, argv, "--count", arguments)) {
    std::fprintf(stderr, "usage: odd_impacts [--seed N] [--count N] [--seconds N]\n");
    return 2;
  }
  return contactcheck::test::run(arguments);
}
