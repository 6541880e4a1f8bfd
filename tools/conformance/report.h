#pragma once
/// The conformance report as an HTML page with SVG drawings.
#include <ostream>

#include "tools/conformance/conformance.h"

namespace shaolin {

/// One page, nothing beside it: the table of checks, the eigenvalues over the valence, and the characteristic maps.
void write_html(std::ostream& out, const ConformanceReport& report);

/// "pass", "finding", "FAIL".
const char* to_string(Verdict verdict);

}  // namespace shaolin
