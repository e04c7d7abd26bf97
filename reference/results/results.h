// results.json as plain data; fixtures/results.schema.json explains each field. Units: metres,
// seconds (times in milliseconds), degrees, bytes. A quantity that was not measured has no value,
// and is null in the file.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/types/contact_set.h"
#include "core/types/semantics.h"
#include "reference/results/statistics.h"

namespace contactcheck::results {

/// The field `schema` of the files that this program reads and writes.
inline constexpr const char* kSchema = "contactcheck-results/2";

using Texts = std::map<std::string, std::string>;

struct Machine {
  std::string cpu, isa, os, compiler, build;
  std::size_t cores = 0;
};

/// The members with their names in the file, in its order.
std::vector<std::pair<std::string, std::string>> members_of(const Machine& machine);

/// Reports of contact within steps that are not true, but whose elements come as near as the
/// detector's declared tolerance; they are not spurious.
struct NearReports {
  std::uint64_t near = 0;
  std::uint64_t undecided = 0;  ///< those of which the oracle does not say whether they are near
  /// The largest of the near ones' smallest distances within the step, in metres, and the largest
  /// as a share of the distance at its start. A cap on tolerances limits these.
  double near_max = 0.0, near_of_start_max = 0.0;
};

/// Sums over frames, at one level.
struct LevelCounts {
  std::uint64_t truth = 0, reported = 0, hit = 0, missed = 0, spurious = 0;
  /// hit / truth and spurious / reported; none if the divisor is 0.
  std::optional<double> recall = {}, spurious_rate = {};
  std::optional<double> margin = {};       ///< of the near levels, metres
  bool informative = false;                ///< not claimed: shown, never gated
  std::optional<NearReports> within = {};  ///< if a tolerance is declared for the level

