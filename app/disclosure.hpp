#pragma once

#include <filesystem>
#include <string>
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

  /// Words of a command line: the same; "USER", "HOST" and "E-MAIL" for parts of paths that are the
  /// user, the host or an address; an absolute path is one from the working folder if it is in it,
  /// and otherwise its last name: "…/plaza".
  std::vector<std::string> words(std::vector<std::string> words) const;

  /// Words of the command of a method of others: the same wherever the study is made, so that no
  /// path is one from the working folder.
  std::vector<std::string> method_command(std::vector<std::string> words) const;

  /// The name of this machine; if it is not to be named, "host-" and eight hexadecimal digits,
  /// which are the same each time on this machine: nightly runs compare seconds of one machine.
  std::string host() const;

 private:
  /// @param here  The working folder; empty: no path is one from it.
  std::string word(std::string word, const std::filesystem::path& here) const;

  bool full_;
  std::vector<std::string> homes_;  ///< In every spelling, the longest first.
  std::vector<std::pair<std::string, std::string>> names_;  ///< A part of a path, and its word.
};

}  // namespace mapproof
