#include "reference/plugin/plugin_library.h"

#include <dlfcn.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "core/types/check.h"

namespace contactcheck {
namespace {

constexpr const char* kEntry = "contactcheck_plugin_entry";
constexpr const char* kStructs[] = {
    "plugin",         "semantics",  "option",        "setting",        "lattice",
    "body",           "body_state", "frame",         "body_pair",      "element_pair",
    "vertex_in_body", "near_pair",  "piece_contact", "vertex_contact", "answer"};
static_assert(std::size(kStructs) == CONTACTCHECK_STRUCT_COUNT);

using Entry = const contactcheck_plugin* (*)();

Entry entry_of(void* library) { return reinterpret_cast<Entry>(dlsym(library, kEntry)); }

std::string last_error() {
  const char* const text = dlerror();
  return text == nullptr ? "no reason was given" : text;
}

std::string text_of(const char* text) { return text == nullptr ? "" : text; }

// Nothing but the first two fields may be read before they are known to be right.
std::string table_fault(const contactcheck_plugin* table) {
  if (table == nullptr) return std::string(kEntry) + "() gave no table";
  if (table->abi_version != CONTACTCHECK_PLUGIN_ABI)
    return "speaks version " + std::to_string(table->abi_version) +
           " of contactcheck_plugin.h; this program speaks version " +
           std::to_string(CONTACTCHECK_PLUGIN_ABI);
  const std::uint32_t own[] = CONTACTCHECK_STRUCT_SIZES;
  for (std::size_t i = 0; i < std::size(own); ++i)
    if (table->struct_sizes[i] != own[i])
      return "gives contactcheck_" + std::string(kStructs[i]) + " a size of " +
             std::to_string(table->struct_sizes[i]) + " bytes; here it has " +
             std::to_string(own[i]);
  if (table->id == nullptr) return "has no id";
  if (table->option_count > 0 && table->options == nullptr) return "has options at no address";
  const bool complete = table->create != nullptr && table->destroy != nullptr &&
                        table->declare != nullptr && table->prepare != nullptr &&
                        table->update != nullptr && table->query != nullptr;
  return complete ? "" : "lacks one of its functions";
}

OptionInfo option_of(const contactcheck_option& option) {
  OptionInfo out;
  out.name = text_of(option.name);
  out.default_value = text_of(option.default_value);
  out.help = text_of(option.help);
  if (option.choices != nullptr)
    for (const char* const* choice = option.choices; *choice != nullptr; ++choice)
      out.choices.emplace_back(*choice);
  out.min = option.min;
  out.max = option.max;
  out.integer = option.integer != 0;
  return out;
}

}  // namespace

PluginLibrary::PluginLibrary(const std::filesystem::path& file)
    : name_("library \"" + file.string() + "\"") {
  void* const library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
  if (library == nullptr) throw InputError(name_ + " cannot be loaded: " + last_error());
  const Entry entry = entry_of(library);
  if (entry == nullptr)
    throw InputError(name_ + " is no detector: it has no function " + kEntry +
                     " (contactcheck_plugin.h)");
  table_ = entry();
  const std::string fault = table_fault(table_);
  if (!fault.empty()) throw InputError(name_ + " cannot be used: it " + fault);
}

std::vector<OptionInfo> PluginLibrary::options() const {
  std::vector<OptionInfo> out;
  for (std::uint32_t i = 0; i < table_->option_count; ++i)
    out.push_back(option_of(table_->options[i]));
  return out;
}

Declaration PluginLibrary::declare() const {
  Declaration out;
  out.id = text_of(table_->id);
  out.summary = text_of(table_->summary);
  out.version = text_of(table_->version);
  out.options = options();
  Options defaults;
  for (const OptionInfo& option : out.options) defaults[option.name] = option.default_value;
  const std::unique_ptr<Detector> detector = make_library_detector(*this, defaults);
  out.semantics = detector->semantics();
  out.needs_vertices = detector->needs_vertices();
  return out;
}

}  // namespace contactcheck
