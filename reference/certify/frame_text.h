// The certificate of a frame as JSON: truth/frame_NNNN.json of an export.
#pragma once

#include <string>
#include <vector>

#include "reference/certify/frame_certificate.h"

namespace contactcheck::certify {

/// One contact or gap a line. `bodies`: the pairs of bodies in contact, canonical.
std::string frame_text(std::size_t frame, const std::vector<BodyPair>& bodies,
                       const FrameCertificate& certificate);

}  // namespace contactcheck::certify
