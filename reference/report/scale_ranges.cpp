#include "reference/report/scale_ranges.h"

#include <fmt/format.h>

#include <map>
#include <string>

#include "reference/report/family_result.h"

namespace contactcheck::report {
namespace {

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

std::vector<std::string> line(const std::string& detector, const DetectorAnswers& answers) {
  std::vector<const ValueAnswers*> values;  // ascending
  std::size_t cases = 0, right = 0;
  for (const auto& [number, at] : answers.by_value) {
    values.push_back(&at);
    cases += at.cases;
    right += at.right;
  }
  std::size_t first = 0, count = 0;  // of the longest run of right values
  for (std::size_t begin = 0, n = 0; begin < values.size(); begin += n + 1) {
    for (n = 0; begin + n < values.size() && values[begin + n]->wrong.empty();) ++n;
    if (n > count) first = begin, count = n;
  }
  const std::string share = fmt::format("{} of {}", right, cases);
  if (count == 0) return {detector, answers.level, "nowhere", "-", share, "-", values[0]->wrong};
  const std::size_t last = first + count - 1;
  const auto end_text = [&](std::size_t i, bool is_end, const char* word) {
    return values[i]->value + (is_end ? fmt::format(" ({})", word) : "");
  };
  return {detector,
          answers.level,
          end_text(first, first == 0, "smallest tried"),
          end_text(last, last + 1 == values.size(), "largest tried"),
          share,
          first == 0 ? "-" : values[first - 1]->wrong,
          last + 1 == values.size() ? "-" : values[last + 1]->wrong};
}

TitledTable table_of(const results::Results& results, const std::string& range) {
  const bool sizes = range == "size";
  TitledTable out{
      sizes ? "In which range of sizes each is right" : "How far from the origin each is right",
      sizes ? "By the edge of a triangle in metres, near the origin."
            : "By the distance from the origin in edges of a triangle; an edge is one metre long.",
      {{"detector", true, ""},
       {"level", true, ""},
       {"right from", false, "the range in which every case is answered as claimed begins here"},
       {"right to", false, "and ends here"},
       {"cases right", false, ""},
       {"nearest wrong below", true, ""},
       {"nearest wrong above", true, ""}},
      {}};
  std::vector<std::string> order;
  std::map<std::string, DetectorAnswers> detectors;
  for (const FamilyResult& result : family_results(results)) {
    if (result.scene.family->range != range || result.run.status == results::Status::kAbsent)
      continue;
    const std::string& detector = result.detector();
    if (!detectors.contains(detector)) order.push_back(detector);
    add(result, detectors[detector]);
  }
  for (const std::string& detector : order) out.rows.push_back(line(detector, detectors[detector]));
  return out;
}

}  // namespace

std::vector<TitledTable> scale_ranges(const results::Results& results) {
  std::vector<TitledTable> out;
  for (const char* range : {"size", "distance"})
    if (TitledTable table = table_of(results, range); !table.rows.empty())
      out.push_back(std::move(table));
  return out;
}

}  // namespace contactcheck::report
