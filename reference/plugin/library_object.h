// A detector that a library has made, and how its functions are called.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/types/check.h"
#include "reference/plugin/plugin_library.h"

namespace contactcheck::plugin {

class LibraryObject {
 public:
  /// Makes it. `options` has a value for each that the library declares.
  /// @throws InputError, std::runtime_error when it fails
  LibraryObject(const PluginLibrary& library, const Options& options);

  const contactcheck_plugin& table() const { return library_.table(); }
  const std::string& name() const { return library_.name(); }
  void* get() const { return detector_.get(); }

  /// Calls `function(detector, arguments..., message)`.
  /// @throws RefusedInput, std::runtime_error, each with the message, when it does not succeed
  template <typename Function, typename... Arguments>
  void call(const char* name, Function function, Arguments... arguments) {
    message_.front() = '\0';
    if (const std::int32_t status = function(get(), arguments..., message_.data());
        status != CONTACTCHECK_OK)
      fail(name, status);
  }

 private:
  struct Destroy {
    void (*function)(void*);
    void operator()(void* detector) const { function(detector); }
  };
  [[noreturn]] void fail(const char* name, std::int32_t status);

  const PluginLibrary library_;
  std::array<char, CONTACTCHECK_MESSAGE_SIZE> message_ = {};
  // A null detector has nothing to destroy.
  std::unique_ptr<void, Destroy> detector_{nullptr, Destroy{nullptr}};
};

// Numbers of the header, as what they stand for.

/// @throws InputError for bits beyond `order`
template <typename Value, std::size_t N>
std::vector<Value> values_of(std::uint32_t bits, const Value (&order)[N], const char* what) {
  std::vector<Value> out;
  for (std::size_t i = 0; i < N; ++i)
    if ((bits >> i & 1u) != 0) out.push_back(order[i]);
  if (bits >> N != 0) throw InputError(std::string("declares ") + what + " that do not exist");
  return out;
}

template <typename Value, std::size_t N>
Value value_of(std::uint32_t number, const Value (&order)[N], const char* what) {
  if (number >= N)
    throw InputError(std::string("declares ") + what + " " + std::to_string(number) +
                     ", which does not exist");
  return order[number];
}

}  // namespace contactcheck::plugin
