#include "reference/report/tables/scale_ranges.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <string>

#include "reference/report/tables/family_result.h"
#include "reference/report/tables/run_row.h"
#include "reference/results/scale_ranges.h"

namespace contactcheck::report {
namespace {

using results::ScaleRange;

constexpr const char* kKinds[] = {"size", "distance"};
constexpr std::size_t kNamedScenes = 3;

// A detector's answers at one value, in all families that have it.
struct ValueAnswers {
  std::string value;  // as the files write it
  std::size_t cases = 0, right = 0;
  std::string wrong;  // the first case that is wrong, with what is wrong there; empty: none
};

struct DetectorAnswers {
  std::string level = "-";
  std::map<double, ValueAnswers> by_value;
};

void add(const FamilyResult& result, DetectorAnswers& to) {
  if (result.judged()) to.level = finest_level(result.run);
  for (std::size_t f = 0; f < result.cases(); ++f) {
    const std::string& value = result.value(f);
    ValueAnswers& at = to.by_value[results::parameter_number(value)];
    at.value = value;
    ++at.cases;
    if (result.judged() && !result.wrong_at(f)) {
      ++at.right;
      continue;
    }
    if (!at.wrong.empty()) continue;
    const std::string unanswered = result.run.ok() ? "not judged" : name_of(result.run.status);
    at.wrong = fmt::format("{}@{}: {}", result.scene.id, value,
                           result.judged() ? result.errors_text(f) : unanswered);
  }
}

ScaleRange range_of(const std::string& detector, const char* by, const DetectorAnswers& answers) {
  ScaleRange out;
  out.detector = detector;
  out.by = by;
  out.level = answers.level;
  std::vector<const ValueAnswers*> values;  // ascending
  for (const auto& [number, at] : answers.by_value) {
    values.push_back(&at);
    out.cases += at.cases;
    out.right += at.right;
  }
  out.least = values.front()->value;
  out.most = values.back()->value;
  std::size_t first = 0, count = 0;  // of the longest run of right values
  for (std::size_t begin = 0, n = 0; begin < values.size(); begin += n + 1) {
    for (n = 0; begin + n < values.size() && values[begin + n]->wrong.empty();) ++n;
    if (n > count) first = begin, count = n;
  }
  if (first > 0) out.wrong_below = values[first - 1]->wrong;
  if (first + count < values.size()) out.wrong_above = values[first + count]->wrong;
  if (count == 0) return out;
  out.from = values[first]->value;
  out.to = values[first + count - 1]->value;
  return out;
}

std::string or_dash(const std::string& text) { return text.empty() ? "-" : text; }

std::vector<std::string> line(const ScaleRange& r) {
  const std::string share = fmt::format("{} of {}", r.right, r.cases);
  if (r.from.empty())
    return {r.detector, r.level, "nowhere", "-", share, "-", or_dash(r.wrong_above)};
  return {r.detector,
          r.level,
          r.from + (r.from == r.least ? " (smallest tried)" : ""),
          r.to + (r.to == r.most ? " (largest tried)" : ""),
          share,
          or_dash(r.wrong_below),
          or_dash(r.wrong_above)};
}

// "0.1 to 3e5"
std::string span(const ScaleRange& r) {
  if (r.from.empty()) return "nowhere";
  if (r.from == r.least && r.to == r.most) return r.from + " to " + r.to + " (all tried)";
  return r.from + " to " + r.to;
}

TitledTable table_of(const std::vector<ScaleRange>& ranges, const std::string& by) {
  const bool sizes = by == kKinds[0];
  TitledTable out{
      sizes ? "In which range of sizes each is right" : "How far from the origin each is right",
      sizes ? "By the edge of a triangle in metres, near the origin."
            : "By the distance from the origin in edges of a triangle; an edge is one metre long.",
      {{"detector", true, ""},
       {"level", true, ""},
       {"right from", false, "the range in which every case is answered as claimed begins here"},
       {"right to", false, "and ends here"},
       {"cases right", false, ""},
       {.title = "nearest wrong below", .left = true, .spare = 10},
       {.title = "nearest wrong above", .left = true, .spare = 11}},
      {}};
  for (const ScaleRange& range : ranges)
    if (range.by == by) out.rows.push_back(line(range));
  return out;
}

// The detector's scenes outside its range, each with its edge lengths or how far out it is.
std::vector<std::string> scenes_outside(const results::Index& index, const ScaleRange& range) {
  std::vector<std::string> names;
  for (const results::Scene& scene : index.results().scenes) {
    if (!scene.scale || index.run(scene.id, range.detector) == nullptr) continue;
    const results::SceneScale& s = *scene.scale;
    if (!results::outside(range, s)) continue;
    names.push_back(scene.id +
                    (range.by_size()
                         ? fmt::format(" ({:.3g} to {:.3g})", s.shortest_edge, s.longest_edge)
                         : fmt::format(" ({:.3g})", s.reach / s.shortest_edge)));
  }
  return names;
}

std::string first_of(std::vector<std::string> names) {
  const std::size_t more = names.size() - std::min(names.size(), kNamedScenes);
  names.resize(names.size() - more);
  return or_dash(fmt::format("{}", fmt::join(names, ", ")) +
                 (more > 0 ? fmt::format(" and {} more", more) : ""));
}

}  // namespace

std::vector<ScaleRange> scale_ranges(const results::Index& index) {
  const std::vector<FamilyResult> all = family_results(index);
  std::vector<ScaleRange> out;
  for (const char* by : kKinds) {
    std::vector<std::string> order;
    std::map<std::string, DetectorAnswers> detectors;
    for (const FamilyResult& result : all) {
      if (result.scene.family->range != by || result.run.status == results::Status::kAbsent)
        continue;
      const std::string& detector = result.detector();
      if (!detectors.contains(detector)) order.push_back(detector);
      add(result, detectors[detector]);
    }
    for (const std::string& detector : order)
      out.push_back(range_of(detector, by, detectors[detector]));
  }
  return out;
}

std::vector<TitledTable> range_tables(const std::vector<ScaleRange>& ranges) {
  std::vector<TitledTable> out;
  for (const char* by : kKinds)
    if (TitledTable table = table_of(ranges, by); !table.rows.empty())
      out.push_back(std::move(table));
  return out;
}

TitledTable known_ranges_table(const results::Index& index) {
  const results::Results& results = index.results();
  TitledTable out{
      "In which sizes, and how far from the origin, each is known to be right",
      "As measured once by the suite `scales`, with the versions of the libraries that this run "
      "has: within the range every case was answered as claimed, outside it some case was not, or "
      "none was tried. Sizes are edges in metres (of a scene, the longest sides of its triangles "
      "at rest); distances are those from the origin in edges (of a scene, its largest coordinate "
      "in the shortest of its edges).",
      {{"detector", true, ""}, {"by", true, ""}, {"right", true, ""}, {"scenes outside", true, ""}},
      {}};
  if (std::none_of(results.scenes.begin(), results.scenes.end(),
                   [](const results::Scene& scene) { return scene.scale.has_value(); }))
    return out;
  for (const ScaleRange& range : results.known_ranges)
    out.rows.push_back(
        {range.detector, range.by, span(range), first_of(scenes_outside(index, range))});
  return out;
}

std::vector<std::string> detectors_out_of_range(const results::Index& index) {
  std::vector<std::string> out;
  for (const ScaleRange& range : index.results().known_ranges)
    if ((out.empty() || out.back() != range.detector) && !scenes_outside(index, range).empty())
      out.push_back(range.detector);
  return out;
}

std::string range_changes(const std::vector<ScaleRange>& listed,
                          const std::vector<ScaleRange>& shown) {
  std::string out;
  const auto described = [](const ScaleRange* r) {
    return r == nullptr ? "-" : fmt::format("{}, {} of {} right", span(*r), r->right, r->cases);
  };
  const auto same_place = [](const ScaleRange& one) {
    return [&one](const ScaleRange& other) {
      return other.detector == one.detector && other.by == one.by;
    };
  };
  for (const ScaleRange& is : shown) {
    const auto was = std::find_if(listed.begin(), listed.end(), same_place(is));
    if (was != listed.end() && *was == is) continue;
    out += fmt::format("  {}  {}  {} -> {}\n", is.detector, is.by,
                       described(was == listed.end() ? nullptr : &*was), described(&is));
  }
  return out;
}

}  // namespace contactcheck::report
