#include "core/detect/families.h"

#include <algorithm>
#include <memory>

#include "core/detect/lazy_detector.h"
#include "core/detect/option_info.h"

namespace contactcheck {
namespace {

OptionInfo isa_option() {
  std::vector<std::string> choices = compiled_lazy_isas();
  choices.insert(choices.begin(), "best");
  // Suites name them on every machine; where one is missing its detector is absent.
  for (const char* other : {"AVX3", "AVX2", "SSE4", "NEON"})
    if (std::find(choices.begin(), choices.end(), other) == choices.end())
      choices.emplace_back(other);
  return choice_option("isa", "best", std::move(choices),
                       "instruction set of the inner loops (AVX3: AVX-512)");
}

OptionInfo threads_option() {
  return numeric_option("threads", "1", 1, 256, true, "contacts do not depend on it");
}

std::size_t threads_of(const Options& options) {
  return static_cast<std::size_t>(number_option(options, "threads"));
}

void add_ffd_lazy(DetectorCatalog& catalog) {
  DetectorInfo info;
  info.id = "ffd-lazy";
  info.summary = "tree bounded lazily from lattice nodes, SIMD; exact triangle test";
  info.given =
      "lattice nodes; sweep and prune over the bodies' boxes of nodes; bodies that meet no other "
      "are not bounded; exact tests eight at a time; body ends at the first contact of two bodies";
  info.options = {choice_option("bounds", "auto", {"auto", "nodes"},
                                "auto: bodies small for their lattice are mapped and refitted"),
                  isa_option(), threads_option(), precision_option()};
  info.make = [](const Options& options) -> std::unique_ptr<Detector> {
    LazyConfig config;
    config.bounds = options.at("bounds") == "auto" ? BoundSource::kCheaper : BoundSource::kNodes;
    config.isa = options.at("isa");
    config.threads = threads_of(options);
    config.precision = precision_of(options);
    return std::make_unique<LazyDetector>(config);
  };
  catalog.add(std::move(info));
}

void add_full_refit(DetectorCatalog& catalog) {
  DetectorInfo info;
  info.id = "full-refit";
  info.summary = "the same tree and tests, refitted to all mapped vertices in every frame";
  info.given =
      "sweep and prune over the bodies' boxes; all bodies are refitted, with or without a partner; "
      "exact tests eight at a time; body ends at the first contact of two bodies";
  info.options = {isa_option(), threads_option(), precision_option()};
  info.make = [](const Options& options) -> std::unique_ptr<Detector> {
    return std::make_unique<LazyDetector>(LazyConfig{BoundSource::kVertices, options.at("isa"),
                                                     threads_of(options), precision_of(options)});
  };
  catalog.add(std::move(info));
}

}  // namespace

void register_lazy_detectors(DetectorCatalog& catalog) {
  add_ffd_lazy(catalog);
  add_full_refit(catalog);
}

}  // namespace contactcheck
