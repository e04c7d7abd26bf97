#include "reference/report/tables/error_counts.h"

#include <algorithm>

#include "reference/report/tables/run_row.h"

namespace contactcheck::report {
namespace {

std::optional<double> share(std::uint64_t part, std::uint64_t whole) {
  if (whole == 0) return {};
  return static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

bool ErrorCounts::add(const results::Run& run, std::optional<Level> level) {
  const results::LevelCounts* counts = claimed_counts(run, level);
  if (counts == nullptr) return false;
  truth += counts->truth;
  reported += counts->reported;
  missed += counts->missed;
  spurious += counts->spurious;
  return true;
}

std::optional<double> ErrorCounts::missed_share() const { return share(missed, truth); }
std::optional<double> ErrorCounts::spurious_share() const { return share(spurious, reported); }

std::optional<double> ErrorCounts::worse_share() const {
  const auto missing = missed_share(), inventing = spurious_share();
  if (!missing || !inventing) return missing ? missing : inventing;
  return std::max(*missing, *inventing);
}

}  // namespace contactcheck::report
