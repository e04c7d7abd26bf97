#include "core/detect/registry.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include "core/types/check.h"
#include "core/types/shortest.h"
#include "core/types/suggestion.h"

namespace contactcheck {
namespace {

/// Below it every whole number is a double, and a long long.
constexpr double kLargestPlainInteger = 0x1p53;

std::string join(const std::vector<std::string>& words) {
  std::string out;
  for (const std::string& w : words) out += (out.empty() ? "" : ", ") + w;
  return out;
}

/// A whole number in digits, as strtol reads it: 1000000 and not 1e+06.
std::string text_of(const OptionInfo& option, double value) {
  if (option.integer && std::abs(value) < kLargestPlainInteger)
    return std::to_string(static_cast<long long>(value));
  return shortest(value + 0.0);  // -0 is 0
}

std::string checked_number(const std::string& detector, const OptionInfo& option,
                           const std::string& text) {
  double value = 0.0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool number = end.ec == std::errc() && end.ptr == text.data() + text.size();
  const bool in_range = number && value >= option.min && value <= option.max;  // false for NaN
  if (!in_range || (option.integer && value != std::floor(value))) {
    throw InputError("detector \"" + detector + "\": option " + option.name + " is \"" + text +
                     "\"; allowed: " + (option.integer ? "a whole number" : "a number") + " from " +
                     text_of(option, option.min) + " to " + text_of(option, option.max));
  }
  return text_of(option, value);
}

std::string checked_value(const std::string& detector, const OptionInfo& option,
                          const std::string& text) {
  if (option.choices.empty()) return checked_number(detector, option, text);
  if (std::find(option.choices.begin(), option.choices.end(), text) == option.choices.end()) {
    throw InputError("detector \"" + detector + "\": option " + option.name + " is \"" + text +
                     "\"; allowed: " + join(option.choices));
  }
  return text;
}

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  while (true) {
    const std::size_t at = text.find(separator);
    parts.emplace_back(text.substr(0, at));
    if (at == std::string_view::npos) return parts;
    text.remove_prefix(at + 1);
  }
}

template <typename Info>
const OptionInfo& option_named(const Info& info, std::string_view text, const std::string& name) {
  for (const OptionInfo& option : info.options)
    if (option.name == name) return option;
  std::vector<std::string> names;
  for (const OptionInfo& option : info.options) names.push_back(option.name);
  throw InputError("detector \"" + std::string(text) + "\": unknown option \"" + name + "\"; " +
                   info.id + " knows " + (names.empty() ? "no options" : join(names)));
}

template <typename Info>
std::string canonical_name(const Info& info, const Options& options) {
  std::string text;
  for (const auto& [name, value] : options) {
    const OptionInfo& option = option_named(info, info.id, name);
    if (value != option.default_value) text += (text.empty() ? ":" : ",") + name + "=" + value;
  }
  return info.id + text;
}

template <typename Info>
const Info* find_in(const std::vector<Info>& infos, std::string_view id) {
  for (const Info& info : infos)
    if (info.id == id) return &info;
  return nullptr;
}

template <typename Info>
void add_to(std::vector<Info>& infos, Info info) {
  CONTACTCHECK_INVARIANT(find_in(infos, info.id) == nullptr, "detector ids are unique: " + info.id);
  // In the form that parse gives values, so that canonical names can leave defaults out.
  for (OptionInfo& option : info.options)
    option.default_value = checked_value(info.id, option, option.default_value);
  infos.push_back(std::move(info));
}

template <typename Info>
std::vector<std::string> ids_of(const std::vector<Info>& infos) {
  std::vector<std::string> ids;
  for (const Info& info : infos) ids.push_back(info.id);
  return ids;
}

template <typename Info>
DetectorSpec spec_of(const Info& info, std::string_view text) {
  DetectorSpec spec;
  spec.id = info.id;
  for (const OptionInfo& option : info.options) spec.options[option.name] = option.default_value;
  const std::size_t colon = text.find(':');
  if (colon != std::string_view::npos) {
    std::set<std::string> given;
    for (const std::string& part : split(text.substr(colon + 1), ',')) {
      const std::size_t equals = part.find('=');
      if (equals == std::string::npos) {
        throw InputError("detector \"" + std::string(text) + "\": \"" + part +
                         "\" is not of the form option=value");
      }
      const OptionInfo& option = option_named(info, text, part.substr(0, equals));
      if (!given.insert(option.name).second) {
        throw InputError("detector \"" + std::string(text) + "\": option " + option.name +
                         " is given twice");
      }
      spec.options[option.name] = checked_value(std::string(text), option, part.substr(equals + 1));
    }
  }
  spec.name = canonical_name(info, spec.options);
  return spec;
}

std::string id_in(std::string_view text) { return std::string(text.substr(0, text.find(':'))); }

}  // namespace

void DetectorCatalog::add(DetectorInfo info) { add_to(infos_, std::move(info)); }
void DetectorCatalog::add(ImpactDetectorInfo info) { add_to(impact_infos_, std::move(info)); }

const DetectorInfo* DetectorCatalog::find(std::string_view id) const { return find_in(infos_, id); }
const ImpactDetectorInfo* DetectorCatalog::find_impact(std::string_view id) const {
  return find_in(impact_infos_, id);
}

DetectorSpec DetectorCatalog::parse(std::string_view text) const {
  const std::string id = id_in(text);
  if (const DetectorInfo* const info = find(id)) return spec_of(*info, text);
  if (find_impact(id) != nullptr)
    throw InputError("detector \"" + id + "\" answers queries of moving elements alone; " +
                     "`contactcheck queries` asks it");
  throw InputError("unknown detector \"" + id + "\"; " + suggestion(id, ids_of(infos_)) +
                   "`contactcheck list` names all");
}

DetectorSpec DetectorCatalog::parse_impact(std::string_view text) const {
  const std::string id = id_in(text);
  if (const ImpactDetectorInfo* const info = find_impact(id)) return spec_of(*info, text);
  const std::vector<std::string> ids = ids_of(impact_infos_);
  throw InputError("no detector of queries is named \"" + id + "\"; there are " + join(ids));
}

std::unique_ptr<Detector> DetectorCatalog::make(const DetectorSpec& spec) const {
  const DetectorInfo* info = find(spec.id);
  CONTACTCHECK_INVARIANT(info != nullptr && info->make, "only built detectors are made");
  return info->make(spec.options);
}

double number_option(const Options& options, const std::string& name) {
  const std::string& text = options.at(name);
  double value = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

}  // namespace contactcheck
