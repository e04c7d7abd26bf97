#include "reference/check/check_page.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

#include "core/deform/recording.h"
#include "reference/report/formats/html.h"
#include "reference/report/formats/view_bytes.h"
#include "reference/text/counted.h"

namespace contactcheck::check {
namespace {

using text::counted;

constexpr const char* kScene = "check";

/// What of a step or frame stands at one frame of the view.
struct Shown {
  std::vector<std::size_t> frames;
  Json truth = Json::array(), words = Json::array();
};

// Sentences of a step's contacts that are found, without what all of them say.
std::vector<std::string> step_words(const CheckedFrame& frame) {
  const std::string paths = std::string(", ") + kPaths;
  std::vector<std::string> out;
  for (std::size_t i = 0; i < frame.step.words.size(); ++i) {
    if (!frame.step.found[i]) continue;
    std::string words = frame.step.words[i];
    if (words.ends_with(paths)) words.resize(words.size() - paths.size());
    if (frame.step.event.at("contacts").at(i).at("allowed").get<bool>()) words += ", allowed";
    out.push_back(std::move(words));
  }
  return out;
}

// The marks and sentences of each of these frames: its own contacts, and those of steps that begin
// or end there.
Shown marked(const CheckSummary& summary, std::vector<std::size_t> frames) {
  Shown out;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    FlatPairs pairs;
    std::vector<std::string> words;
    const auto add = [&](const FlatPairs& marks, const std::string& begin,
                         const std::vector<std::string>& sentences) {
      pairs.insert(pairs.end(), marks.begin(), marks.end());
      for (const std::string& sentence : sentences) words.push_back(begin + sentence);
    };
    for (const CheckedFrame& frame : summary.listed()) {
      const std::size_t f = frame.frame;
      if (f == frames[i]) add(frame.here.pairs, "", frame.here.words);
      if ((f == frames[i] || f == frames[i] + 1) && frame.found_in_step())
        add(frame.step.pairs,
            "from frame " + std::to_string(f - 1) + " to " + std::to_string(f) + ", ",
            step_words(frame));
    }
    constexpr std::size_t kMostWords = 5;
    if (words.size() > kMostWords) {
      const std::size_t more = words.size() - kMostWords;
      words.resize(kMostWords);
      words.push_back("and " + counted(more, "more contact"));
    }
    out.truth.push_back({{"frame", i}, {"count", pairs.size() / 4}, {"pairs", std::move(pairs)}});
    out.words.push_back(std::move(words));
  }
  out.frames = std::move(frames);
  return out;
}

std::string view_of(const scene::Scene& scene, const Shown& shown) {
  Recording recording{kScene, scene.bodies, scene.time_step, {}, {}};
  for (const std::size_t frame : shown.frames)
    recording.frames.push_back(scene.nodes_of_frame(frame));
  return report::view_bytes(recording, {{"truth", shown.truth}, {"detectors", Json::array()}},
                            kPageView);
}

Json contact_rows(const CheckSummary& summary, const FrameWords& words,
                  const std::vector<std::size_t>& shown, std::size_t& more) {
  Json out = Json::array();
  const auto add = [&](const std::string& place, std::size_t frame, const std::string& sentence) {
    if (out.size() == kPageContacts) {
      ++more;
      return;
    }
    const auto at = std::ranges::find(shown, frame);
    out.push_back({{"place", place},
                   {"words", sentence},
                   {"at", at == shown.end() ? Json(nullptr) : Json(at - shown.begin())}});
  };
  for (const CheckedFrame& frame : summary.listed()) {
    for (const std::string& sentence : step_words(frame))
      add(words.places(frame.frame - 1), frame.frame - 1, sentence);
    for (const std::string& sentence : frame.here.words)
      add(words.place(frame.frame), frame.frame, sentence);
  }
  return out;
}

/// What is drawn over the frames.
struct Series {
  Json pairs = Json::array(), depths = Json::array(), unknown = Json::array(),
       steps = Json::array();
};

Series series_of(const CheckSummary& summary) {
  Series out;
  for (const CheckedFrame& frame : summary.listed()) {
    if (frame.found_in_step()) out.steps.push_back(frame.frame - 1);
    if (frame.here.empty()) continue;
    std::size_t pairs = 0;
    double lower = 0.0, upper = 0.0;
    bool known = false, unknown = false;
    for (const Json& c : frame.here.event.at("contacts")) {
      pairs += c.at("triangle_pairs").get<std::size_t>();
      const Json& depth = c.at("depth");
      unknown |= depth.is_null();
      if (depth.is_null() || depth.at("upper").get<double>() < upper) continue;
      known = true;
      lower = depth.at("lower").get<double>();
      upper = depth.at("upper").get<double>();
    }
    for (const Json& self : frame.here.event.at("self"))
      for (const Level level : kSelfClasses) pairs += self.at(name_of(level)).get<std::size_t>();
    out.pairs.push_back({frame.frame, pairs});
    if (known) out.depths.push_back({frame.frame, 1e3 * lower, 1e3 * upper});
    if (unknown) out.unknown.push_back(frame.frame);
  }
  return out;
}

Json bodies_json(const scene::Scene& scene, const std::vector<std::string>& shown) {
  Json out = Json::array();
  for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    out.push_back({scene.bodies[b].name,
                   std::to_string(scene.bodies[b].shape->mesh.triangles.size()),
                   b < shown.size() ? shown[b] : "", scene.origins[b].notes});
  return out;
}

}  // namespace