  bool perfect() const { return missed == 0 && spurious == 0; }
  /// Adds the counts only.
  LevelCounts& operator+=(const LevelCounts& other);
  void set_rates();
};

using Levels = std::map<Level, LevelCounts>;

/// By frame, at the finest level claimed and judged.
struct PerFrame {
  std::optional<Level> level;
  std::vector<std::uint64_t> truth, missed, spurious;
  /// The covered share of the true contact contour; none for frames without contour and detectors
  /// that report no elements.
  std::vector<std::optional<double>> covered_length_fraction;
  std::optional<std::vector<std::optional<double>>> frame_ms;  ///< of a timed run; none: not timed
};

/// Errors in [from, below); the last bin includes `below`.
struct HistogramBin {
  double from = 0.0, below = 0.0;
  std::uint64_t count = 0;
};

/// A run of frames in which two bodies touch or are reported to touch.
struct Episode {
  BodyPair bodies;
  std::optional<std::size_t> first_true, first_reported;  ///< frames
  std::optional<double> hover_gap;
  std::optional<long> late_frames;  ///< reported minus true, signed
};

/// Errors over all contacts that could be judged; no values if there were none.
struct ErrorSpread {
  std::uint64_t judged = 0;
  std::optional<double> max, mean, p95;
  std::vector<HistogramBin> histogram;
};

/// Graded errors: pair counts depend on tessellation, these do not.
struct Geometry {
  std::optional<double> missed_length, covered_length_fraction, spurious_distance_max;
  std::vector<HistogramBin> spurious_distance_histogram;
  DepthKind depth_kind = DepthKind::kNone;
  ErrorSpread depth;       ///< |reported - true|
  ErrorSpread normal_deg;  ///< to the nearest of the true normals
  std::optional<double> hover_gap_max;
  std::optional<long> late_frames;  ///< the one with the largest absolute value
  std::vector<Episode> episodes;
};

using NamedErrors = std::vector<std::pair<std::string, std::optional<double>>>;

struct Stage {
  std::string name, unit;
  std::uint64_t in = 0, out = 0, missed = 0;
  std::optional<std::uint64_t> visited;
  std::string visited_unit;  ///< with visited
};

/// Milliseconds per frame: the geometric mean over passes of each pass's mean over its frames.
/// Phases are shares of `frame` and add up to it.
struct PhaseTimes {
  std::optional<double> map;  ///< none for detectors that do their own mapping
  double update = 0.0, query = 0.0, frame = 0.0;
  std::optional<double> contact_frame;  ///< over frames with contact; none without any
  std::optional<double> first_frame;    ///< of a playback, whose other times leave it out
  std::optional<double> self_reported;  ///< update and query, measured by the detector
  double cpu = 0.0;                     ///< CPU time of the whole process tree
  /// The time that the machine gave to others while the detector was ready to run; not part of the
  /// other times. None in files of programs that did not measure it.
  std::optional<double> taken;
};

/// A detector's times in one question.
struct QuestionTimes {
  Question question = Question::kTriangles;
  std::size_t timed_frames = 0, timed_contact_frames = 0;
  std::size_t passes = 0;  ///< over these frames, each in a fresh process
  PhaseTimes playback;     ///< all frames in order, nothing flushed between them
  /// `playback.frame` of each pass; empty in files of programs that did not store it.
  std::vector<double> pass_ms;
  /// The scene's cold_frames, each after a sweep through the caches; only for its own question.
  std::optional<PhaseTimes> cold;
};

/// time(reference) / time(detector) over the same frames and the same number of passes of both: the
/// geometric mean, with its 95 % interval or the range of the passes (statistics.h).
struct Speedup {
  Ratio playback;
  std::optional<Ratio> cold;            ///< none unless the question is both's own
  std::optional<Ratio> contact_frames;  ///< playback; none without a frame with contact
  std::optional<Ratio> without_map;     ///< playback; none if one side maps within its query
  std::size_t passes = 0;
  Texts reference_options;
};

/// The settings of a run's timing.
struct Timing {
  std::size_t processes = 0;   ///< passes of each detector
  double one_pass_beyond = 0;  ///< seconds: slower detectors get one pass; 0: no limit
  std::uint64_t seed = 0;      ///< for the order of detectors and the cold frames
  std::uint64_t sweep_bytes = 0;
};

/// The motion that a detector drives; the oracle judges it on the same frames.
struct ClosedLoop {
  std::string error;      ///< not empty: why there is no motion (it diverged); all else is unset
  std::size_t steps = 0;  ///< of the simulation
  Levels levels;          ///< the detector's answers on the frames that it drove
  /// The true distance of every pair of bodies that the detector reports in the last tenth of the
  /// frames (0 where they touch or sink in); none without such a pair.
  std::optional<double> hover_at_rest_max, hover_at_rest_mean;
  /// The deepest vertex inside another body, over all frames; none where no body is closed in all
  /// of them, or level `vertex` is not judged.
  std::optional<double> deepest_penetration;
  /// (highest total energy - energy at the start) / highest kinetic energy: above 0 if response or
  /// integrator added energy.
  std::optional<double> energy_gain;
  double last_speed = 0.0;  ///< m/s, root mean square over the mass: about 0 at rest
  /// Pairs of bodies that leave a true contact on the other side: since the last frame before it,
  /// the direction between their centres has turned by more than 90 degrees.
  std::size_t tunnelling_events = 0;
};

/// What a detector says of the steps from frame to frame, beside the counts of its levels.
struct Impacts {
  /// By step: pairs of bodies that meet within it and touch at neither end, and are not reported:
  /// not in the step, or, by a detector of frames, at neither end.
  std::vector<std::uint64_t> tunnelled;
  /// Pairs of bodies that are reported with a time and do meet; how much earlier or later than the
  /// first time the reported one is at most, fractions of the step.
  std::uint64_t timed = 0;
  std::optional<double> early_max, late_max;  ///< none without such a pair
  /// Pairs that do meet, are apart at the start and within the tolerance there, and are reported
  /// at time 0: they are neither timed nor early.
  std::uint64_t near_at_start = 0;
  /// Pairs of triangles that meet within a step and do not touch at its start, and those of them
  /// that are not reported; none if it does not claim such pairs.
  std::optional<std::uint64_t> new_triangles, new_missed;
};

/// Whole simulation steps, timed in lockstep: every detector steps from the same recorded states.
/// Milliseconds per step: medians over repeats.
struct StepTimes {
  std::size_t steps = 0, repeats = 0;
  double mss = 0.0, cell = 0.0, test = 0.0, response = 0.0, total = 0.0;
  std::vector<double> test_by_repeat, total_by_repeat;
};

enum class Status { kOk, kError, kAbsent, kRefused };
const char* name_of(Status status);

/// A hash as in the file: "0x0123456789abcdef".
std::string hex(std::uint64_t hash);

/// One detector on one scene. If it is not `ok`, the file has no field from per_frame on.
struct Run {
  std::string scene, detector, message;
  Status status = Status::kOk;
  std::size_t frames = 0, contact_frames = 0;
  Semantics semantics;
  Texts options;
  std::string recording;
  std::optional<std::size_t> failed_frame;
  PerFrame per_frame;
  Levels levels;
  Levels levels_rounded;                    ///< against the truth for the values it was fed
  std::map<Level, std::string> not_judged;  ///< claimed levels, and why they were not judged
  Geometry geometry;
  std::vector<Stage> stages;
  /// The detector's own counts of work for its own question, summed over frames.
  std::vector<std::pair<std::string, std::uint64_t>> counters;
  double prepare_ms = 0.0;
  std::vector<QuestionTimes> times;  ///< its own question first; empty if not timed
  std::map<Question, std::map<std::string, Speedup>> speedup;  ///< by reference detector
  std::uint64_t memory_bytes = 0;    ///< heap: the largest over all frames
  std::uint64_t prepared_bytes = 0;  ///< heap after prepare
  std::string contact_hash;
  std::vector<std::string> float_environment;  ///< what the detector left changed
  std::vector<std::string> notes;              ///< other facts for the reader
  std::optional<Impacts> impacts;              ///< if the scene judges contact within steps
  std::optional<ClosedLoop> closed_loop;
  std::optional<StepTimes> step_ms;

