#pragma once

#include <map>
#include <string>

namespace mapproof {

/// Throws unless each text can be used: templates parse, include only one another and never
/// themselves; the style sheet and the script cannot end their element.
/// @param sources  Where each file of `files` came from, for messages.
/// @throws IoError "<source>: line: what".
void check_templates(const std::map<std::string, std::string>& files,
                     const std::map<std::string, std::string>& sources);

/// The text of `name` with every template it includes in place of the tag; after check_templates.
/// @throws IoError if that takes more than 1000 includes or 16 MiB.
std::string assembled(const std::string& name, const std::map<std::string, std::string>& files);

}  // namespace mapproof
