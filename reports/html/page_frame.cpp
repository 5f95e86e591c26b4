#include "reports/html/page_frame.hpp"

#include "core/base/errors.hpp"
#include "reports/html/sha256.hpp"
#include "reports/html/template_check.hpp"
#include "reports/model/format.hpp"

namespace mapproof {
namespace {

std::string policy(const std::string& style, const std::string& script) {
  return "default-src 'none'; style-src '" + policy_hash(style) + "'; script-src '" +
         policy_hash(script) + "'; img-src data:; base-uri 'none'; form-action 'none'";
}

/// The parts NAME_*.EXT in the order of their names, each with a line feed after it.
std::string parts_of(const std::string& name, const std::string& extension,
                     const Templates& templates) {
  std::string all;
  for (const auto& [file, text] : templates.files)
    if (file.starts_with(name + "_") && file.ends_with(extension)) all += text + "\n";
  return all;
}

/// common.EXT and its parts, then the parts of the page, then NAME.EXT.
std::string joined(const std::string& name, const std::string& extension,
                   const Templates& templates) {
  return templates.files.at("common" + extension) + "\n" +
         parts_of("common", extension, templates) + parts_of(name, extension, templates) +
         templates.files.at(name + extension);
}

}  // namespace

void set_page_frame(kainjow::mustache::data& page, const std::string& name,
                    const Templates& templates) {
  const std::string style = joined(name, ".css", templates);
  const std::string script = joined(name, ".js", templates);
  page.set("policy", policy(style, script));
  page.set("style_element", "<style>" + style + "</style>");
  page.set("script_element", "<script>" + script + "</script>");
}

std::string rendered(const std::string& name, const Templates& templates,
                     const kainjow::mustache::data& page) {
  const std::string file = name + ".mustache";
  kainjow::mustache::mustache root(assembled(file, templates.files, templates.sources));
  root.set_custom_escape(html_escaped);
  std::string html;
  // Not into a stream, which stops without an error if memory runs out.
  root.render(page, [&html](const std::string& part) { html += part; });
  if (!root.is_valid()) throw IoError(templates.sources.at(file), root.error_message());
  return html;
}

}  // namespace mapproof