  bool ok() const { return status == Status::kOk; }
};

/// The errors of a row's geometry and impacts with their names in the file, sorted; the same names
/// for every row.
NamedErrors errors_of(const Run& run);

struct SceneBody {
  std::string name, source, notes;
  std::size_t vertices = 0, triangles = 0, cells = 0;
  bool solid = false;
};

struct Family {
  std::string parameter, origin, stresses;
  std::vector<std::string> values;
  std::vector<std::uint64_t> true_pairs;  ///< by value
  /// "size", the edge of a triangle in metres, or "distance", from the origin in edges; else empty.
  std::string range;
};

/// The number that a family's parameter value denotes. @throws InputError if it is not a number
double parameter_number(const std::string& value);

struct Sweep {
  std::vector<double> separations;
  std::size_t orientations = 0;
  std::uint64_t seed = 0;
  double tolerance = 0.0;
};

struct LatticeFit {
  std::string body;
  std::vector<double> rms, max;  ///< by frame
};

struct PairKindTally {
  std::uint64_t pairs = 0, touching = 0;
};

struct RandomPairs {
  std::uint64_t count = 0, seed = 0, touching = 0;
  std::vector<std::pair<std::string, PairKindTally>> per_kind;
  std::uint64_t checked = 0, oracle_wrong = 0;  ///< by rational arithmetic
};

/// The origin of a scene that was drawn from a seed (reference/scene/drawn_scene.h).
struct Drawn {
  std::uint64_t seed = 0, number = 0;
  std::size_t redrawn = 0;  ///< number of redraws because judging exceeded a limit
  std::string happens;
  std::map<std::string, double> parameters;
};

struct Simulation {
  std::string driver;
  double step = 0.0;
  std::size_t every = 0;
};

/// Metres. An edge is the longest side of a triangle at rest; point triangles are left out.
struct SceneScale {
  double shortest_edge = 0.0, longest_edge = 0.0;
  double reach = 0.0;  ///< the largest |coordinate| of a vertex in any frame
};

/// Contact within the steps from frame to frame, by step.
struct SceneImpacts {
  std::vector<double> motion;  ///< the largest of a vertex, in mean edges of its body at rest
  /// Pairs of bodies that touch at the start; that meet and are apart at the start; those of them
  /// that do not touch at the end either. `meeting` is empty in files of older programs.
  std::vector<std::uint64_t> starting, meeting, passing;
  /// Pairs of triangles that meet and do not touch at the start, over all steps; those of them that
  /// do not touch at the end either.
  std::uint64_t new_triangles = 0, passing_triangles = 0;
};

struct Scene {
  std::string id, title;
  std::size_t frames = 0, contact_frames = 0;
  double time_step = 0.0, size = 0.0;
  /// None if cases or pairs differ in scale between frames, or without triangles.
  std::optional<SceneScale> scale;
  /// Contacts over all frames, or why the level cannot be judged.
  std::map<Level, std::variant<std::uint64_t, std::string>> truth;
  std::string truth_hash;
  std::vector<SceneBody> bodies;
  std::vector<double> separation;
  std::vector<std::size_t> cold_frames;  ///< ascending; empty if nothing was timed
  std::optional<Family> family;
  std::optional<Sweep> sweep;
  std::vector<LatticeFit> fits;
  std::optional<RandomPairs> pairs;
  std::optional<Drawn> drawn;
  std::optional<Simulation> simulation;
  std::optional<SceneImpacts> impacts;  ///< if the scene judges contact within steps
  std::string unjudged, contacts;       ///< empty: absent
};

struct Disagreement {
  std::string scene, detector, level, kind;
  std::string case_file;  ///< its name; its path during a run
  std::size_t frame = 0;
};

struct Goal {
  std::string goal, scene, detector, part;
  std::string over, over_scene, per;  ///< one of them
  std::optional<double> at_least, at_most;

