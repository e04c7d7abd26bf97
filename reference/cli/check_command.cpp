#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/deform/recording.h"
#include "core/types/check.h"
#include "reference/cli/command_checks.h"
#include "reference/cli/commands.h"
#include "reference/cli/event_lines.h"
#include "reference/cli/progress_display.h"
#include "reference/cli/run_and_report.h"
#include "reference/judge/frame_check.h"
#include "reference/process/exit_codes.h"
#include "reference/scene/frame_files.h"
#include "reference/text/counted.h"
#include "reference/text/file_text.h"
#include "reference/text/lists.h"
#include "reference/text/shell_word.h"

namespace contactcheck::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using judge::AllowedContact, judge::BadFrame;
using text::counted;

constexpr std::size_t kMostShown = 10;  // frames, on a terminal

AllowedContact allowed_by(const std::vector<std::string>& words) {
  AllowedContact out;
  for (const std::string& word : words) {
    char* end = nullptr;
    if (word == "contact") {
      out.contact = true;
    } else if (word == "self") {
      out.self = true;
    } else if (word.starts_with("depth=") && word.size() > 6) {
      const double depth = std::strtod(word.c_str() + 6, &end);
      if (*end != '\0' || !(depth >= 0.0 && depth <= 1e9))
        throw InputError("--allow " + text::in_quotes(word) + ": a depth is metres from 0 to 1e9");
      out.depth = depth;
    } else {
      throw InputError("--allow " + text::in_quotes(word) +
                       " is not one of contact, self, depth=METRES");
    }
  }
  return out;
}

/// What is said of the frames, to a person or to a program.
class CheckReport {
 public:
  CheckReport(const scene::Scene& scene, const scene::FrameFiles& files, bool json_lines)
      : scene_(scene),
        labels_(files.labels),
        shown_(files.shown),
        unchecked_(files.unchecked),
        json_(json_lines) {}

  void start(const CheckArguments& arguments) const {
    Json bodies = Json::array();
    std::string text;
    for (std::size_t b = 0; b < scene_.bodies.size(); ++b) {
      const TriangleMesh& mesh = scene_.bodies[b].shape->mesh;
      bodies.push_back({{"name", scene_.bodies[b].name},
                        {"vertices", mesh.vertices.size()},
                        {"triangles", mesh.triangles.size()}});
      text += scene_.bodies[b].name + ": " + std::to_string(mesh.triangles.size()) + " triangles" +
              (b < shown_.size() ? ", " + shown_[b] : "") +
              (scene_.origins[b].notes.empty() ? "" : "; " + scene_.origins[b].notes) + "\n";
    }
    if (json_) {
      print({{"event", "start"},
             {"schema", "contactcheck-events/1"},
             {"version", CONTACTCHECK_VERSION},
             {"out", arguments.out.string()},
             {"frames", scene_.frames},
             {"unchecked", unchecked_},
             {"bodies", bodies}});
    } else {
      if (!unchecked_.empty()) text += unchecked_text();
      std::printf("%s%s\n", text.c_str(), counted(scene_.frames, "frame").c_str());
    }
  }

  void frame(const BadFrame& bad) {
    ++bad_;
    if (!first_) {
      first_ = bad.frame;
      first_words_ = bad.pairs.empty() ? sentence(bad.selfs.front()) : sentence(bad.pairs.front());
    }
    for (const BadFrame::Pair& pair : bad.pairs) {
      if (pair.depth.unknown)
        unknown_depth_ = true;
      else if (pair.depth.lower > 0.0 &&
               (!deepest_ || pair.depth.upper > deepest_->second.depth.upper))
        deepest_ = {bad.frame, pair};
    }
    if (json_) return print(json_of(bad));
    if (bad_ > kMostShown) return;
    std::printf("\n%s\n", place(bad.frame).c_str());
    for (const BadFrame::Pair& pair : bad.pairs) std::printf("  %s\n", sentence(pair).c_str());
    for (const BadFrame::Self& self : bad.selfs) std::printf("  %s\n", sentence(self).c_str());
    std::fflush(stdout);
  }

  std::size_t bad_frames() const { return bad_; }
  /// For the page. @pre bad_frames() > 0
  results::Finding finding() const { return {count_text(), place(*first_) + ", " + first_words_}; }
  std::optional<std::size_t> first() const { return first_; }

  /// `open`: see FrameChecker.
  void end(const CheckArguments& arguments, const judge::OpenBodies& open, int exit_code,
           const std::string& page) const {
    Json not_judged = Json::array();
    std::string not_judged_text;
    for (const auto& [body, why] : open) {
      not_judged.push_back({{"body", name(body)}, {"level", "containment"}, {"reason", why}});
      not_judged_text += name(body) + ": containment and depth in it not judged: " + why + "\n";
    }
    if (json_)
      return print({{"event", "end"},
                    {"out", arguments.out.string()},
                    {"bad_frames", bad_},
                    {"first", first_ ? Json(*first_) : Json(nullptr)},
                    {"not_judged", not_judged},
                    {"exit_code", exit_code}});
    if (bad_ > kMostShown)
      std::printf("\n... and %s\n", counted(bad_ - kMostShown, "more frame").c_str());
    if (bad_ == 0) std::printf("no frame has a contact that is not allowed\n");
    std::printf("%s", not_judged_text.c_str());
    if (bad_ == 0) return;
    std::printf("\n%s, the first is %s\n", count_text().c_str(), place(*first_).c_str());
    if (deepest_)
      std::printf("%s: %s, %s\n", unknown_depth_ ? "deepest of known depth" : "deepest",
                  place(deepest_->first).c_str(), sentence(deepest_->second).c_str());
    std::printf("%s shows it\n", page.c_str());
  }

