#include "reference/results/known_defects.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/deform/atomic_file.h"
#include "core/types/check.h"
#include "reference/results/scale_ranges.h"
#include "reference/text/file_text.h"
#include "reference/text/json_field.h"

namespace contactcheck::results {
namespace {

using results::Run;

void add_answers(const results::Family& family, const Run& run, SightingsOfRun& out) {
  Sighting s{run.detector, run.scene, SightingKind::kMissed, kNoCase};
  const auto add = [&](SightingKind kind, const std::vector<std::uint64_t>& counts) {
    s.kind = kind;
    if (counts.size() > family.values.size())
      throw InputError("results of " + run.detector + " on " + run.scene + ": more frames than " +
                       "the family has cases");
    for (std::size_t frame = 0; frame < counts.size(); ++frame) {
      s.value = family.values[frame];
      out.possible.insert(s);
      if (counts[frame] != 0) out.seen[s] = counts[frame];
    }
  };
  add(SightingKind::kMissed, run.per_frame.missed);
  add(SightingKind::kSpurious, run.per_frame.spurious);
}

// It would have ended at an earlier case if that were bad too; later cases are unknown.
// @pre kind is kError or kRefused, and the row is `ok` or ended in this way
void add_end(SightingKind kind, const std::vector<std::string>& values, const Run& run,
             SightingsOfRun& out) {
  // The index after the last case if no failed case is recorded.
  const std::size_t ended_case =
      run.ok() ? values.size() : run.failed_frame.value_or(values.size());
  Sighting s{run.detector, run.scene, kind, kNoCase};
  out.possible.insert(s);  // with no case to blame
  for (std::size_t i = 0; i <= ended_case && i < values.size(); ++i) {
    s.value = values[i];
    out.possible.insert(s);
  }
  if (run.ok()) return;
  s.value = ended_case < values.size() ? values[ended_case] : kNoCase;
  out.seen[s] = 1;
}

}  // namespace

const char* name_of(SightingKind kind) {
  switch (kind) {
    case SightingKind::kMissed:
      return "missed";
    case SightingKind::kSpurious:
      return "spurious";
    case SightingKind::kError:
      return "error";
    case SightingKind::kRefused:
      return "refused";
  }
  return "";
}

SightingsOfRun sightings_of(const results::Results& results) {
  const results::Index index(results);
  SightingsOfRun out;
  for (const Run& run : results.runs) {
    const results::Scene* scene = index.scene(run.scene);
    if (scene == nullptr) throw InputError("results have no scene \"" + run.scene + "\"");
    if (!scene->unjudged.empty()) continue;  // no detector was asked
    if (run.ok() || run.status == results::Status::kError)
      add_end(SightingKind::kError,
              scene->family ? scene->family->values : std::vector<std::string>{}, run, out);
    if (!scene->family || !scene->family->range.empty()) continue;
    // A scene that was refused itself has no truth: no detector was asked.
    if (run.ok() || (run.status == results::Status::kRefused && !scene->truth.empty()))
      add_end(SightingKind::kRefused, scene->family->values, run, out);
    if (run.ok() && run.per_frame.level) add_answers(*scene->family, run, out);
  }
  return out;
}

namespace {
using Json = nlohmann::ordered_json;

SightingKind parse_kind(const text::JsonField& field) {
  const std::string name = field.one_of({"missed", "spurious", "error", "refused"});
  for (const SightingKind kind :
       {SightingKind::kMissed, SightingKind::kSpurious, SightingKind::kError})
    if (name == name_of(kind)) return kind;
  return SightingKind::kRefused;
}

// What could say nothing is no entry.
const std::vector<std::string>& members(const text::JsonField& field) {
  if (!field.is(text::JsonValue::Kind::kObject) || field.value().keys.empty())
    field.refuse("an object that is not empty");
  return field.value().keys;
}

// How many pairs in each case of one detector in one scene.
void parse_counts(const text::JsonField& field, Sighting at, CountedSightings& out) {
  if (field.is(text::JsonValue::Kind::kArray))
    field.fail("lists cases without their counts; it must be an object of counts by case");
  constexpr std::size_t kMost = 1'000'000'000'000;
  const bool has_pairs = at.kind == SightingKind::kMissed || at.kind == SightingKind::kSpurious;
  for (const std::string& value : members(field)) {
    at.value = value;
    out[at] = field.at(value).whole(1, has_pairs ? kMost : 1);
  }
}

std::optional<std::string> parse_upstream(const text::JsonField& field) {
  if (field.is(text::JsonValue::Kind::kNull)) return {};
  std::string address = field.text();
  if (address.rfind("https://", 0) != 0)
    field.refuse("the address of an issue, beginning with https://, or null");
  return address;
}

KnownDefect parse_defect(const text::JsonField& field, bool readings) {
  KnownDefect out;
  if (field.is(text::JsonValue::Kind::kObject) && field.has("issue"))
    field.at("issue").fail(
        "is of the list without counts; \"where\" and \"upstream\" must stand in its place");
  if (readings) {
    field.only_keys({"where", "kind", "sentence", "seen"});
    out.library = kOwnLibrary;
    out.version = kOwnVersion;
  } else {
    field.only_keys({"library", "version", "where", "upstream", "kind", "sentence", "seen"});
    out.library = field.at("library").text();
    if (out.is_reading()) field.at("library").refuse("another's; ours stand in readings.json");
    out.version = field.at("version").text();
    out.upstream = parse_upstream(field.at("upstream"));
  }
  out.where = field.at("where").text();
  out.kind = parse_kind(field.at("kind"));
  out.sentence = field.at("sentence").text();
  const text::JsonField seen = field.at("seen");
  for (const std::string& detector : members(seen))
    for (const std::string& scene : members(seen.at(detector)))
      parse_counts(seen.at(detector).at(scene), {detector, scene, out.kind, kNoCase}, out.seen);
  return out;
}

// Refuses two causes for one detector, scene and kind: a new sighting would fit both.
void require_place_of_its_own(const KnownDefect& defect, const KnownDefects& known,
                              const text::JsonField& field) {
  for (const KnownDefect& other : known.defects) {
    if (other.library != defect.library || other.version != defect.version) continue;
    for (const auto& [s, count] : defect.seen)
      if (has_place_for(other, s))
        field.at("seen").fail("names " + s.detector + " in " + s.scene + ", " + name_of(s.kind) +
                              ", which an earlier defect names too");
  }
}

// One line per detector and scene: a change is seen as the lines that changed.
std::string seen_text(const KnownDefect& defect) {
  std::map<std::string, std::map<std::string, Json>> by_place;
  for (const auto& [s, count] : defect.seen) by_place[s.detector][s.scene][s.value] = count;
  std::string detectors;
  for (const auto& [detector, scenes] : by_place) {
    std::string lines;
    for (const auto& [scene, counts] : scenes)
      lines += (lines.empty() ? "" : ",\n") + std::string("      ") + Json(scene).dump() + ": " +
               counts.dump();
    detectors += (detectors.empty() ? "" : ",\n") + std::string("     ") + Json(detector).dump() +
                 ": {\n" + lines + "}";
  }
  return detectors;
}

std::string defect_text(const KnownDefect& d) {
  Json head;
  if (!d.is_reading()) {
    head["library"] = d.library;
    head["version"] = d.version;
  }
  head["where"] = d.where;
  if (!d.is_reading()) head["upstream"] = d.upstream ? Json(*d.upstream) : Json();
  head["kind"] = name_of(d.kind);
  head["sentence"] = d.sentence;
  std::string out = "  {\n";
  for (const auto& [key, value] : head.items())
    out += "   " + Json(key).dump() + ": " + value.dump() + ",\n";
  return out + "   \"seen\": {\n" + seen_text(d) + "}\n  }";
}

// One of the two list files.
struct ListFile {
  const char *name, *key, *what;
  bool readings;
};
constexpr ListFile kFiles[] = {{"known-defects.json", "defects", "known defects", false},
                               {"readings.json", "readings", "expected results", true}};

void read_list(const std::filesystem::path& folder, const ListFile& list, KnownDefects& known) {
  const std::filesystem::path file = folder / list.name;
  if (!std::filesystem::exists(file)) return;
  const std::string document = list.what + (" " + text::in_quotes(file.string()));
  const text::JsonValue value = text::parse_json(text::read_file_bytes(file, list.what), document);
  const text::JsonField root(value, document);
  root.only_keys({list.key});
  for (const text::JsonField& item : root.at(list.key).items()) {
    KnownDefect defect = parse_defect(item, list.readings);
    require_place_of_its_own(defect, known, item);
    known.defects.push_back(std::move(defect));
  }
}

}  // namespace

bool has_place_for(const KnownDefect& defect, const Sighting& sighting) {
  return std::any_of(defect.seen.begin(), defect.seen.end(), [&](const auto& entry) {
    const Sighting& s = entry.first;
    return s.detector == sighting.detector && s.scene == sighting.scene && s.kind == sighting.kind;
  });
}

KnownDefects read_known_defects(const std::filesystem::path& folder) {
  KnownDefects known;
  for (const ListFile& list : kFiles) read_list(folder, list, known);
  known.ranges = read_scale_ranges(folder);
  std::error_code none;
  for (const auto& file : std::filesystem::directory_iterator(folder / "families", none))
    known.families.insert(file.path().stem().string());
  return known;
}

void write_known_defects(const std::filesystem::path& folder, const KnownDefects& known) {
  for (const ListFile& list : kFiles) {
    std::string text;
    for (const KnownDefect& d : known.defects)
      if (d.is_reading() == list.readings) text += (text.empty() ? "" : ",\n") + defect_text(d);
    write_file_atomically(folder / list.name, "{\n " + Json(list.key).dump() + ": [" +
                                                  (text.empty() ? "" : "\n" + text + "\n ") +
                                                  "]\n}\n");
  }
  write_scale_ranges(folder, known.ranges);
}

}  // namespace contactcheck::results
