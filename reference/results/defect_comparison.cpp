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
  for (const auto& [s, count] : defect.seen) names.insert(name(s));
  return {names.begin(), names.end()};
}

// Values of one detector, scene and kind together, in the order of the list.
std::vector<results::Sightings> grouped(const DefectComparison::Changes& changes) {
  std::vector<results::Sightings> out;
  for (const auto& [s, change] : changes) {
    if (out.empty() || out.back().detector != s.detector || out.back().scene != s.scene ||
        out.back().kind != name_of(s.kind))
      out.push_back({s.detector, s.scene, name_of(s.kind), {}, {}, {}});
    out.back().values.push_back(s.value);
    if (change.was > 0) out.back().was.push_back(change.was);
    if (change.is > 0) out.back().is.push_back(change.is);
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
  unexplained.where = kUnexplained;
  unexplained.kind = s.kind;
  unexplained.sentence = kUnexplained;
  const auto same_version = [&](const KnownDefect& d) {
    return d.library == unexplained.library && d.version == unexplained.version && d.kind == s.kind;
  };
  for (KnownDefect& d : known.defects)
    if (same_version(d) && has_place_for(d, s)) return d;
  for (KnownDefect& d : known.defects)
    if (same_version(d) && d.where == kUnexplained) return d;
  return known.defects.emplace_back(std::move(unexplained));
}

}  // namespace

LibraryVersions versions_in(const results::Results& results) {
  LibraryVersions versions = {{kOwnLibrary, kOwnVersion}};
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
    count.possible = std::any_of(d.seen.begin(), d.seen.end(), [&](const auto& entry) {
      return run.possible.contains(entry.first);
    });
    if (count.other_version) continue;
    for (const auto& [s, was] : d.seen) {
      listed.insert(s);
      if (run.possible.count(s) == 0) continue;
      ++count.listed;
      const auto shown = run.seen.find(s);
      if (shown == run.seen.end()) {
        out.not_shown[s] = {was, 0};
        continue;
      }
      ++count.shown;
      if (shown->second == was) continue;
      ++count.changed;
      out.changed[s] = {was, shown->second};
    }
  }
  for (const auto& [s, is] : run.seen)
    if (listed.count(s) == 0) out.unlisted[s] = {0, is};
  return out;
}

bool any_unlisted_error(const DefectComparison& comparison) {
  return std::any_of(comparison.unlisted.begin(), comparison.unlisted.end(),
                     [](const auto& entry) { return entry.first.kind == SightingKind::kError; });
}

DefectCounts in_results(const KnownDefects& known, const DefectComparison& comparison) {
  DefectCounts out;
  for (std::size_t i = 0; i < known.defects.size(); ++i) {
    const KnownDefect& d = known.defects[i];
    const DefectComparison::Count& count = comparison.counts[i];
    if (!count.possible) continue;
    (d.is_reading() ? out.readings : out.defects)
        .push_back({d.library, d.version, d.where, d.upstream.value_or(""), name_of(d.kind),
                    d.sentence, names_of(d, [](const Sighting& s) { return s.detector; }),
                    names_of(d, [](const Sighting& s) { return s.scene; }), count.listed,
                    count.shown, count.changed, count.other_version});
  }
  out.changed = grouped(comparison.changed);
  out.not_shown = grouped(comparison.not_shown);
  out.unlisted = grouped(comparison.unlisted);
  return out;
}

KnownDefects updated(const KnownDefects& known, const SightingsOfRun& run,
                     const LibraryVersions& versions, const LibraryOf& library_of) {
  const DefectComparison comparison = compare_defects(known, run, versions);
  KnownDefects out = known;
  for (const auto& [s, change] : comparison.unlisted)
    defect_for(s, versions, library_of, out).seen[s] = change.is;
  for (KnownDefect& d : out.defects) {
    if (version_in(versions, d.library) != d.version) continue;
    for (auto& [s, count] : d.seen)
      if (const auto change = comparison.changed.find(s); change != comparison.changed.end())
        count = change->second.is;
    std::erase_if(d.seen,
                  [&](const auto& entry) { return comparison.not_shown.contains(entry.first); });
  }
  std::erase_if(out.defects, [](const KnownDefect& d) { return d.seen.empty(); });
  return out;
}

}  // namespace contactcheck::results
