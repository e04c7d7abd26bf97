#include "reference/results/scale_ranges.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <tuple>

#include "core/deform/atomic_file.h"
#include "core/types/check.h"
#include "reference/results/defect_comparison.h"
#include "reference/results/results_json.h"
#include "reference/text/file_text.h"
#include "reference/text/json_field.h"

namespace contactcheck::results {
namespace {

constexpr const char* kFile = "ranges.json";

// Sizes before distances.
auto place_of(const ScaleRange& r) {
  return std::make_tuple(r.detector, !r.by_size(), r.library, r.version);
}

// A value as the families write them, so that it has a number.
std::string value_of(const text::JsonField& field) {
  std::string value = field.text();
  try {
    parameter_number(value);
  } catch (const InputError&) {
    field.refuse("a number in quotes");
  }
  return value;
}

ScaleRange range_of(const text::JsonField& field) {
  constexpr std::size_t kMost = 1'000'000'000'000;
  field.only_keys({"detector", "by", "library", "version", "level", "from", "to", "least", "most",
                   "right", "cases", "wrong_below", "wrong_above"});
  ScaleRange out;
  out.detector = field.at("detector").text();
  out.by = field.at("by").one_of({"size", "distance"});
  out.library = field.at("library").text();
  out.version = field.at("version").text();
  out.level = field.at("level").text();
  out.least = value_of(field.at("least"));
  out.most = value_of(field.at("most"));
  out.right = field.at("right").whole(0, kMost);
  out.cases = field.at("cases").whole(1, kMost);
  if (field.has("wrong_below")) out.wrong_below = field.at("wrong_below").text();
  if (field.has("wrong_above")) out.wrong_above = field.at("wrong_above").text();
  if (!field.has("from") && !field.has("to")) return out;
  out.from = value_of(field.at("from"));
  out.to = value_of(field.at("to"));
  if (parameter_number(out.from) > parameter_number(out.to))
    field.at("to").fail("is below where the range begins");
  return out;
}

}  // namespace

std::vector<ScaleRange> read_scale_ranges(const std::filesystem::path& folder) {
  std::vector<ScaleRange> out;
  const std::filesystem::path file = folder / kFile;
  if (!std::filesystem::exists(file)) return out;
  const std::string document = "ranges " + text::in_quotes(file.string());
  const text::JsonValue value = text::parse_json(text::read_file_bytes(file, "ranges"), document);
  const text::JsonField root(value, document);
  root.only_keys({"ranges"});
  for (const text::JsonField& item : root.at("ranges").items()) {
    ScaleRange range = range_of(item);
    for (const ScaleRange& other : out)
      if (place_of(other) == place_of(range))
        item.fail("has the detector, version and parameter of an earlier one");
    out.push_back(std::move(range));
  }
  return out;
}

void write_scale_ranges(const std::filesystem::path& folder,
                        const std::vector<ScaleRange>& ranges) {
  std::string text;  // one line each: a change is seen as the lines that changed
  for (const ScaleRange& range : ranges)
    text += (text.empty() ? "\n  " : ",\n  ") + to_json(range).dump();
  write_file_atomically(folder / kFile, "{\n \"ranges\": [" + text + "\n ]\n}\n");
}

std::vector<ScaleRange> updated(std::vector<ScaleRange> known, const std::vector<ScaleRange>& run) {
  for (const ScaleRange& range : run) {
    std::erase_if(known, [&](const ScaleRange& r) { return place_of(r) == place_of(range); });
    known.push_back(range);
  }
  std::sort(known.begin(), known.end(),
            [](const ScaleRange& a, const ScaleRange& b) { return place_of(a) < place_of(b); });
  return known;
}

std::vector<ScaleRange> ranges_of_run(const std::vector<ScaleRange>& known,
                                      const Results& results) {
  const LibraryVersions versions = versions_in(results);
  const Index index(results);
  std::vector<ScaleRange> out;
  for (const std::string& detector : index.detectors())
    for (const ScaleRange& range : known) {
      const auto version = versions.find(range.library);
      if (range.detector == detector && version != versions.end() &&
          version->second == range.version)
        out.push_back(range);
    }
  return out;
}

bool outside(const ScaleRange& range, const SceneScale& scale) {
  if (range.from.empty()) return true;
  if (!range.by_size()) return scale.reach / scale.shortest_edge > parameter_number(range.to);
  return scale.shortest_edge < parameter_number(range.from) ||
         scale.longest_edge > parameter_number(range.to);
}

}  // namespace contactcheck::results
