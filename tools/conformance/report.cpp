#include "tools/conformance/report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <numbers>

#include "tools/cli/html.h"

namespace shaolin {

namespace {

void write_checks(std::ostream& out, const ConformanceReport& report) {
  out << "<h2>Checks</h2>\n<table><tr><th>check</th><th>worst at</th><th>figure</th><th>bar</th><th>verdict</th>"
         "<th></th></tr>\n";
  for (const CheckResult& check : report.checks)
    out << "<tr><td>" << html_escaped(check.name) << "</td><td>" << html_escaped(check.subject) << "</td><td class=n>"
        << check.figure << "</td><td class=n>" << check.bar << "</td><td class=" << to_string(check.verdict) << ">"
        << to_string(check.verdict) << "</td><td>" << html_escaped(check.note) << "</td></tr>\n";
  out << "</table>\n";
}

/// Moduli of the eigenvalues below 1, over the number of faces.
void write_spectrum(std::ostream& out, const ConformanceReport& report, StarKind kind) {
  constexpr double width = 460, height = 260, left = 40, top = 10;
  int most = 0;
  for (const SpectrumRow& row : report.spectra)
    if (row.kind == kind) most = std::max(most, row.faces);
  const auto x = [&](double faces) { return left + (width - left - 10) * faces / (most + 1); };
  const auto y = [&](double modulus) { return top + (height - top - 30) * (1 - modulus); };
  out << "<figure><svg width=" << width << " height=" << height << " font-size=11>\n";
  for (const double modulus : {0.0, 0.25, 0.5, 0.75, 1.0})
    out << "<line x1=" << left << " x2=" << width - 10 << " y1=" << y(modulus) << " y2=" << y(modulus)
        << " stroke=#ddd /><text x=6 y=" << y(modulus) + 4 << ">" << modulus << "</text>\n";
  constexpr std::array colours{"#999", "#1f6feb", "#1f6feb", "#d9730d", "#888", "#bbb"};
  for (const SpectrumRow& row : report.spectra) {
    if (row.kind != kind) continue;
    for (std::size_t i = row.moduli.size(); i-- > 1;)
      out << "<circle cx=" << x(row.faces) << " cy=" << y(row.moduli[i]) << " r=3 fill=" << colours[i]
          << " fill-opacity=.7 />";
  }
  for (int faces = 5; faces <= most; faces += 5)
    out << "<text x=" << x(faces) - 6 << " y=" << height - 12 << ">" << faces << "</text>";
  out << "</svg><figcaption>" << to_string(kind)
      << ": |eigenvalues| below 1 over the number of faces</figcaption></figure>\n";
}

/// All sectors of the ring, and its images under the eigenvalue, as rotated copies of one.
void write_map(std::ostream& out, const CharacteristicMap& map) {
  constexpr double side = 200, middle = side / 2;
  double reach = 0;
  for (const auto& line : map.lines)
    for (const Eigen::Vector2d& p : line) reach = std::max(reach, p.norm());
  const double scale = 0.94 * middle / reach;
  out << "<figure><svg width=" << side << " height=" << side << ">\n<defs><g id=sector" << map.faces
      << " fill=none stroke=#1f6feb stroke-width=.8>\n";
  for (const auto& line : map.lines) {
    out << "<polyline points='";
    for (const Eigen::Vector2d& p : line) out << scale * p.x() << ',' << -scale * p.y() << ' ';
    out << "'/>\n";
  }
  out << "</g></defs>\n";
  for (int i = 0; i < map.faces; ++i)
    out << "<use href='#sector" << map.faces << "' transform='translate(" << middle << ' ' << middle << ") rotate("
        << -360.0 * i / map.faces << ")'/>\n";
  out << "</svg><figcaption>valence " << map.faces << (map.is_injective() ? "" : ": NOT injective")
      << "</figcaption></figure>\n";
}

}  // namespace

const char* to_string(Verdict verdict) {
  constexpr std::array names{"pass", "finding", "FAIL"};
  return names[static_cast<std::size_t>(verdict)];
}

void write_html(std::ostream& out, const ConformanceReport& report) {
  out << html_head(report.scheme,
                   "The scheme " + report.scheme + ": " + (report.passed() ? "conforms" : "does not conform"))
      << "<p>"
      << (report.face_kind == FaceKind::triangle ? "Triangles, each split into four."
                                                 : "Quads, each split into four; an n-gon first into n.")
      << "</p>\n"
      << std::setprecision(3);
  write_checks(out, report);
  out << "<h2>Spectra</h2>\n<p>Blue: the two eigenvalues after 1, which belong to the tangents. Orange: the "
         "next.</p>\n";
  for (const StarKind kind : {StarKind::smooth, StarKind::dart, StarKind::crease, StarKind::corner})
    write_spectrum(out, report, kind);
  out << "<h2>Characteristic maps</h2>\n";
  for (const CharacteristicMap& map : report.maps) write_map(out, map);
  out << "</html>\n";
}

}  // namespace shaolin
