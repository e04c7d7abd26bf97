#include "reference/judge/episodes.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>

namespace contactcheck::judge {
namespace {

bool holds(const std::vector<BodyPair>& pairs, const BodyPair& pair) {
  return std::binary_search(pairs.begin(), pairs.end(), pair);
}

std::vector<results::Episode> episodes_of(const BodyPair& pair, const BodyPairsPerFrame& truth,
                                          const BodyPairsPerFrame& reported) {
  std::vector<results::Episode> out;
  bool open = false;
  for (std::size_t f = 0; f < truth.size(); ++f) {
    const bool is_true = holds(truth[f], pair), is_reported = holds(reported[f], pair);
    if (is_true || is_reported) {
      if (!open) {
        out.emplace_back();
        out.back().bodies = pair;
      }
      if (is_true && !out.back().first_true) out.back().first_true = f;
      if (is_reported && !out.back().first_reported) out.back().first_reported = f;
    }
    open = is_true || is_reported;
  }
  for (results::Episode& e : out) {
    if (e.first_true && e.first_reported)
      e.late_frames = static_cast<long>(*e.first_reported) - static_cast<long>(*e.first_true);
  }
  return out;
}

}  // namespace

std::vector<results::Episode> find_episodes(const BodyPairsPerFrame& truth,
                                            const BodyPairsPerFrame& reported) {
  std::set<BodyPair> pairs;
  for (const auto& frame : truth) pairs.insert(frame.begin(), frame.end());
  for (const auto& frame : reported) pairs.insert(frame.begin(), frame.end());
  std::vector<results::Episode> out;
  for (const BodyPair& pair : pairs) {
    const std::vector<results::Episode> found = episodes_of(pair, truth, reported);
    out.insert(out.end(), found.begin(), found.end());
  }
  return out;
}

void sum_up_episodes(results::Geometry& geometry) {
  std::optional<double>& gap = geometry.hover_gap_max;
  std::optional<long>& late = geometry.late_frames;
  gap.reset();
  late.reset();
  for (const results::Episode& e : geometry.episodes) {
    if (e.hover_gap) gap = std::max(gap.value_or(0.0), *e.hover_gap);
    if (e.late_frames && (!late || std::labs(*e.late_frames) > std::labs(*late)))
      late = e.late_frames;
  }
}

double bisect_hover_gap(double before, double after, double tolerance,
                        const std::function<bool(double)>& reports,
                        const std::function<double(double)>& distance) {
  double gap_before = distance(before), gap_after = distance(after);
  // Equal distances at both ends of a long interval prove nothing unless both are contact: a few
  // halvings first. 60 exhaust the doubles between two frames: more cannot change anything.
  constexpr int kFewest = 6, kMost = 60;
  for (int i = 0; i < kMost; ++i) {
    const bool both_touch = gap_before == 0.0 && gap_after == 0.0;
    if (both_touch || (i >= kFewest && std::abs(gap_before - gap_after) < tolerance)) break;
    const double middle = 0.5 * (before + after);
    if (reports(middle)) {
      after = middle;
      gap_after = distance(middle);
    } else {
      before = middle;
      gap_before = distance(middle);
    }
  }
  return gap_after;
}

}  // namespace contactcheck::judge
