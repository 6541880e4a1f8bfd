#include "tools/cli/html.h"

namespace shaolin {

const char* const html_style =
    "body{font:15px/1.45 system-ui,sans-serif;margin:2rem auto;max-width:68rem;color:#222}"
    "table{border-collapse:collapse}td,th{padding:.25rem .7rem;text-align:left;border-bottom:1px solid #ddd}"
    "td.n,th.n{text-align:right;font-variant-numeric:tabular-nums}td.paper{color:#777}"
    ".pass{color:#18794e}.finding{color:#a15c00}"
    ".FAIL{color:#c62828;font-weight:bold}svg,img{background:#fff;max-width:100%}figure{display:inline-block;"
    "margin:.6rem}figcaption{text-align:center;color:#555}";

std::string html_escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '<') {
      result += "&lt;";
    } else if (c == '&') {
      result += "&amp;";
    } else {
      result += c;
    }
  }
  return result;
}

std::string html_head(const std::string& title, const std::string& heading) {
  return "<!doctype html><html lang=en><meta charset=utf-8><title>" + html_escaped(title) + "</title><style>" +
         html_style + "</style>\n<h1>" + html_escaped(heading) + "</h1>\n";
}

}  // namespace shaolin
