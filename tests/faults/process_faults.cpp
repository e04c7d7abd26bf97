#include "tests/faults/process_faults.h"

#include <fenv.h>
#include <signal.h>
#include <unistd.h>

#include <clocale>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <locale>
#include <stdexcept>
#include <thread>
#include <utility>

#include "core/detect/option_info.h"
#include "tests/faults/broken_detectors.h"

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace contactcheck::test {
namespace {

using Strike = void (*)();

class StrikingDetector : public TruthfulDetector {
 public:
  StrikingDetector(Strike strike, const Options& options)
      : strike_(strike),
        phase_(options.at("phase")),
        target_(static_cast<std::size_t>(number_option(options, "frame"))) {}

  void prepare(const std::vector<Body>& bodies) override {
    TruthfulDetector::prepare(bodies);
    if (phase_ == "prepare") strike_();
  }
  void update(const Frame& frame) override {
    TruthfulDetector::update(frame);
    frame_ = frame.index;
    // A detector that is judged is asked all questions about a frame; one that is timed, a single
    // one.
    timed_ = asked_ == 1;
    asked_ = 0;
    if (frame_ != target_) return;
    ++updates_;
    if (phase_ == "update" || (phase_ == "update-again" && updates_ == 2) ||
        (phase_ == "update-timed" && timed_))
      strike_();
  }
  void query(Question question, ContactSet& out) override {
    TruthfulDetector::query(question, out);
    ++asked_;
    // The detector's own question comes first, and is asked once a frame.
    if (frame_ != target_ || question != semantics().questions.front()) return;
    ++queries_;
    if (phase_ == "query" || (phase_ == "again" && queries_ == 2) || (phase_ == "timed" && timed_))
      strike_();
  }

 private:
  Strike strike_;
  std::string phase_;
  std::size_t target_, frame_ = 0, updates_ = 0, queries_ = 0, asked_ = 0;
  bool timed_ = false;
};

// By the signal itself, also where a sanitizer has taken its handler over.
void die(int number) {
  signal(number, SIG_DFL);
  raise(number);
}

void crash() { die(SIGSEGV); }

void leave() { std::exit(0); }
void leave_at_once() { _exit(0); }

void loop() {
  for (volatile bool forever = true; forever;) {
  }
}

void eat_memory() {
  constexpr std::size_t kBlock = std::size_t{16} << 20, kMost = 256;  // 4 GiB at most
  std::vector<std::vector<char>> blocks;
  while (blocks.size() < kMost) {
    blocks.emplace_back(kBlock, char{1});
    usleep(2'000);
  }
}

void flood() {
  const std::string line(1 << 16, 'x');
  for (int i = 0; i < 1 << 15; ++i) {  // 2 GiB at most
    if (write(STDOUT_FILENO, line.data(), line.size()) < 0) return;
    if (i % 64 == 0) usleep(1'000);
  }
}

void throw_text() { throw std::runtime_error("caf\xe9\tis shut\nsecond line"); }
void throw_int() { throw 7; }

void terminate_in_a_thread() {
  std::thread([] { throw std::runtime_error("nobody catches this"); }).join();
}

void round_up() { fesetround(FE_UPWARD); }

void flush_to_zero() {
#if defined(__SSE__)
  _mm_setcsr(_mm_getcsr() | 0x8040u);
#endif
}

void trap() {
  feclearexcept(FE_ALL_EXCEPT);
  feenableexcept(FE_ALL_EXCEPT);
}

void talk() {
  std::printf("\n\x1b[31mhello\x07 from a library\nsecond line\n");
  std::cout << "third line" << std::endl;
  std::fputs("a warning\n", stderr);
}

void close_streams() {
  std::fclose(stdout);
  close(STDERR_FILENO);
}

struct DecimalComma : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\1"; }
};

void change_locale() {
  std::setlocale(LC_ALL, "C.UTF-8");
  std::locale::global(std::locale(std::locale::classic(), new DecimalComma));
}

void change_directory() {
  if (chdir("/") != 0) std::abort();
}

void crash_in_handler(int) { die(SIGSEGV); }

// The alarm would ring in another detector's turn, on a busy machine too.
void change_signals() {
  signal(SIGALRM, crash_in_handler);
  signal(SIGUSR1, crash_in_handler);
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGUSR1);
  sigprocmask(SIG_BLOCK, &set, nullptr);
  raise(SIGUSR1);
  ualarm(900'000, 0);
}

void crash_at_exit() {
  std::atexit([] { die(SIGSEGV); });
}

// A child that sleeps on, with the worker's streams open.
void leave_child() {
  const pid_t child = fork();
  if (child == 0) {
    sleep(300);
    _exit(0);
  }
  std::printf("child %d\n", static_cast<int>(child));
}

// Both copies of the worker go on from here, the second one first; the first then crashes.
void fork_copy() {
  const pid_t child = fork();
  if (child < 0) std::abort();
  if (child == 0) return;
  usleep(200'000);
  crash();
}

struct Fault {
  const char* id;
  const char* summary;
  Strike strike;
};

constexpr Fault kFaults[] = {
    {"fault-none", "does nothing wrong", [] {}},
    {"fault-crash", "segmentation fault", crash},
    {"fault-abort", "aborts", std::abort},
    {"fault-exit", "leaves through exit", leave},
    {"fault-quick-exit", "leaves through _exit", leave_at_once},
    {"fault-hang", "endless loop", loop},
    {"fault-memory", "allocates without end", eat_memory},
    {"fault-flood", "prints without end", flood},
    {"fault-throw", "throws a text that is no UTF-8", throw_text},
    {"fault-throw-int", "throws an int", throw_int},
    {"fault-terminate-thread", "throws in a thread of its own", terminate_in_a_thread},
    {"fault-rounding", "leaves the rounding mode changed", round_up},
    {"fault-flush", "leaves flush-to-zero set", flush_to_zero},
    {"fault-trap", "lets floating-point exceptions trap", trap},
    {"fault-stdout", "prints", talk},
    {"fault-close", "closes the standard streams", close_streams},
    {"fault-locale", "asks for a decimal comma", change_locale},
    {"fault-directory", "changes the working directory", change_directory},
    {"fault-signals", "handles signals, blocks one, sets an alarm", change_signals},
    {"fault-at-exit", "crashes when the process ends", crash_at_exit},
    {"fault-children", "leaves a child behind", leave_child},
    {"fault-fork", "forks, lets the copy run on and crashes", fork_copy},
};

}  // namespace

void register_process_faults(DetectorCatalog& catalog) {
  for (const Fault& fault : kFaults) {
    DetectorInfo info;
    info.id = fault.id;
    info.summary = fault.summary;
    info.options = {choice_option("phase", "update",
                                  {"prepare", "update", "query", "again", "update-again", "timed",
                                   "update-timed"},
                                  "where it strikes"),
                    numeric_option("frame", "2", 0, 1000, true, "when it strikes")};
    info.make = [strike = fault.strike](const Options& options) {
      return std::make_unique<StrikingDetector>(strike, options);
    };
    catalog.add(std::move(info));
  }
}

}  // namespace contactcheck::test
