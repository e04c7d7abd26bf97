#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "core/deform/atomic_file.h"
#include "core/types/check.h"
#include "core/types/hash.h"
#include "reference/check/check_files.h"
#include "reference/check/check_log.h"
#include "reference/check/check_page.h"
#include "reference/check/check_summary.h"
#include "reference/check/frame_words.h"
#include "reference/check/kept_recordings.h"
#include "reference/cli/command_checks.h"
#include "reference/cli/commands.h"
#include "reference/cli/event_lines.h"
#include "reference/cli/progress_display.h"
#include "reference/judge/frame_check.h"
#include "reference/judge/step_check.h"
#include "reference/process/interrupts.h"
#include "reference/report/formats/html.h"
#include "reference/results/results.h"
#include "reference/scene/frame_files.h"
#include "reference/scene/read_ahead.h"
#include "reference/suite/kept_work.h"
#include "reference/suite/out_lock.h"
#include "reference/text/counted.h"
#include "reference/text/file_text.h"
#include "reference/text/lists.h"
#include "reference/text/shell_word.h"

namespace contactcheck::cli {
namespace {

namespace fs = std::filesystem;
using check::Allowed, check::CheckedFrame, check::CheckLog, check::CheckSummary, check::FrameWords,
    check::Json;
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

// The levels that are left to be judged.
std::vector<Level> levels_of(const judge::AllowedContact& allowed) {
  std::vector<Level> levels;
  for (const Level level : {Level::kBody, Level::kContainment, Level::kTriangle})
    if (!allowed.contact) levels.push_back(level);
  for (const Level level : {Level::kSelf, Level::kSelfVertex, Level::kSelfEdge, Level::kSelfBody})
    if (!allowed.self) levels.push_back(level);
  return levels;
}

/// What is checked.
struct Subject {
  scene::FrameFiles files;
  scene::Scene scene;
  fs::path recording;  ///< of all frames, if it is one