 private:
  static void print(const Json& event) { EventLines(true).print(event.dump()); }

  std::string count_text() const {
    return std::to_string(bad_) + " of " + counted(scene_.frames, "frame") +
           (bad_ == 1 ? " has" : " have") + " a contact that is not allowed";
  }
  std::string place(std::size_t frame) const {
    return "frame " + std::to_string(frame) +
           (frame < labels_.size() ? " (" + labels_[frame] + ")" : "");
  }
  std::string unchecked_text() const {
    constexpr std::size_t kMostNamed = 4;
    return "not checked, because not every body has that frame: " +
           text::first_joined(unchecked_, kMostNamed) +
           (unchecked_.size() > kMostNamed
                ? " and " + counted(unchecked_.size() - kMostNamed, "more file")
                : "") +
           "\n";
  }
  const std::string& name(std::uint32_t body) const { return scene_.bodies[body].name; }

  static std::string pairs_text(std::size_t pairs, const std::array<std::uint32_t, 2>& first) {
    return counted(pairs, "pair") + " of triangles, first " + std::to_string(first[0]) + " and " +
           std::to_string(first[1]);
  }

  std::string sentence(const BadFrame::Pair& pair) const {
    std::string out = name(pair.bodies.a) + " and " + name(pair.bodies.b) + ": ";
    out += pair.first ? pairs_text(pair.triangles, *pair.first) : "one is inside the other";
    return out + ", " + depth_text(pair.depth);
  }

  std::string depth_text(const oracle::SurfaceDepth& depth) const {
    if (depth.unknown)
      return "depth unknown: " + name(depth.unknown->body) + ": " +
             oracle::describe(depth.unknown->fault,
                              scene_.bodies[depth.unknown->body].shape->given);
    const auto [factor, unit] =
        depth.upper < 1.0 ? std::pair(1e3, " mm deep") : std::pair(1.0, " m deep");
    const std::string upper = fmt::format("{:.3g}", factor * depth.upper) + unit;
    // Three digits say no more than an interval of a thousandth does.
    if (depth.upper - depth.lower <= 1e-3 * depth.upper) return upper;
    if (depth.lower == 0.0) return "at most " + upper;
    return fmt::format("{:.3g} to ", factor * depth.lower) + upper;
  }

  std::string sentence(const BadFrame::Self& self) const {
    std::size_t all = 0;
    std::string classes;
    for (const auto& [level, count] : self.pairs) {
      all += count;
      classes += (classes.empty() ? "" : ", ") + std::to_string(count) +
                 (level == Level::kSelf         ? " without a shared vertex"
                  : level == Level::kSelfVertex ? " that share a corner"
                                                : " that share an edge");
    }
    return name(self.body) + " with itself: " + pairs_text(all, self.first) + " (" + classes + ")";
  }

  static Json depth_json(const oracle::SurfaceDepth& depth) {
    if (depth.unknown) return nullptr;
    return {{"lower", depth.lower}, {"upper", depth.upper}};
  }

  Json unknown_json(const oracle::SurfaceDepth& depth) const {
    if (!depth.unknown) return nullptr;
    const auto& [body, fault] = *depth.unknown;
    Json out = {{"body", name(body)}, {"reason", oracle::name_of(fault.kind)}};
    if (fault.kind == oracle::NotSimple::kOpen) out["edge"] = {fault.edge.from, fault.edge.to};
    return out;
  }

  Json json_of(const BadFrame& bad) const {
    Json contacts = Json::array(), selfs = Json::array();
    for (const BadFrame::Pair& pair : bad.pairs)
      contacts.push_back({{"bodies", {name(pair.bodies.a), name(pair.bodies.b)}},
                          {"triangle_pairs", pair.triangles},
                          {"first", pair.first ? Json(*pair.first) : Json(nullptr)},
                          {"depth", depth_json(pair.depth)},
                          {"depth_unknown", unknown_json(pair.depth)}});
    for (const BadFrame::Self& self : bad.selfs) {
      Json one = {{"body", name(self.body)}};
      for (const Level level : kSelfClasses)
        one[name_of(level)] = self.pairs.contains(level) ? self.pairs.at(level) : 0;
      one["first"] = self.first;
      selfs.push_back(std::move(one));
    }
    return {{"event", "frame"},
            {"frame", bad.frame},
            {"file", bad.frame < labels_.size() ? Json(labels_[bad.frame]) : Json(nullptr)},
            {"contacts", std::move(contacts)},
            {"self", std::move(selfs)}};
  }

