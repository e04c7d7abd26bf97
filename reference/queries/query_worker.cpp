#include "reference/queries/query_worker.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>

#include "core/types/check.h"
#include "reference/process/exit_codes.h"
#include "reference/process/float_environment.h"
#include "reference/process/interrupts.h"
#include "reference/process/shared_page.h"
#include "reference/process/surroundings.h"
#include "reference/process/worker_process.h"
#include "reference/text/json_value.h"
#include "reference/text/printable.h"

namespace contactcheck::queries {
namespace {

using Clock = std::chrono::steady_clock;

/// Queries that the page holds at once.
constexpr std::size_t kMostAsked = 1024;
constexpr std::size_t kLongestFault = 1024;  // bytes
constexpr auto kShortestWait = std::chrono::microseconds(20);
constexpr auto kLongestWait = std::chrono::microseconds(1000);
constexpr auto kBetweenLimits = std::chrono::milliseconds(20);
constexpr auto kTimeToEnd = std::chrono::milliseconds(500);

/// A TimedAnswer whose bytes may be anything: the worker's memory is a plug-in's to overwrite.
struct PageAnswer {
  std::uint32_t refused, contact, has_time, has_tolerance;
  double time, tolerance, micros;
};

PageAnswer to_page(const TimedAnswer& answer) {
  const ReportedImpact& impact = answer.impact;
  return {answer.refused,
          impact.contact,
          impact.time.has_value(),
          impact.tolerance.has_value(),
          impact.time.value_or(0),
          impact.tolerance.value_or(0),
          answer.micros};
}

TimedAnswer from_page(const PageAnswer& from) {
  TimedAnswer answer;
  answer.refused = from.refused != 0;
  answer.micros = from.micros >= 0 ? from.micros : 0;  // false for NaN
  answer.impact.contact = from.contact != 0;
  if (from.has_time != 0) answer.impact.time = from.time;
  if (from.has_tolerance != 0) answer.impact.tolerance = from.tolerance;
  return answer;
}

/// What the two processes share.
struct Page {
  enum State : std::uint32_t { kStarting, kReady, kFailed };
  std::atomic<std::int32_t> supervisor{0};
  std::atomic<std::uint32_t> state{kStarting};
  std::atomic<std::uint64_t> asked{0};     ///< blocks
  std::atomic<std::uint64_t> answered{0};  ///< queries of the last block
  std::atomic<bool> end{false};
  std::uint32_t count = 0;  ///< queries of the last block
  ImpactTolerance tolerance;
  std::array<char, kLongestFault> fault{};
  std::array<ImpactQuery, kMostAsked> queries;
  std::array<PageAnswer, kMostAsked> answers;
};
static_assert(std::atomic<std::uint64_t>::is_always_lock_free);

/// Sleeps longer each time.
class Pause {
 public:
  void wait() {
    std::this_thread::sleep_for(now_);
    now_ = std::min(now_ * 2, kLongestWait);
  }

 private:
  std::chrono::microseconds now_ = kShortestWait;
};

class WorkerSession final : public QuerySession {
 public:
  WorkerSession(const std::string& detector, const std::string& record,
                const std::filesystem::path& executable, const WorkerLimits& limits)
      : limits_(limits), page_("contactcheck-queries") {
    process_.emplace(
        executable,
        std::vector<std::string>{"query-worker", detector, "--plugin=" + record, "--page-fd",
                                 std::to_string(process::WorkerProcess::kInheritedFd)},
        page_.fd());
    wait_until([this] { return page().state != Page::kStarting; });
    if (page().state == Page::kReady) tolerance_ = page().tolerance;
  }

  ~WorkerSession() override {
    page().end = true;
    const auto start = Clock::now();
    Pause pause;
    while (process_ && !process_->has_ended() && Clock::now() - start < kTimeToEnd) pause.wait();
    end_process();
  }

  void ask(std::span<const ImpactQuery> queries, std::vector<TimedAnswer>& answers) override {
    answers.clear();
    for (std::size_t begin = 0; begin < queries.size(); begin += kMostAsked) {
      const auto block = queries.subspan(begin, std::min(kMostAsked, queries.size() - begin));
      if (fault_.empty()) ask_block(block);
      const std::size_t given = std::min<std::size_t>(
          fault_.empty() ? block.size() : page().answered.load(), block.size());
      for (std::size_t i = 0; i < given; ++i) answers.push_back(from_page(page().answers[i]));
      if (!fault_.empty()) throw std::runtime_error(fault_);
    }
  }

  ImpactTolerance tolerance() const override { return tolerance_; }

  ImpactQuery fed(const ImpactQuery& query) const override {
    ImpactQuery out = query;
    for (auto* const points : {&out.start, &out.end})
      for (Vec3& point : *points) point = point.cast<float>().cast<double>();
    return out;
  }