  std::string stamp(std::size_t frame) const {
    std::vector<fs::path> parts = files.others;
    if (!recording.empty()) parts.push_back(recording);
    if (frame < files.moving.size())
      parts.insert(parts.end(), files.moving[frame].begin(), files.moving[frame].end());
    return check::stamp_of(parts);
  }
};

Subject subject_of(const CheckArguments& arguments, const std::vector<Level>& levels) {
  Subject out;
  if (arguments.frames.size() == 1 && arguments.frames[0].extension() == ".ccr") {
    out.recording = arguments.frames[0];
    out.scene = scene::load_any_scene(out.recording);
  } else {
    out.files = scene::frame_files(arguments.frames, arguments.rules, "check", levels);
    out.scene = scene::load_scene_unread(out.files.scene);
    if (out.scene.read_frame) {
      const auto ahead = std::make_shared<scene::ReadAhead>(out.scene.read_frame, out.scene.frames);
      out.scene.read_frame = [ahead](std::size_t frame) { return (*ahead)(frame); };
    }
  }
  out.scene.levels = levels;
  if (out.scene.bodies.size() == 1)
    std::erase_if(out.scene.levels, [](Level level) { return !is_self(level); });
  if (out.scene.levels.empty())
    throw InputError("--allow self leaves nothing to be checked of one body");
  if (arguments.weld) scene::weld(out.scene);
  scene::refuse_crowded_vertices(out.scene);
  if (arguments.between && out.scene.frames < 2)
    throw InputError("--between looks from frame to frame, and here is one frame");
  if (arguments.between) refuse_left_out(out.files);
  return out;
}

// The words that decide what is found.
std::string option_words(const CheckArguments& arguments) {
  std::string out = std::string(arguments.between ? " --between" : "") +
                    (arguments.weld ? " --weld" : "") + (arguments.rules.repair ? " --repair" : "");
  for (const std::string& pattern : arguments.rules.patterns)
    out += " --frames " + text::in_shell(pattern);
  if (!arguments.rules.cache_space.empty()) out += " --cache-space " + arguments.rules.cache_space;
  for (const std::string& word : arguments.allow) out += " --allow " + text::in_shell(word);
  return out;
}

std::string command_of(const CheckArguments& arguments, const Subject& subject) {
  std::string out = "contactcheck check";
  if (!subject.recording.empty()) out += " " + text::in_shell(subject.recording.string());
  for (const std::string& word : subject.files.shown) out += " " + word;
  out += option_words(arguments);
  for (const std::string& frame : arguments.keep) out += " --keep " + text::in_shell(frame);
  if (arguments.out != CheckArguments{}.out)
    out += " --out " + text::in_shell(arguments.out.string());
  return out;
}

// Not the vertices: each frame has a stamp of its own, and frames may be added.
std::string identity_of_check(const CheckArguments& arguments, const Subject& subject) {
  Fnv1a hash;
  for (const Body& body : subject.scene.bodies) {
    hash.bytes(body.name.data(), body.name.size());
    const std::vector<Triangle>& triangles = body.shape->mesh.triangles;
    hash.bytes(triangles.data(), sizeof(Triangle) * triangles.size());
  }
  return suite::identity_of("bodies: " + results::hex(hash.digest()) +
                            "\noptions: " + option_words(arguments) + "\n");
}

/// The frames that an earlier check of the same has left in --out.
std::vector<CheckedFrame> taken_over(const CheckArguments& arguments, const Subject& subject,
                                     const std::string& identity, const fs::path& file) {
  CheckLog log = CheckLog::read(file);
  const bool same = log.identity == identity;
  const std::string left =
      "a check that did not end has left " + counted(log.frames.size(), "checked frame");
  if (!log.ended && !log.frames.empty()) {
    suite::require_nothing_lost(
        {left, log.identity, log.command},
        {arguments.out, identity, "", arguments.resume, arguments.overwrite});
    if (log.frames.size() > subject.scene.frames && !arguments.overwrite)
      throw InputError("--out " + arguments.out.string() + ": " + left + " there, and here are " +
                       counted(subject.scene.frames, "frame") + ": " + log.command +
                       "; --overwrite discards the others, another --out keeps them");
  }
  if (!arguments.resume) return {};
  std::size_t good = 0;
  while (same && good < log.frames.size() && good < subject.scene.frames &&
         log.frames[good].stamp == subject.stamp(good))
    ++good;
  const std::size_t had = log.frames.size();
  log.frames.resize(good);
  if (!arguments.quiet)
    std::fprintf(stderr, "resumed: %s of %s, checked in %s%s\n", std::to_string(good).c_str(),
                 counted(subject.scene.frames, "frame").c_str(), file.c_str(),
                 good < had && good < subject.scene.frames
                     ? same ? "; the files of the next one have changed"
                            : "; the others are of another check"
                     : "");
  return std::move(log.frames);
}

/// What is said while frames are checked, to a person or to a program.
class Teller {
 public:
  Teller(const Subject& subject, const FrameWords& words, const CheckSummary& summary,
         const CheckArguments& arguments)
      : subject_(subject), words_(words), summary_(summary), json_(arguments.json_lines) {}

  void start(const Json& event) const {
    if (json_) return say(event);
    std::string text;
    const scene::Scene& scene = subject_.scene;
    for (std::size_t b = 0; b < scene.bodies.size(); ++b)
      text += scene.bodies[b].name + ": " +
              counted(scene.bodies[b].shape->mesh.triangles.size(), "triangle") +
              (b < subject_.files.shown.size() ? ", " + subject_.files.shown[b] : "") +
              (scene.origins[b].notes.empty() ? "" : "; " + scene.origins[b].notes) + "\n";
    constexpr std::size_t kMostNamed = 4;
    const std::vector<std::string>& unchecked = subject_.files.unchecked;
    if (!unchecked.empty())
      text += "not checked, because not every body has that frame: " +
              text::first_joined(unchecked, kMostNamed) +
              (unchecked.size() > kMostNamed
                   ? " and " + counted(unchecked.size() - kMostNamed, "more file")
                   : "") +
              "\n";
    std::printf("%s%s\n", text.c_str(), counted(scene.frames, "frame").c_str());
    std::fflush(stdout);
  }