  bool operator==(const Goal&) const = default;
};

struct MeasuredGoal : Goal {
  std::optional<double> measured, low, high;
  std::string unit, why;
  std::optional<bool> met;
};

struct Plugin {
  std::string detector, kind, source, content, version;
  bool unisolated = false;  ///< its process could not be ended: its rows are never gated
  bool transient = false;   ///< no later run can reach it: no command runs it again
};

struct DefectCount {
  std::string library, version, where, upstream, kind, sentence;  ///< upstream: empty, or a link
  std::vector<std::string> detectors, scenes;
  std::size_t listed = 0, shown = 0, changed = 0;
  bool other_version = false;
};

/// Cases of one detector, scene and kind, with the number of pairs in each: listed and shown. A
/// list without meaning for its kind of difference is empty.
struct Sightings {
  std::string detector, scene, kind;
  std::vector<std::string> values;
  std::vector<std::uint64_t> was, is;
};

struct DefectCounts {
  std::vector<DefectCount> defects, readings;
  std::vector<Sightings> changed, not_shown, unlisted;
};

/// The range of sizes, or of distances from the origin, in which a detector answers every case of
/// the suite scales as it claims. Values are written as in the families (parameter_number).
struct ScaleRange {
  std::string detector;          ///< its canonical name
  std::string library, version;  ///< as of a KnownDefect (known_defects.h)
  std::string by;                ///< Family::range
  std::string level;             ///< the finest judged; "-" if none was
  std::string from, to;          ///< empty if it is right nowhere
  std::string least, most;       ///< the smallest and largest value tried
  std::uint64_t right = 0, cases = 0;
  std::string wrong_below, wrong_above;  ///< the nearest wrong case, with its error; or empty

  bool by_size() const { return by == "size"; }
  bool operator==(const ScaleRange&) const = default;
};

struct ShardScene {
  std::string id;
  std::vector<std::string> detectors, references;
  std::string content;

  bool operator==(const ShardScene&) const = default;
};

struct Shard {
  std::size_t index = 0, of = 0;
  std::string command, program;
  std::vector<std::pair<std::string, std::string>> settings;  ///< by name, values as JSON
  std::vector<Goal> goals;
  std::vector<ShardScene> scenes;
  Texts files;
};

struct Results {
  std::string version, command;
  Machine machine;
  std::vector<std::pair<std::string, std::string>> libraries;
  std::vector<Plugin> plugins;
  std::optional<Timing> timing;
  std::vector<Scene> scenes;
  std::vector<Run> runs;
  std::vector<Disagreement> disagreements;
  std::optional<DefectCounts> known_defects;
  /// The ranges of its detectors, for the versions of their libraries in this run.
  std::vector<ScaleRange> known_ranges;
  std::vector<MeasuredGoal> goals;
  std::optional<std::vector<std::string>> resumed;
  /// By scene, what `run --resume` knows it again by; empty in a baseline.
  Texts identities;
  std::optional<Shard> shard;
  std::vector<std::string> merged;

  /// The plug-in of a detector (named with or without options); null for the program's own.
  const Plugin* plugin_of(const std::string& detector) const;
};

/// The question in which a goal compares a row with that of a reference: the reference's own if the
/// row was timed in it too, else the row's own; none if it was not timed.
std::optional<Question> goal_question(const Run& run, const Run& reference);

/// Looks up scenes and rows by name. The results must outlive it and not change. Unknown names give
/// null or an empty list.
class Index {
 public:
  explicit Index(const Results& results);
  explicit Index(const Results&&) = delete;  ///< a temporary would be gone

  const Results& results() const { return *results_; }
  const Scene* scene(const std::string& id) const;
  const Run* run(const std::string& scene, const std::string& detector) const;
  /// The row if its status is `ok`, else null.
  const Run* ok_run(const std::string& scene, const std::string& detector) const;
  /// In the order of the file, as below.
  const std::vector<const Run*>& runs_of(const std::string& scene) const;
  /// Each detector once, in the order of first rows.
  const std::vector<std::string>& detectors() const { return detectors_; }

 private:
  const Results* results_;
  std::map<std::string, const Scene*> scenes_;
  std::map<std::string, std::vector<const Run*>> runs_;
  std::map<std::pair<std::string, std::string>, const Run*> run_;
  std::vector<std::string> detectors_;
};

}  // namespace contactcheck::results
