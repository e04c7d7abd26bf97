// Certificates as JSON, in the forms that reference/judge/check.py documents and reads. A number is
// that double; a text is a rational, hexadecimal.
#pragma once

#include <string>

#include "reference/oracle/impact_certificate.h"
#include "reference/oracle/pair_certificate.h"

namespace contactcheck::oracle::certify {

/// The weights of either triangle's corners: two lists, and a comma between them.
std::string witness_text(const Witness& witness);
/// [x, y, z, offset]
std::string plane_text(const Plane& plane);
/// {"apart": ...}, without line breaks.
std::string impact_text(const ImpactCertificate& certificate);

}  // namespace contactcheck::oracle::certify