  /// After the frame was added to the summary.
  void frame(const CheckedFrame& frame) const {
    if (json_) {
      if (!frame.step.empty()) say(frame.step.event);
      if (!frame.here.empty()) say(frame.here.event);
      return;
    }
    if (frame.found_in_step() && summary_.found_steps() <= check::kMostShown)
      contacts(words_.places(frame.frame - 1), frame.step.words);
    if (!frame.here.empty() && summary_.bad_frames() <= check::kMostShown)
      contacts(words_.place(frame.frame), frame.here.words);
  }

  void say(const Json& event) const {
    EventLines(true).print(event.dump(-1, ' ', false, Json::error_handler_t::replace));
  }

 private:
  static void contacts(const std::string& place, const std::vector<std::string>& sentences) {
    std::printf("\n%s\n", place.c_str());
    for (const std::string& sentence : sentences) std::printf("  %s\n", sentence.c_str());
    std::fflush(stdout);
  }

  const Subject& subject_;
  const FrameWords& words_;
  const CheckSummary& summary_;
  bool json_;
};

Json start_event(const CheckArguments& arguments, const Subject& subject) {
  Json bodies = Json::array();
  for (const Body& body : subject.scene.bodies)
    bodies.push_back({{"name", body.name},
                      {"vertices", body.shape->mesh.vertices.size()},
                      {"triangles", body.shape->mesh.triangles.size()}});
  return {{"event", "start"},
          {"schema", "contactcheck-events/1"},
          {"version", CONTACTCHECK_VERSION},
          {"out", arguments.out.string()},
          {"frames", subject.scene.frames},
          {"unchecked", subject.files.unchecked},
          {"bodies", std::move(bodies)}};
}

/// How far it is, on standard error: a bar on a terminal, now and then a line elsewhere.
class Progress {
 public:
  Progress(const CheckArguments& arguments, const scene::Scene& scene, std::size_t first)
      : display_(arguments.quiet || !on_terminal(), true),
        events_(arguments.json_lines),
        quiet_(arguments.quiet || on_terminal() || arguments.json_lines),
        frames_(scene.frames),
        first_(first),
        id_(scene.id) {}

  void frame(std::size_t f) {
    suite::SuiteProgress progress{0,
                                  1,
                                  id_,
                                  judge::kFrameDetector,
                                  static_cast<std::uint32_t>(f),
                                  frames_,
                                  static_cast<double>(f) / static_cast<double>(frames_)};
    const auto now = std::chrono::steady_clock::now();
    const auto left =
        seconds_left(std::chrono::duration<double>(now - start_).count(),
                     static_cast<double>(first_) / static_cast<double>(frames_), progress.share);
    display_.show(progress, left);
    if (events_.wanted()) events_.progress(progress, left);
    if (quiet_ || now - said_ < kInterval) return;
    said_ = now;
    std::fprintf(stderr, "%zu of %zu frames are checked%s\n", f, frames_,
                 left ? (", " + time_left_text(*left)).c_str() : "");
  }
  void finish() { display_.finish(); }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr auto kInterval = std::chrono::seconds(10);
  static bool on_terminal() { return isatty(STDERR_FILENO) != 0; }

