#pragma once
/// The lexical side of OBJ: statements, words, comments, continued lines.
#include <algorithm>
#include <cstddef>
#include <string_view>
#include <utility>

namespace shaolin {

/// Walks over the words of a text, statement by statement. A backslash at the end of a line continues the statement
/// on the next one; a word that begins with '#' ends the line (and such a comment is never continued).
class Words {
 public:
  explicit Words(std::string_view text) : at_(text.data()), end_(at_ + text.size()) {}

  bool at_end() const { return at_ == end_; }
  int line() const { return line_; }  ///< the line in which the statement begins

  /// The statement's next word; empty at its end.
  std::string_view next() {
    skip_blanks();
    const char* const begin = at_;
    while (at_ != end_ && *at_ != '\n' && !is_blank(*at_) && !continuation()) ++at_;
    return {begin, static_cast<std::size_t>(at_ - begin)};
  }

  /// Skips what is left of the statement and goes to the next one.
  void end_statement() {
    while (!next().empty()) {
    }
    if (at_ != end_) ++at_;
    line_ += 1 + std::exchange(continuations_, 0);
  }

 private:
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

  /// The beginning of the next line if a continuing backslash stands here, else null.
  const char* continuation() const {
    if (*at_ != '\\') return nullptr;
    const char* const after = std::find_if_not(at_ + 1, end_, is_blank);
    if (after == end_) return end_;
    return *after == '\n' ? after + 1 : nullptr;
  }

  void skip_blanks() {
    while (at_ != end_) {
      if (is_blank(*at_)) {
        ++at_;
      } else if (const char* const next_line = continuation()) {
        at_ = next_line;
        ++continuations_;
      } else {
        if (*at_ == '#') at_ = std::find(at_, end_, '\n');
        return;
      }
    }
  }

  const char* at_;
  const char* end_;
  int line_ = 1;
  int continuations_ = 0;
};

}  // namespace shaolin
