#pragma once

#include <map>
#include <string>

namespace mapproof {

/// Throws unless each text can be used: templates parse, include only one another, never themselves
/// and not more than a page holds; the style sheet and the script cannot end their element.
/// @param sources  Where each file of `files` came from, for messages.
/// @throws IoError "<source>: line: what".
void check_templates(const std::map<std::string, std::string>& files,
                     const std::map<std::string, std::string>& sources);

/// The text of `name` with every template it includes in place of the tag; after check_templates.
/// @throws IoError as check_templates does: if that takes more than 1000 includes or 16 MiB, among
///         others.
std::string assembled(const std::string& name, const std::map<std::string, std::string>& files,
                      const std::map<std::string, std::string>& sources);

}  // namespace mapproof