  ProgressDisplay display_;
  EventLines events_;
  bool quiet_;
  std::size_t frames_, first_;
  std::string id_;
  Clock::time_point start_ = Clock::now(), said_ = start_;
};

}  // namespace

int check_command(const CheckArguments& arguments, const DetectorCatalog& catalog) {
  const Allowed allowed = allowed_by(arguments.allow);
  if (allowed.impact && !arguments.between)
    throw InputError("--allow impact is about steps, which are checked with --between");
  const std::vector<Level> levels = levels_of(allowed);
  if (levels.empty())
    throw InputError("--allow contact and --allow self leave nothing to be checked");
  const Subject subject = subject_of(arguments, levels);
  const scene::Scene& scene = subject.scene;
  std::vector<std::vector<std::size_t>> kept;
  for (const std::string& word : arguments.keep)
    kept.push_back(check::kept_frames(word, scene.frames));
  check_out(arguments.out);
  const suite::OutLock lock(arguments.out);

  const std::string identity = identity_of_check(arguments, subject),
                    command = command_of(arguments, subject);
  const fs::path log_file = arguments.out / "check.jsonl";
  const std::vector<CheckedFrame> taken = taken_over(arguments, subject, identity, log_file);
  const FrameWords words(scene, subject.files.labels, allowed);
  CheckSummary summary(scene, words, allowed, arguments.between);
  const Teller teller(subject, words, summary, arguments);
  const Json start = start_event(arguments, subject);
  teller.start(start);
  check::CheckLogWriter log(log_file, identity, command, taken);
  // Those of an earlier check would pass for this one's until it ends.
  for (const char* file : {"check.html", "check.csv", "check.json"}) {
    std::error_code ignored;
    fs::remove(arguments.out / file, ignored);
  }
  process::say_when_interrupted(
      "contactcheck: interrupted; checked frames are kept: repeat the command with --resume to go "
      "on\n");
  judge::FrameChecker checker(scene, allowed, catalog);
  std::optional<judge::StepChecker> steps;
  if (arguments.between) steps.emplace(scene, allowed, catalog);
  for (const CheckedFrame& frame : taken) {
    summary.add(frame);
    teller.frame(frame);
  }
  if (!taken.empty()) {
    checker.resume(taken.back().contacts, taken.back().open);
    if (steps) steps->resume(taken.back().totals);
  }

  Progress progress(arguments, scene, taken.size());
  // Taken before the frame is read, ahead of its turn: what changes later is then seen.
  std::string stamp = subject.stamp(taken.size());
  for (std::size_t f = taken.size(); f < scene.frames; ++f) {
    progress.frame(f);
    const judge::FrameContacts before = checker.contacts();
    CheckedFrame frame;
    frame.frame = f;
    frame.stamp = std::exchange(stamp, subject.stamp(f + 1));
    if (const auto bad = checker.check(f)) frame.here = words.of_frame(*bad);
    frame.contacts = checker.contacts();
    frame.open = checker.open();
    if (steps && f > 0) {
      const auto found = steps->check(f - 1, before, frame.contacts);
      if (!found.empty()) frame.step = words.of_step(f - 1, found);
      frame.totals = steps->totals();
    }
    log.add(frame);
    summary.add(frame);
    if (!frame.here.empty() || !frame.step.empty()) progress.finish();
    teller.frame(frame);
  }
  progress.finish();

  const int code = summary.bad() ? 1 : 0;
  write_file_atomically(arguments.out / "check.csv", check::check_csv(summary));
  write_file_atomically(arguments.out / "check.json",
                        check::check_json(summary, command, start, code)
                                .dump(1, ' ', false, Json::error_handler_t::replace) +
                            "\n");
  // What follows reads frames once more.
  check::write_recordings(kept, summary, scene, arguments.out);
  const fs::path page = arguments.out / "check.html";
  if (report::has_html_report())
    write_file_atomically(page,
                          check::check_page(scene, words, summary, command, subject.files.shown));
  log.end(code);
  if (arguments.json_lines) {
    Json end = {{"event", "end"}, {"out", arguments.out.string()}};
    end.update(summary.event());
    end["exit_code"] = code;
    teller.say(end);
  } else {
    std::printf("%s", summary.text().c_str());
    const fs::path& shows = report::has_html_report() ? page : arguments.out / "check.csv";
    if (summary.bad()) std::printf("%s shows it\n", shows.c_str());
  }
  return code;
}

}  // namespace contactcheck::cli
