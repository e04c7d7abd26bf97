#include "reference/report/error_counts.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "reference/report/format.h"

namespace contactcheck {
namespace {

std::optional<double> share(std::int64_t part, std::int64_t whole) {
  if (whole <= 0) return {};
  return static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

bool ErrorCounts::add(const nlohmann::ordered_json& run, const std::string& level) {
  const auto& levels = run.at("levels");
  if (!levels.contains(level) || levels.at(level).value("informative", false)) return false;
  const auto& counts = levels.at(level);
  truth += whole_number(counts.at("truth"));
  reported += whole_number(counts.at("reported"));
  missed += whole_number(counts.at("missed"));
  spurious += whole_number(counts.at("spurious"));
  return true;
}

std::optional<double> ErrorCounts::missed_share() const { return share(missed, truth); }
std::optional<double> ErrorCounts::spurious_share() const { return share(spurious, reported); }

std::optional<double> ErrorCounts::worse_share() const {
  const auto missing = missed_share(), inventing = spurious_share();
  if (!missing || !inventing) return missing ? missing : inventing;
  return std::max(*missing, *inventing);
}

}  // namespace contactcheck
