#include "reference/plugin/library_object.h"

#include <stdexcept>

namespace contactcheck::plugin {

LibraryObject::LibraryObject(const PluginLibrary& library, const Options& options)
    : library_(library) {
  std::vector<contactcheck_setting> settings;
  for (std::uint32_t i = 0; i < table().option_count; ++i) {
    const char* const name = table().options[i].name;
    settings.push_back({name, options.at(name).c_str()});
  }
  void* made = nullptr;
  const std::int32_t status = table().create(
      settings.data(), static_cast<std::uint32_t>(settings.size()), &made, message_.data());
  if (status != CONTACTCHECK_OK) fail("create", status);
  detector_ = {made, Destroy{table().destroy}};
}

void LibraryObject::fail(const char* name, std::int32_t status) {
  message_.back() = '\0';
  const std::string said = message_.data();
  if (status == CONTACTCHECK_REFUSED && !said.empty()) throw RefusedInput(said);
  const std::string text = std::string(name) + " failed" + (said.empty() ? "" : ": " + said);
  if (status == CONTACTCHECK_REFUSED) throw RefusedInput(text);
  throw std::runtime_error(text);
}

}  // namespace contactcheck::plugin