 private:
  Page& page() const { return page_.value(); }

  void ask_block(std::span<const ImpactQuery> block) {
    std::copy(block.begin(), block.end(), page().queries.begin());
    page().count = static_cast<std::uint32_t>(block.size());
    page().answered = 0;
    ++page().asked;
    wait_until([&] { return page().answered >= block.size(); });
  }

  /// Until then, or until it has failed: fault_ says why.
  template <typename Condition>
  void wait_until(Condition&& done) {
    process::InterruptGuard interrupts;
    auto last_step = Clock::now(), last_look = last_step;
    std::uint64_t answered = 0;
    Pause pause;
    while (!done() && fault_.empty()) {
      pause.wait();
      const auto now = Clock::now();
      if (now - last_look < kBetweenLimits) continue;
      last_look = now;
      if (const std::uint64_t count = page().answered; count != answered) {
        answered = count;
        last_step = now;
      }
      if (interrupts.interrupted()) {
        end_process();
        interrupts.pass_on();
      }
      look_at_limits(std::chrono::duration<double>(now - last_step).count());
    }
    if (fault_.empty() && page().state == Page::kFailed) fault_ = said_fault();
  }

  void look_at_limits(double seconds_without_step) {
    if (page().state == Page::kFailed)
      fault_ = said_fault();
    else if (process_->has_ended())
      fault_ = how_it_ended();
    else if (seconds_without_step > limits_.call_seconds)
      fault_ = "no answer for " + text::shown(limits_.call_seconds) + " s (time limit of one call)";
    else if (process_->resident_bytes() > limits_.memory_bytes)
      fault_ = "more than " + std::to_string(limits_.memory_bytes >> 20) +
               " MiB resident (memory limit)";
    else if (process_->output_bytes() > process::kWorkerOutputLimit)
      fault_ = "wrote without end (output limit)";
    if (!fault_.empty()) end_process();
  }

  void end_process() {
    if (!process_) return;
    process_->kill();
    process_->reap();
    process_.reset();
  }

  std::string said_fault() const {
    const auto& fault = page().fault;
    return text::printable_line({fault.data(), strnlen(fault.data(), fault.size())});
  }

  std::string how_it_ended() {
    const int status = process_->reap();
    const std::string how = process::ended_text(status, process_->error_text());
    process_.reset();
    return how;
  }

  WorkerLimits limits_;
  process::SharedPage<Page> page_;
  std::optional<process::WorkerProcess> process_;
  ImpactTolerance tolerance_;
  std::string fault_;  ///< it answers no more
};

/// Answers blocks until the page says that it is enough.
void answer_blocks(Page& page, std::unique_ptr<ImpactDetector> detector) {
  const process::FloatEnvironmentGuard floats;
  std::uint64_t seen = 0;
  Pause pause;
  // One by one, so that a crash leaves the answers before it.
  const auto session = local_session(std::move(detector));
  std::vector<TimedAnswer> answer;
  while (!page.end) {
    const std::uint64_t asked = page.asked;
    if (asked == seen) {
      pause.wait();
      continue;
    }
    seen = asked;
    pause = {};
    const std::uint32_t count = page.count;
    for (std::uint32_t i = 0; i < count && i < kMostAsked; ++i) {
      session->ask(std::span(&page.queries[i], 1), answer);
      page.answers[i] = to_page(answer.front());
      if (const std::string changed = floats.check_and_restore(); !changed.empty())
        throw std::runtime_error("changed the floating-point environment: " + changed);
      page.answered = i + 1;
    }
  }
}

}  // namespace

QueryDetector worker_detector(const ImpactDetectorInfo& info, const DetectorSpec& spec,
                              const std::string& record, const std::filesystem::path& executable,
                              const WorkerLimits& limits) {
  return {spec.name, info.precision, info.kinds, [=, name = spec.name] {
            return std::make_unique<WorkerSession>(name, record, executable, limits);
          }};
}

int run_query_worker(const std::string& detector, const DetectorCatalog& catalog, int page_fd) {
  process::end_with_supervisor();
  Page* const page = process::join_page<Page>(page_fd);
  if (page == nullptr) return process::kExitInternal;
  try {
    const DetectorSpec spec = catalog.parse_impact(detector);
    auto made = catalog.find_impact(spec.id)->make(spec.options);
    page->tolerance = made->tolerance();
    page->state = Page::kReady;
    answer_blocks(*page, std::move(made));
    return 0;
  } catch (...) {
    const std::string text = text::current_exception_text();
    const std::size_t length = std::min(text.size(), kLongestFault - 1);
    std::copy_n(text.data(), length, page->fault.data());
    page->state = Page::kFailed;
    return 0;
  }
}

}  // namespace contactcheck::queries
