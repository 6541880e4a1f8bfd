#pragma once
/// What the pages of reports share.
#include <string>

namespace shaolin {

/// The style sheet of all pages. Cells of class n hold numbers; svg and img stand in figures.
extern const char* const html_style;

/// Text with the characters that HTML reserves replaced.
std::string html_escaped(const std::string& text);

/// A page's beginning: the document's head and its heading. The caller writes the rest, and "</html>".
std::string html_head(const std::string& title, const std::string& heading);

}  // namespace shaolin