  const scene::Scene& scene_;
  std::vector<std::string> labels_, shown_, unchecked_;
  bool json_;
  std::size_t bad_ = 0;
  std::optional<std::size_t> first_;
  std::string first_words_;
  std::optional<std::pair<std::size_t, BadFrame::Pair>> deepest_;  // of known depth above 0
  bool unknown_depth_ = false;                                     // of any pair
};

// The levels that are left to be judged.
std::vector<Level> levels_of(const AllowedContact& allowed) {
  std::vector<Level> levels;
  for (const Level level : {Level::kBody, Level::kContainment, Level::kTriangle})
    if (!allowed.contact) levels.push_back(level);
  for (const Level level : {Level::kSelf, Level::kSelfVertex, Level::kSelfEdge, Level::kSelfBody})
    if (!allowed.self) levels.push_back(level);
  return levels;
}

/// The page about one frame: a run of its own, on a recording of it. Returns its path; a build
/// without npm has no page, but a report.
fs::path write_page(const CheckArguments& arguments, const scene::Scene& scene,
                    const std::string& files, std::size_t frame, results::Finding finding,
                    const DetectorCatalog& catalog) {
  Recording recording;
  recording.scene = "frame-" + std::to_string(frame);
  recording.bodies = scene.bodies;
  recording.time_step = scene.time_step;
  recording.levels = scene.levels;
  recording.frames = {scene.nodes_of_frame(frame)};
  const fs::path file = arguments.out / (recording.scene + ".ccr");
  write_recording(file, recording);
  RunArguments run;
  run.targets = {file.string()};
  run.detectors = {judge::kFrameDetector};
  run.timing = false;
  run.quiet = true;
  run.finding = std::move(finding);
  run.out = arguments.out;
  run.command_line = "contactcheck check" + files + (arguments.weld ? " --weld" : "") +
                     (arguments.rules.repair ? " --repair" : "");
  for (const std::string& pattern : arguments.rules.patterns)
    run.command_line += " --frames " + text::in_shell(pattern);
  if (!arguments.rules.cache_space.empty())
    run.command_line += " --cache-space " + arguments.rules.cache_space;
  for (const std::string& word : arguments.allow)
    run.command_line += " --allow " + text::in_shell(word);
  suite::SuiteOutcome outcome;
  run_and_report(run, catalog, &outcome);
  const fs::path page = arguments.out / "report.html";
  return fs::exists(page) ? page : arguments.out / "report.md";
}

}  // namespace

int check_command(const CheckArguments& arguments, const DetectorCatalog& catalog) {
  const AllowedContact allowed = allowed_by(arguments.allow);
  const std::vector<Level> levels = levels_of(allowed);
  if (levels.empty())
    throw InputError("--allow contact and --allow self leave nothing to be checked");
  check_out(arguments.out);
  scene::FrameFiles files;
  scene::Scene scene;
  if (arguments.frames.size() == 1 && arguments.frames[0].extension() == ".ccr") {
    scene = scene::load_any_scene(arguments.frames[0]);
  } else {
    files = scene::frame_files(arguments.frames, arguments.rules, "check", levels);
    scene = scene::load_scene_text(files.scene);
  }
  scene.levels = levels;
  if (scene.bodies.size() == 1)
    std::erase_if(scene.levels, [](Level level) { return !is_self(level); });
  if (scene.levels.empty())
    throw InputError("--allow self leaves nothing to be checked of one body");
  if (arguments.weld) scene::weld(scene);
  scene::refuse_crowded_vertices(scene);

  CheckReport report(scene, files, arguments.json_lines);
  report.start(arguments);
  judge::FrameChecker checker(scene, allowed, catalog);
  ProgressDisplay display(arguments.quiet || isatty(STDERR_FILENO) == 0, true);
  EventLines events(arguments.json_lines);
  const auto start = std::chrono::steady_clock::now();
  for (std::size_t f = 0; f < scene.frames; ++f) {
    suite::SuiteProgress progress{0,
                                  1,
                                  scene.id,
                                  judge::kFrameDetector,
                                  static_cast<std::uint32_t>(f),
                                  scene.frames,
                                  static_cast<double>(f) / static_cast<double>(scene.frames)};
    const double elapsed =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const std::optional<double> left = seconds_left(elapsed, 0.0, progress.share);
    display.show(progress, left);
    if (events.wanted()) events.progress(progress, left);
    if (const std::optional<BadFrame> bad = checker.check(f)) {
      display.finish();
      report.frame(*bad);
    }
  }
  display.finish();
  fs::path page;
  if (report.first()) {
    std::string words =
        files.shown.empty() ? " " + text::in_shell(arguments.frames[0].string()) : "";
    for (const std::string& word : files.shown) words += " " + word;
    page = write_page(arguments, scene, words, *report.first(), report.finding(), catalog);
  }
  const int code = report.bad_frames() > 0 ? 1 : 0;
  report.end(arguments, checker.open(), code, page.string());
  return code;
}

}  // namespace contactcheck::cli
