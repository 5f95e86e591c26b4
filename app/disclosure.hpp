#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mapproof {

/// What records and pages may say of the person and the machine that made them: by default no
/// user, no host, no home folder and no e-mail address, so that they can be handed to anybody.
class Disclosure {
 public:
  /// @param full  Nothing is left out.
  explicit Disclosure(bool full);

  /// The text with "~" for the home folder: as it is, and as JSON, HTML and URLs write it.
  std::string text(std::string text) const;

  /// Words of a command line: the same, "USER", "HOST" and "E-MAIL" for parts of paths that are the
  /// user, the host or an address, and absolute paths outside the home folder as paths from the
  /// working folder, unless they have nothing but the root in common with it.
  std::vector<std::string> words(std::vector<std::string> words) const;

  /// The name of this machine; if it is not to be named, "host-" and eight hexadecimal digits,
  /// which are the same each time on this machine: nightly runs compare seconds of one machine.
  std::string host() const;

 private:
  bool full_;
  std::vector<std::string> homes_;  ///< In every spelling, the longest first.
  std::vector<std::pair<std::string, std::string>> names_;  ///< A part of a path, and its word.
};

}  // namespace mapproof
