#include "reference/results/defect_comparison.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

namespace contactcheck::results {
namespace {

std::string version_in(const LibraryVersions& versions, const std::string& library) {
  const auto found = versions.find(library);
  return found == versions.end() ? "" : found->second;
}

template <typename Name>
std::vector<std::string> names_of(const KnownDefect& defect, Name name) {
  std::set<std::string> names;
  for (const Sighting& s : defect.seen) names.insert(name(s));
  return {names.begin(), names.end()};
}

// Values of one detector, scene and kind together, in the order of the list.
std::vector<results::Sightings> grouped(const std::vector<Sighting>& sightings) {
  std::vector<results::Sightings> out;
  for (const Sighting& s : sightings) {
    auto same = std::find_if(out.begin(), out.end(), [&](const results::Sightings& group) {
      return group.detector == s.detector && group.scene == s.scene &&
             group.kind == name_of(s.kind);
    });
    if (same == out.end()) same = out.insert(out.end(), {s.detector, s.scene, name_of(s.kind), {}});
    same->values.push_back(s.value);
  }
  return out;
}

// The entry that the sighting belongs to, added where there is none. Entries of other versions are
// left alone: their cause may be another.
KnownDefect& defect_for(const Sighting& s, const LibraryVersions& versions,
                        const LibraryOf& library_of, KnownDefects& known) {
  KnownDefect unexplained;
  unexplained.library = library_of(s.detector);
  unexplained.version = version_in(versions, unexplained.library);
  unexplained.issue = kUnexplained;
  unexplained.kind = s.kind;
  unexplained.sentence = kUnexplained;
  const auto same_version = [&](const KnownDefect& d) {
    return d.library == unexplained.library && d.version == unexplained.version && d.kind == s.kind;
  };
  for (KnownDefect& d : known.defects)
    if (same_version(d) && has_place_for(d, s)) return d;
  for (KnownDefect& d : known.defects)
    if (same_version(d) && d.issue == kUnexplained) return d;
  return known.defects.emplace_back(std::move(unexplained));
}

}  // namespace

LibraryVersions versions_in(const results::Results& results) {
  LibraryVersions versions = {{"contactcheck", "any"}};
  for (const auto& [library, version] : results.libraries) versions[library] = version;
  return versions;
}

DefectComparison compare_defects(const KnownDefects& known, const SightingsOfRun& run,
                                 const LibraryVersions& versions) {
  DefectComparison out;
  std::set<Sighting> listed;
  for (const KnownDefect& d : known.defects) {
    DefectComparison::Count& count = out.counts.emplace_back();
    count.other_version = version_in(versions, d.library) != d.version;
    if (count.other_version) continue;
    listed.insert(d.seen.begin(), d.seen.end());
    for (const Sighting& s : d.seen) {
      if (run.possible.count(s) == 0) continue;
      ++count.listed;
      const bool shown = run.seen.count(s) > 0;
      count.shown += shown;
      if (!shown) out.not_shown.push_back(s);
    }
  }
  std::set_difference(run.seen.begin(), run.seen.end(), listed.begin(), listed.end(),
                      std::back_inserter(out.unlisted));
  return out;
}

bool any_unlisted_error(const DefectComparison& comparison) {
  return std::any_of(comparison.unlisted.begin(), comparison.unlisted.end(),
                     [](const Sighting& s) { return s.kind == SightingKind::kError; });
}

DefectCounts in_results(const KnownDefects& known, const DefectComparison& comparison) {
  DefectCounts out;
  for (std::size_t i = 0; i < known.defects.size(); ++i) {
    const KnownDefect& d = known.defects[i];
    const DefectComparison::Count& count = comparison.counts[i];
    out.defects.push_back({d.library, d.version, d.issue, name_of(d.kind), d.sentence,
                           names_of(d, [](const Sighting& s) { return s.detector; }),
                           names_of(d, [](const Sighting& s) { return s.scene; }), count.listed,
                           count.shown, count.other_version});
  }
  out.not_shown = grouped(comparison.not_shown);
  out.unlisted = grouped(comparison.unlisted);
  return out;
}

KnownDefects updated(const KnownDefects& known, const SightingsOfRun& run,
                     const LibraryVersions& versions, const LibraryOf& library_of) {
  const DefectComparison comparison = compare_defects(known, run, versions);
  KnownDefects out = known;
  for (const Sighting& s : comparison.unlisted)
    defect_for(s, versions, library_of, out).seen.push_back(s);
  const std::set<Sighting> gone(comparison.not_shown.begin(), comparison.not_shown.end());
  for (KnownDefect& d : out.defects) {
    std::erase_if(d.seen, [&](const Sighting& s) { return gone.count(s) > 0; });
    std::sort(d.seen.begin(), d.seen.end());
  }
  std::erase_if(out.defects, [](const KnownDefect& d) { return d.seen.empty(); });
  return out;
}

}  // namespace contactcheck::results
