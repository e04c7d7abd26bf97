#include "reference/report/tables/family_result.h"

#include <fmt/format.h>

#include <cctype>

#include "core/types/check.h"

namespace contactcheck::report {
namespace {

template <typename T>
const T& of_case(const std::vector<T>& list, std::size_t frame, const results::Scene& scene) {
  if (frame < list.size()) return list[frame];
  throw InputError("the results of family \"" + scene.id + "\" are not complete: frame " +
                   std::to_string(frame) + " is missing");
}

}  // namespace

const std::string& FamilyResult::value(std::size_t frame) const {
  return of_case(scene.family->values, frame, scene);
}

std::uint64_t FamilyResult::at(Counts counts, std::size_t frame) const {
  return of_case(run.per_frame.*counts, frame, scene);
}

bool FamilyResult::wrong_at(std::size_t frame) const {
  return at(&results::PerFrame::missed, frame) + at(&results::PerFrame::spurious, frame) > 0;
}

std::string FamilyResult::errors_text(std::size_t frame) const {
  return fmt::format("{} missed, {} spurious of {} true", at(&results::PerFrame::missed, frame),
                     at(&results::PerFrame::spurious, frame), at(&results::PerFrame::truth, frame));
}

std::uint64_t FamilyResult::sum(Counts counts) const {
  std::uint64_t sum = 0;
  for (std::size_t f = 0; judged() && f < cases(); ++f) sum += at(counts, f);
  return sum;
}

std::size_t FamilyResult::wrong() const {
  std::size_t wrong = 0;
  for (std::size_t f = 0; judged() && f < cases(); ++f) wrong += wrong_at(f);
  return wrong;
}

std::optional<std::size_t> FamilyResult::failed_frame() const {
  if (!failed() || !run.failed_frame) return {};
  value(*run.failed_frame);  // throws where there is no such case
  return run.failed_frame;
}

std::optional<double> FamilyResult::milliseconds() const {
  if (!judged() || run.times.empty()) return {};
  return run.times.front().playback.frame;
}

// Results may come from anywhere: an id must not lead out of the folder.
std::string stability_plot_file(const results::Scene& scene) {
  std::string name = scene.id;
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '-';
  return "plots/" + name + ".svg";
}

std::vector<FamilyResult> family_results(const results::Index& index) {
  std::vector<FamilyResult> out;
  for (const results::Scene& scene : index.results().scenes) {
    if (!scene.family) continue;
    for (const results::Run* run : index.runs_of(scene.id)) out.push_back({scene, *run});
  }
  return out;
}

}  // namespace contactcheck::report
