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
#include "reference/cli/step_report.h"
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
using judge::AllowedContact, judge::BadFrame, judge::StepContact;
using text::counted;

Allowed allowed_by(const std::vector<std::string>& words) {
  Allowed out;
  for (const std::string& word : words) {
    char* end = nullptr;
    if (word == "contact") {
      out.contact = true;
    } else if (word == "self") {
      out.self = true;
    } else if (word == "impact") {
      out.impact = true;
    } else if (word.starts_with("depth=") && word.size() > 6) {
      const double depth = std::strtod(word.c_str() + 6, &end);
      if (*end != '\0' || !(depth >= 0.0 && depth <= 1e9))
        throw InputError("--allow " + text::in_quotes(word) + ": a depth is metres from 0 to 1e9");
      out.depth = depth;
    } else {
      throw InputError("--allow " + text::in_quotes(word) +
                       " is not one of contact, self, depth=METRES, impact");
    }
  }
  return out;
}

/// What is said of the frames, to a person or to a program.
class CheckReport {
 public:
  CheckReport(const scene::Scene& scene, const scene::FrameFiles& files, const FrameNames& frames,
              bool json_lines)
      : scene_(scene),
        frames_(frames),
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
      print_event({{"event", "start"},
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
    if (json_) return print_event(json_of(bad));
    if (bad_ > kMostShown) return;
    std::printf("\n%s\n", frames_.place(bad.frame).c_str());
    for (const BadFrame::Pair& pair : bad.pairs) std::printf("  %s\n", sentence(pair).c_str());
    for (const BadFrame::Self& self : bad.selfs) std::printf("  %s\n", sentence(self).c_str());
    std::fflush(stdout);
  }

  std::size_t bad_frames() const { return bad_; }
  /// For the page. @pre bad_frames() > 0
  results::Finding finding() const {
    return {count_text(), frames_.place(*first_) + ", " + first_words_};
  }
  std::optional<std::size_t> first() const { return first_; }

  /// `open`: see FrameChecker; `steps` and `checker`: null without --between.
  void end(const CheckArguments& arguments, const judge::OpenBodies& open, int exit_code,
           const std::string& page, const StepReport* steps,
           const judge::StepChecker* checker) const {
    Json not_judged = Json::array();
    std::string not_judged_text;
    for (const auto& [body, why] : open) {
      not_judged.push_back({{"body", name(body)}, {"level", "containment"}, {"reason", why}});
      not_judged_text += name(body) + ": containment and depth in it not judged: " + why + "\n";
    }
    if (json_) {
      Json event = {{"event", "end"},
                    {"out", arguments.out.string()},
                    {"bad_frames", bad_},
                    {"first", first_ ? Json(*first_) : Json(nullptr)},
                    {"not_judged", not_judged}};
      if (steps != nullptr) event["between"] = steps->end_json(*checker);
      event["exit_code"] = exit_code;
      return print_event(event);
    }
    if (bad_ > kMostShown)
      std::printf("\n... and %s\n", counted(bad_ - kMostShown, "more frame").c_str());
    if (bad_ == 0 && steps != nullptr && steps->printed()) std::printf("\n");
    if (bad_ == 0) std::printf("no frame has a contact that is not allowed\n");
    std::printf("%s", not_judged_text.c_str());
    if (bad_ > 0)
      std::printf("\n%s, the first is %s\n", count_text().c_str(), frames_.place(*first_).c_str());
    if (deepest_)
      std::printf("%s: %s, %s\n", unknown_depth_ ? "deepest of known depth" : "deepest",
                  frames_.place(deepest_->first).c_str(), sentence(deepest_->second).c_str());
    if (steps != nullptr) steps->print_end(*checker);
    if (!page.empty()) std::printf("%s shows it\n", page.c_str());
  }

 private:
  std::string count_text() const {
    return std::to_string(bad_) + " of " + counted(scene_.frames, "frame") +
           (bad_ == 1 ? " has" : " have") + " a contact that is not allowed";
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
            {"file", frames_.file(bad.frame)},
            {"contacts", std::move(contacts)},
            {"self", std::move(selfs)}};
  }

