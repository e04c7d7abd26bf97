#include "reference/plugin/plugin_library.h"

#include <dlfcn.h>

#include <cstddef>
#include <cstring>
#include <iterator>
#include <nlohmann/json.hpp>

#include "core/types/check.h"

namespace contactcheck::plugin {
namespace {

constexpr const char* kEntry = "contactcheck_plugin_entry";
constexpr const char* kStructs[] = {
    "plugin",         "semantics",  "option",        "setting",        "lattice",
    "body",           "body_state", "frame",         "body_pair",      "element_pair",
    "vertex_in_body", "near_pair",  "piece_contact", "vertex_contact", "answer"};
static_assert(std::size(kStructs) == CONTACTCHECK_STRUCT_COUNT);

std::string text_of(const char* text) { return text == nullptr ? "" : text; }

constexpr const char* kToldStructs[] = {"stage", "trace", "counts"};
static_assert(std::size(kToldStructs) == CONTACTCHECK_TOLD_COUNT);
constexpr const char* kImpactStructs[] = {
    "impact_semantics", "impact_query",       "impact",           "step",       "body_impact",
    "triangle_impact",  "vertex_face_impact", "edge_edge_impact", "step_answer"};
static_assert(std::size(kImpactStructs) == CONTACTCHECK_IMPACT_COUNT);
constexpr std::uint32_t kFirstVersion = 1;
// The table of an earlier version is what stands before the first field that a later one has added.
// Version 3 has added values and no fields.
constexpr std::size_t kTableSizes[] = {
    offsetof(contactcheck_plugin, told_sizes), offsetof(contactcheck_plugin, impact_sizes),
    offsetof(contactcheck_plugin, impact_sizes), sizeof(contactcheck_plugin)};
static_assert(std::size(kTableSizes) == CONTACTCHECK_PLUGIN_ABI);

std::string size_fault(const char* structure, std::uint32_t said, std::uint32_t own) {
  if (said == own) return "";
  return "gives contactcheck_" + std::string(structure) + " a size of " + std::to_string(said) +
         " bytes; here it has " + std::to_string(own);
}

// Only the first two fields may be read before they are known to be right.
std::string layout_fault(const contactcheck_plugin* table) {
  if (table == nullptr) return std::string("gave no table from ") + kEntry + "()";
  const std::uint32_t version = table->abi_version;
  if (version < kFirstVersion || version > CONTACTCHECK_PLUGIN_ABI)
    return "speaks version " + std::to_string(version) +
           " of contactcheck_plugin.h; this program speaks versions " +
           std::to_string(kFirstVersion) + " to " + std::to_string(CONTACTCHECK_PLUGIN_ABI);
  std::uint32_t own[] = CONTACTCHECK_STRUCT_SIZES;
  own[0] = static_cast<std::uint32_t>(kTableSizes[version - kFirstVersion]);
  std::string fault;
  for (std::size_t i = 0; i < std::size(own) && fault.empty(); ++i)
    fault = size_fault(kStructs[i], table->struct_sizes[i], own[i]);
  return fault;
}

std::string content_fault(const contactcheck_plugin& table) {
  if (table.id == nullptr) return "has no id";
  if (table.option_count > 0 && table.options == nullptr) return "has options at no address";
  const bool frames[] = {table.declare != nullptr, table.update != nullptr, table.query != nullptr};
  const bool moving = table.declare_impacts != nullptr;
  // Steps alone need prepare() as frames do.
  const bool any =
      frames[0] || frames[1] || frames[2] || (table.prepare != nullptr && table.step == nullptr);
  const bool all = frames[0] && frames[1] && frames[2] && table.prepare != nullptr;
  if (table.create == nullptr || table.destroy == nullptr || (any || !moving) != all ||
      moving != (table.impact != nullptr || table.step != nullptr))
    return "lacks one of its functions";
  std::string fault;
  if (table.trace != nullptr || table.counts != nullptr) {
    const std::uint32_t own[] = CONTACTCHECK_TOLD_SIZES;
    for (std::size_t i = 0; i < std::size(own) && fault.empty(); ++i)
      fault = size_fault(kToldStructs[i], table.told_sizes[i], own[i]);
  }
  if (moving) {
    const std::uint32_t own[] = CONTACTCHECK_IMPACT_SIZES;
    for (std::size_t i = 0; i < std::size(own) && fault.empty(); ++i)
      fault = size_fault(kImpactStructs[i], table.impact_sizes[i], own[i]);
  }
  return fault;
}

}  // namespace

PluginLibrary::PluginLibrary(const std::filesystem::path& file)
    : name_("library \"" + file.string() + "\"") {
  void* const library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
  if (library == nullptr) {
    const char* const error = dlerror();
    throw InputError(name_ +
                     " cannot be loaded: " + (error == nullptr ? "no reason was given" : error));
  }
  using Entry = const contactcheck_plugin* (*)();
  const auto entry = reinterpret_cast<Entry>(dlsym(library, kEntry));
  if (entry == nullptr)
    throw InputError(name_ + " is no detector: it has no function " + kEntry +
                     " (contactcheck_plugin.h)");
  const contactcheck_plugin* const table = entry();
  std::string fault = layout_fault(table);
  if (fault.empty()) {
    std::memcpy(&table_, table, table->struct_sizes[0]);
    fault = content_fault(table_);
  }
  if (!fault.empty()) throw InputError(name_ + " cannot be used: it " + fault);
}

Declaration PluginLibrary::declare() const {
  Declaration out;
  out.id = text_of(table_.id);
  out.summary = text_of(table_.summary);
  out.version = text_of(table_.version);
  Options defaults;
  for (std::uint32_t i = 0; i < table_.option_count; ++i) {
    const contactcheck_option& from = table_.options[i];
    OptionInfo& option = out.options.emplace_back();
    option.name = text_of(from.name);
    option.default_value = text_of(from.default_value);
    option.help = text_of(from.help);
    if (from.choices != nullptr)
      for (const char* const* choice = from.choices; *choice != nullptr; ++choice)
        option.choices.emplace_back(*choice);
    option.min = from.min;
    option.max = from.max;
    option.integer = from.integer != 0;
    defaults[option.name] = option.default_value;
  }
  out.impacts = impact_claims_of(*this, defaults);
  if (table_.declare == nullptr && table_.step == nullptr) {
    if (!out.impacts) throw InputError(name_ + " answers neither frames nor queries");
    return out;
  }
  const std::unique_ptr<Detector> detector = make_library_detector(*this, defaults);
  out.semantics = detector->semantics();
  if (!out.answers_frames() && !out.impacts)
    throw InputError(name_ + " answers neither frames nor queries");
  out.needs_vertices = detector->needs_vertices();
  return out;
}

}  // namespace contactcheck::plugin
