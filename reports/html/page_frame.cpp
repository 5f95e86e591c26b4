#include "reports/html/page_frame.hpp"

#include "core/base/errors.hpp"
#include "reports/html/escape.hpp"
#include "reports/html/sha256.hpp"
#include "reports/html/template_check.hpp"

namespace mapproof {
namespace {

std::string policy(const std::string& style, const std::string& script) {
  return "default-src 'none'; style-src '" + policy_hash(style) + "'; script-src '" +
         policy_hash(script) + "'; img-src data:; base-uri 'none'; form-action 'none'";
}

}  // namespace

void set_page_frame(kainjow::mustache::data& page, const std::string& name,
                    const Templates& templates) {
  const auto both = [&](const std::string& extension) {
    return templates.files.at("common" + extension) + "\n" + templates.files.at(name + extension);
  };
  const std::string style = both(".css"), script = both(".js");
  page.set("policy", policy(style, script));
  page.set("style_element", "<style>" + style + "</style>");
  page.set("script_element", "<script>" + script + "</script>");
}

std::string rendered(const std::string& name, const Templates& templates,
                     const kainjow::mustache::data& page) {
  const std::string file = name + ".mustache";
  kainjow::mustache::mustache root(assembled(file, templates.files));
  root.set_custom_escape(html_escaped);
  std::string html = root.render(page);
  if (!root.is_valid()) throw IoError(templates.sources.at(file), root.error_message());
  return html;
}

}  // namespace mapproof