std::vector<std::size_t> shown_frames(const CheckSummary& summary, std::size_t most) {
  // Of a step both ends; what is worst and what is first in any case.
  std::vector<std::set<std::size_t>> places;
  std::set<std::size_t> out;
  for (const CheckedFrame& frame : summary.listed()) {
    std::set<std::size_t> place;
    if (!frame.here.empty()) place.insert(frame.frame);
    if (frame.found_in_step()) place.insert({frame.frame - 1, frame.frame});
    if (place.empty()) continue;
    if (places.empty() || frame.frame == summary.deepest()) out.insert(place.begin(), place.end());
    places.push_back(std::move(place));
  }
  // Every k-th, with the least k for which they are few enough.
  for (std::size_t step = 1; step <= places.size(); ++step) {
    std::set<std::size_t> all = out;
    for (std::size_t i = 0; i < places.size(); i += step)
      all.insert(places[i].begin(), places[i].end());
    if (all.size() > most) continue;
    out = std::move(all);
    break;
  }
  // Where even first and deepest are too many: of the first what there is room for.
  if (out.size() > most) out = places.front();
  while (out.size() > most) out.erase(std::prev(out.end()));
  return {out.begin(), out.end()};
}

std::string check_page(const scene::Scene& scene, const FrameWords& words,
                       const CheckSummary& summary, const std::string& command,
                       const std::vector<std::string>& files) {
  const std::size_t all = shown_frames(summary, scene.frames).size();
  Shown view;
  std::string bytes;
  // Large meshes: fewer frames, down to one.
  for (std::size_t most = kShownFrames; most > 0 && bytes.empty() && all > 0; most /= 2) {
    view = marked(summary, shown_frames(summary, most));
    bytes = view_of(scene, view);
  }
  if (bytes.empty()) view = {};
  std::size_t more = 0;
  Json rows = contact_rows(summary, words, view.frames, more);
  Series series = series_of(summary);
  Json findings = Json::array(), names = Json::array();
  for (const report::HeadlineFinding& topic : summary.findings())
    findings.push_back({{"topic", topic.topic}, {"sentence", topic.sentence}});
  for (const std::size_t frame : view.frames) names.push_back(words.place(frame));
  const std::string note = all == 0        ? ""
                           : bytes.empty() ? "The meshes are too large for this page."
                           : view.frames.size() < all
                               ? std::to_string(view.frames.size()) + " of " +
                                     counted(all, "frame") +
                                     " with contacts in them or next to them: the first, the "
                                     "deepest and others evenly. `--keep FRAME` writes any frame "
                                     "as a recording."
                               : "";
  const Json page = {{"version", CONTACTCHECK_VERSION},
                     {"title", summary.title()},
                     {"findings", std::move(findings)},
                     {"run", "`" + command + "`"},
                     {"parts", Json::array()},
                     {"frames", scene.frames},
                     {"bodies", bodies_json(scene, files)},
                     {"contacts", std::move(rows)},
                     {"more", more},
                     {"pairs", std::move(series.pairs)},
                     {"depths", std::move(series.depths)},
                     {"unknown", std::move(series.unknown)},
                     {"steps", std::move(series.steps)},
                     {"view", {{"names", std::move(names)}, {"words", std::move(view.words)}}},
                     {"view_note", note},
                     {"paths", summary.found_steps() > 0 ? kPaths : ""}};
  return report::html_page(page.dump(-1, ' ', false, Json::error_handler_t::replace), bytes);
}

}  // namespace contactcheck::check
