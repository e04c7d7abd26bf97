// The page of a check: the contacts in a list, counts and depths over the frames, and some frames
// in 3D.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "reference/check/check_summary.h"
#include "reference/check/frame_words.h"
#include "reference/scene/scene.h"

namespace contactcheck::check {

/// The most frames with geometry on a page, and bytes of it, compressed as in html.h: base64 makes
/// 5 MB of them.
inline constexpr std::size_t kShownFrames = 20, kPageView = 3'700'000;
/// The most contacts in the list of a page: each is a row that a browser lays out.
inline constexpr std::size_t kPageContacts = 2000;

/// What the page shows in 3D: the first frame, the deepest, and others evenly, both ends of a step
/// that is not allowed. Ascending.
std::vector<std::size_t> shown_frames(const CheckSummary& summary, std::size_t most);

/// HTML. `files`: those of each body, as words of a shell; may be empty. Reads the frames that
/// it shows once more.
/// @pre report::has_html_report(). @throws InputError if one of them cannot be read any more
std::string check_page(const scene::Scene& scene, const FrameWords& words,
                       const CheckSummary& summary, const std::string& command,
                       const std::vector<std::string>& files);

}  // namespace contactcheck::check