  const scene::Scene& scene_;
  const FrameNames& frames_;
  std::vector<std::string> shown_, unchecked_;
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

/// What the page shows.
struct PageSubject {
  std::string id;
  std::vector<std::size_t> frames;
  std::vector<Level> levels;
  std::vector<std::string> detectors;
  results::Finding finding;
};

/// The first frame that is not allowed, else both ends of the first step.
PageSubject page_subject(const CheckReport& frames, const StepReport& steps,
                         const scene::Scene& scene) {
  PageSubject out{{}, {}, scene.levels, {judge::kFrameDetector}, {}};
  if (frames.first()) {
    out.id = "frame-" + std::to_string(*frames.first());
    out.frames = {*frames.first()};
    out.finding = frames.finding();
    if (steps.is_bad()) {
      out.finding.title += ", and " + steps.finding().title;
      out.finding.first += "; " + steps.finding().first;
    }
    return out;
  }
  const std::size_t step = steps.first();
  out.id = "frames-" + std::to_string(step) + "-" + std::to_string(step + 1);
  out.frames = {step, step + 1};
  out.finding = steps.finding();
  out.detectors.push_back(judge::kStepDetector);
  const bool between =
      std::ranges::any_of(scene.levels, [](Level level) { return !is_self(level); });
  for (const Level level : kLevels)
    if (is_impact(level) && (is_self_impact(level) ? steps.first_has_own() : between))
      out.levels.push_back(level);
  return out;
}

/// The page: a run of its own, on a recording of the frames. Returns its path; a build without npm
/// has no page, but a report.
fs::path write_page(const CheckArguments& arguments, const scene::Scene& scene,
                    const std::string& files, PageSubject subject, const DetectorCatalog& catalog) {
  Recording recording;
  recording.scene = subject.id;
  recording.bodies = scene.bodies;
  recording.time_step = scene.time_step;
  recording.levels = subject.levels;
  for (const std::size_t frame : subject.frames)
    recording.frames.push_back(scene.nodes_of_frame(frame));
  const fs::path file = arguments.out / (recording.scene + ".ccr");
  write_recording(file, recording);
  RunArguments run;
  run.targets = {file.string()};
  run.detectors = subject.detectors;
  run.timing = false;
  run.quiet = true;
  run.finding = std::move(subject.finding);
  run.out = arguments.out;
  run.keep = false;  // what an interrupted `run` has left there stays
  run.command_line = "contactcheck check" + files + (arguments.between ? " --between" : "") +
                     (arguments.weld ? " --weld" : "") +
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
  const Allowed allowed = allowed_by(arguments.allow);
  if (allowed.impact && !arguments.between)
    throw InputError("--allow impact is about steps, which are checked with --between");
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

  if (arguments.between && scene.frames < 2)
    throw InputError("--between looks from frame to frame, and here is one frame");
  if (arguments.between) refuse_left_out(files);

  const FrameNames names{files.labels};
  CheckReport report(scene, files, names, arguments.json_lines);
  StepReport steps(scene, names, allowed, arguments.json_lines);
  report.start(arguments);
  judge::FrameChecker checker(scene, allowed, catalog);
  std::optional<judge::StepChecker> step_checker;
  if (arguments.between) step_checker.emplace(scene, allowed, catalog);
  judge::FrameContacts before;
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
    const std::optional<BadFrame> bad = checker.check(f);
    std::vector<StepContact> found;
    if (step_checker && f > 0) found = step_checker->check(f - 1, before, checker.contacts());
    before = checker.contacts();
    if (bad || !found.empty()) display.finish();
    if (!found.empty()) steps.step(f - 1, found);
    if (bad) report.frame(*bad);
  }
  display.finish();
  fs::path page;
  if (report.first() || steps.is_bad()) {
    std::string words =
        files.shown.empty() ? " " + text::in_shell(arguments.frames[0].string()) : "";
    for (const std::string& word : files.shown) words += " " + word;
    page = write_page(arguments, scene, words, page_subject(report, steps, scene), catalog);
  }
  const int code = report.bad_frames() > 0 || steps.is_bad() ? 1 : 0;
  report.end(arguments, checker.open(), code, page.string(), arguments.between ? &steps : nullptr,
             step_checker ? &*step_checker : nullptr);
  return code;
}

}  // namespace contactcheck::cli
