// The messages of the pipe protocol: a line of JSON, followed by as many bytes as its key `bytes`
// says. README.md in this folder describes them for those who write the other side.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/deform/body.h"
#include "core/detect/impact_detector.h"
#include "core/types/contact_set.h"
#include "core/types/frame.h"
#include "core/types/impact.h"
#include "core/types/semantics.h"
#include "reference/plugin/declaration.h"
#include "reference/plugin/step_answer.h"

namespace contactcheck::plugin {

constexpr const char* kPipeProtocol = "contactcheck-pipe/1";    ///< with its version
constexpr std::size_t kLargestAnswer = std::size_t{256} << 20;  ///< bytes behind a line

std::string hello_message();
/// Bodies at rest, with their lattices.
std::string prepare_message(const std::vector<Body>& bodies, const Options& options);
/// `needs` says whether vertices, nodes or both follow.
std::string frame_message(const Frame& frame, const Declaration& needs);
/// Both ends, one after the other, each as in frame_message().
std::string step_message(const Step& step, const Declaration& needs);
std::string query_message(Question question);
/// One query of moving elements: the places of four points at t = 0, then at t = 1.
std::string impact_message(const ImpactQuery& query);

/// A line that was read, as what it must be.
class Reply {
 public:
  /// `from` names the other side in messages.
  /// @throws InputError when it is no JSON object, or of another kind than `message`; what the
  /// other side says went wrong (messages `error` and `refused`) as std::runtime_error and
  /// RefusedInput
  Reply(const std::string& line, std::string from, const char* message);
  Reply(const Reply&) = delete;
  Reply& operator=(const Reply&) = delete;

  text::JsonField root() const { return {value_, from_}; }
  /// What the other side says this took, nanoseconds (key `ms`).
  std::optional<double> reported_ns() const;
  /// Bytes that follow. @throws InputError beyond kLargestAnswer
  std::size_t bytes() const;

 private:
  std::string from_;
  text::JsonValue value_;
};

/// What an answer of the kind `impact` says. @throws InputError for values of another type
ReportedImpact read_impact(const Reply& reply);

/// Appends the contacts that follow an answer of the kind `contacts`: those of frames to `out`,
/// those within steps to `steps`.
/// @throws InputError when the counts of the line and the number of bytes do not agree
void read_contacts(const Reply& reply, std::string_view bytes, ContactSet& out, StepAnswer& steps);
/// The sizes alone: what read_contacts will throw for can be known before anything is read.
void check_contact_counts(const Reply& reply);

}  // namespace contactcheck::plugin
