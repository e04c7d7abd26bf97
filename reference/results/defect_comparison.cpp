#include "reference/results/defect_comparison.h"

#include <algorithm>
#include <set>
#include <utility>

namespace contactcheck::results {
namespace {

std::string version_in(const LibraryVersions& versions, const std::string& library) {
  const auto found = versions.find(library);
  return found == versions.end() ? "" : found->second;
}

DefectComparison::Count compare_one(const KnownDefect& defect, const SightingsOfRun& run,
                                    const LibraryVersions& versions,
                                    std::vector<Sighting>& not_shown) {
  DefectComparison::Count count;
  count.other_version = version_in(versions, defect.library) != defect.version;
  for (const Sighting& s : defect.seen) {
    if (count.other_version || run.possible.count(s) == 0) continue;
    ++count.listed;
    const bool shown = run.seen.count(s) > 0;
    count.shown += shown;
    if (!shown) not_shown.push_back(s);
  }
  return count;
}

std::set<Sighting> listed_for(const KnownDefects& known, const LibraryVersions& versions) {
  std::set<Sighting> out;
  for (const KnownDefect& d : known.defects)
    if (version_in(versions, d.library) == d.version) out.insert(d.seen.begin(), d.seen.end());
  return out;
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

KnownDefect unexplained(const Sighting& s, const LibraryVersions& versions,
                        const LibraryOf& library_of) {
  KnownDefect out;
  out.library = library_of(s.detector);
  out.version = version_in(versions, out.library);
  out.issue = kUnexplained;
  out.kind = s.kind;
  out.sentence = kUnexplained;
  return out;
}

/// Takes sightings into a list, each where it belongs.
class Filing {
 public:
  Filing(KnownDefects& known, const LibraryVersions& versions, const LibraryOf& library_of)
      : known_(known), versions_(versions), library_of_(library_of) {}

  void take_in(const Sighting& s) { defect_for(s).seen.push_back(s); }

 private:
  // Of this version; what another version did has a cause of its own, as far as anyone knows.
  KnownDefect& defect_for(const Sighting& s) {
    const std::string library = library_of_(s.detector);
    const std::string version = version_in(versions_, library);
    const auto same_version = [&](const KnownDefect& d) {
      return d.library == library && d.version == version && d.kind == s.kind;
    };
    for (KnownDefect& d : known_.defects)
      if (same_version(d) && has_place_for(d, s)) return d;
    for (KnownDefect& d : known_.defects)
      if (same_version(d) && d.issue == kUnexplained) return d;
    return known_.defects.emplace_back(unexplained(s, versions_, library_of_));
  }

  KnownDefects& known_;
  const LibraryVersions& versions_;
  const LibraryOf& library_of_;
};

void take_out(const std::vector<Sighting>& gone, KnownDefects& known) {
  const std::set<Sighting> set(gone.begin(), gone.end());
  for (KnownDefect& d : known.defects)
    std::erase_if(d.seen, [&](const Sighting& s) { return set.count(s) > 0; });
  std::erase_if(known.defects, [](const KnownDefect& d) { return d.seen.empty(); });
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
  for (const KnownDefect& d : known.defects)
    out.counts.push_back(compare_one(d, run, versions, out.not_shown));
  const std::set<Sighting> listed = listed_for(known, versions);
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
  Filing filing(out, versions, library_of);
  for (const Sighting& s : comparison.unlisted) filing.take_in(s);
  take_out(comparison.not_shown, out);
  for (KnownDefect& d : out.defects) std::sort(d.seen.begin(), d.seen.end());
  return out;
}

}  // namespace contactcheck::results
