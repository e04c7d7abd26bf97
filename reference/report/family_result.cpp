#include "reference/report/family_result.h"

#include "reference/report/format.h"

namespace contactcheck {
namespace {
using Json = nlohmann::ordered_json;
}  // namespace

std::string FamilyResult::level() const {
  return run.contains("per_frame") ? run.at("per_frame").value("level", "") : "";
}

std::string FamilyResult::value(std::size_t frame) const {
  return scene.at("family").at("values").at(frame).get<std::string>();
}

std::int64_t FamilyResult::at(const char* kind, std::size_t frame) const {
  return whole_number(run.at("per_frame").at(kind).at(frame));
}

std::int64_t FamilyResult::sum(const char* kind) const {
  std::int64_t sum = 0;
  for (std::size_t f = 0; judged() && f < cases(); ++f) sum += at(kind, f);
  return sum;
}

std::size_t FamilyResult::wrong() const {
  std::size_t wrong = 0;
  for (std::size_t f = 0; judged() && f < cases(); ++f) wrong += wrong_at(f);
  return wrong;
}

std::optional<std::size_t> FamilyResult::failed_frame() const {
  if (!failed() || !run.contains("failed_frame")) return {};
  const auto frame = static_cast<std::size_t>(whole_number(run.at("failed_frame")));
  value(frame);  // throws where there is no such case
  return frame;
}

std::optional<double> FamilyResult::milliseconds() const {
  if (!judged() || !run.at("time_ms").contains("cold")) return {};
  return run.at("time_ms").at("cold").at("frame").get<double>();
}

std::vector<FamilyResult> family_results(const Json& results) {
  std::vector<FamilyResult> out;
  for (const Json& scene : results.at("scenes")) {
    if (!scene.contains("family")) continue;
    for (const Json& run : results.at("runs"))
      if (run.at("scene") == scene.at("id")) out.push_back({scene, run});
  }
  return out;
}

}  // namespace contactcheck
