#include "reference/results/known_defects.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/deform/atomic_file.h"
#include "core/types/check.h"
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
      if (counts[frame] != 0) out.seen.insert(s);
    }
  };
  add(SightingKind::kMissed, run.per_frame.missed);
  add(SightingKind::kSpurious, run.per_frame.spurious);
}

// It would have failed at an earlier case, were that one bad too; of the later ones nobody knows.
void add_errors(const std::vector<std::string>& values, const Run& run, SightingsOfRun& out) {
  const bool failed = run.status == results::Status::kError;
  // Behind the last case where none is known.
  const std::size_t failed_case = failed ? run.failed_frame.value_or(values.size()) : values.size();
  Sighting s{run.detector, run.scene, SightingKind::kError, kNoCase};
  out.possible.insert(s);  // with no case to blame
  for (std::size_t i = 0; i <= failed_case && i < values.size(); ++i) {
    s.value = values[i];
    out.possible.insert(s);
  }
  if (!failed) return;
  s.value = failed_case < values.size() ? values[failed_case] : kNoCase;
  out.seen.insert(s);
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
      add_errors(scene->family ? scene->family->values : std::vector<std::string>{}, run, out);
    if (run.ok() && scene->family && run.per_frame.level) add_answers(*scene->family, run, out);
  }
  return out;
}

namespace {
using Json = nlohmann::ordered_json;

SightingKind parse_kind(const text::JsonField& field) {
  const std::string name = field.one_of({"missed", "spurious", "error"});
  for (const SightingKind kind : {SightingKind::kMissed, SightingKind::kSpurious})
    if (name == name_of(kind)) return kind;
  return SightingKind::kError;
}

// The values of one detector in one scene; ["-"] where the scene has no parameter.
void parse_values(const text::JsonField& field, Sighting at, std::vector<Sighting>& out) {
  for (const text::JsonField& item : field.items(1)) {
    at.value = item.text();
    if (std::find(out.begin(), out.end(), at) != out.end()) item.refuse("named once only");
    out.push_back(at);
  }
}

KnownDefect parse_defect(const text::JsonField& field) {
  field.only_keys({"library", "version", "issue", "kind", "sentence", "seen"});
  KnownDefect out;
  out.library = field.at("library").text();
  out.version = field.at("version").text();
  out.issue = field.at("issue").text();
  out.kind = parse_kind(field.at("kind"));
  out.sentence = field.at("sentence").text();
  const text::JsonField seen = field.at("seen");
  for (const std::string& detector : seen.value().keys)
    for (const std::string& scene : seen.at(detector).value().keys)
      parse_values(seen.at(detector).at(scene), {detector, scene, out.kind, kNoCase}, out.seen);
  std::sort(out.seen.begin(), out.seen.end());
  return out;
}

// Otherwise nobody could say which of two causes a new sighting has.
void require_place_of_its_own(const KnownDefect& defect, const KnownDefects& known,
                              const text::JsonField& field) {
  for (const KnownDefect& other : known.defects) {
    if (other.library != defect.library || other.version != defect.version) continue;
    for (const Sighting& s : defect.seen)
      if (has_place_for(other, s))
        field.at("seen").fail("names " + s.detector + " in " + s.scene + ", " + name_of(s.kind) +
                              ", which an earlier defect names too");
  }
}

using Values = std::vector<std::string>;

std::map<std::string, std::map<std::string, Values>> by_place(const KnownDefect& defect) {
  std::map<std::string, std::map<std::string, Values>> out;
  for (const Sighting& s : defect.seen) out[s.detector][s.scene].push_back(s.value);
  return out;
}

// One line per detector and scene: a change is seen as the lines that changed.
std::string seen_text(const KnownDefect& defect) {
  std::string detectors;
  for (const auto& [detector, scenes] : by_place(defect)) {
    std::string lines;
    for (const auto& [scene, values] : scenes)
      lines += (lines.empty() ? "" : ",\n") + std::string("      ") + Json(scene).dump() + ": " +
               Json(values).dump();
    detectors += (detectors.empty() ? "" : ",\n") + std::string("     ") + Json(detector).dump() +
                 ": {\n" + lines + "}";
  }
  return detectors;
}

std::string defect_text(const KnownDefect& d) {
  const Json head = {{"library", d.library},
                     {"version", d.version},
                     {"issue", d.issue},
                     {"kind", name_of(d.kind)},
                     {"sentence", d.sentence}};
  std::string out = "  {\n";
  for (const auto& [key, value] : head.items())
    out += "   " + Json(key).dump() + ": " + value.dump() + ",\n";
  return out + "   \"seen\": {\n" + seen_text(d) + "}\n  }";
}

}  // namespace

bool has_place_for(const KnownDefect& defect, const Sighting& sighting) {
  return std::any_of(defect.seen.begin(), defect.seen.end(), [&](const Sighting& s) {
    return s.detector == sighting.detector && s.scene == sighting.scene && s.kind == sighting.kind;
  });
}

KnownDefects read_known_defects(const std::filesystem::path& file) {
  KnownDefects known;
  if (!std::filesystem::exists(file)) return known;
  const std::string document = "known defects " + text::in_quotes(file.string());
  const text::JsonValue value =
      text::parse_json(text::read_file_bytes(file, "known defects"), document);
  const text::JsonField root(value, document);
  root.only_keys({"defects"});
  for (const text::JsonField& item : root.at("defects").items()) {
    KnownDefect defect = parse_defect(item);
    require_place_of_its_own(defect, known, item);
    known.defects.push_back(std::move(defect));
  }
  return known;
}

void write_known_defects(const std::filesystem::path& file, const KnownDefects& known) {
  std::string text;
  for (const KnownDefect& d : known.defects) text += (text.empty() ? "" : ",\n") + defect_text(d);
  write_file_atomically(file, "{\n \"defects\": [\n" + text + "\n ]\n}\n");
}

}  // namespace contactcheck::results
