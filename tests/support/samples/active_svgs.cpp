#include "tests/support/samples/active_svgs.hpp"

#include <utility>
#include <vector>

namespace mapproof::test {
namespace {

using Bodies = std::vector<std::pair<std::string, std::string>>;

std::string svg_of(const std::string& body) {
  return "<svg xmlns='http://www.w3.org/2000/svg' xmlns:xlink='http://www.w3.org/1999/xlink' "
         "xmlns:h='http://www.w3.org/1999/xhtml' xmlns:e='urn:other' "
         "xmlns:dc='http://purl.org/dc/elements/1.1/' width='9' height='9'>" +
         body + "</svg>";
}

const Bodies& elements() {
  static const Bodies all = {
      {"script", "<script>x()</script>"},
      {"script-in-capitals", "<SCRIPT>x()</SCRIPT>"},
      {"script-of-html", "<h:script>x()</h:script>"},
      {"script-of-html-by-default", "<script xmlns='http://www.w3.org/1999/xhtml'>x()</script>"},
      {"script-of-no-name-space", "<script xmlns=''>x()</script>"},
      {"script-of-another-name-space", "<e:script>x()</e:script>"},
      {"frame-of-html", "<h:iframe src='http://x.invalid'/>"},
      {"image-of-html", "<h:img src='http://x.invalid'/>"},
      {"paragraph-of-html", "<h:p>text</h:p>"},
      {"link-of-html", "<h:link rel='stylesheet' href='http://x.invalid'/>"},
      {"object", "<object data='x.svg'/>"},
      {"foreign-object", "<foreignObject/>"},
      {"foreign-object-in-small-letters", "<foreignobject/>"},
      {"math", "<m:math xmlns:m='http://www.w3.org/1998/Math/MathML'/>"},
      {"inclusion", "<i:include xmlns:i='http://www.w3.org/2001/XInclude' href='x'/>"},
      {"transformation", "<t:stylesheet xmlns:t='http://www.w3.org/1999/XSL/Transform'/>"},
      {"handler", "<handler type='text/ecmascript'>x()</handler>"},
      {"style-that-imports", "<style>@import 'x.css';</style>"},
      {"style-that-imports-escaped", "<style>@\\69mport 'x.css';</style>"},
      {"style-of-html", "<h:style>@import 'x.css';</h:style>"},
      {"style-with-an-address", "<style><![CDATA[g{fill:u\\72l(http://x.invalid)}]]></style>"},
      {"style-with-a-set-of-images", "<style>g{cursor:image-set('x.png' 1x)}</style>"}};
  return all;
}

const Bodies& attributes() {
  static const Bodies all = {
      {"handler-of-a-click", "<g onclick='x()'/>"},
      {"handler-in-capitals", "<g ONLOAD='x()'/>"},
      {"handler-of-another-name-space", "<g e:onload='x()'/>"},
      {"link-to-a-script", "<a href='javascript:x()'/>"},
      {"link-to-a-script-in-capitals", "<a xlink:href='JavaScript:x()'/>"},
      {"link-to-a-script-with-a-tab", "<a href='java&#9;script:x()'/>"},
      {"link-to-a-script-with-a-line-break", "<a href='java&#10;script&#13;:x()'/>"},
      {"link-to-a-script-behind-a-blank", "<a href=' &#32;javascript:x()'/>"},
      {"link-to-data", "<a href='data:text/html,x'/>"},
      {"link-to-a-local-file", "<a href='file:///etc/passwd'/>"},
      {"link-that-reports-its-clicks", "<a href='#a' ping='http://x.invalid'/>"},
      {"image-of-another-file", "<image href='x.png'/>"},
      {"image-of-another-host", "<image xlink:href='http://x.invalid/a.png'/>"},
      {"image-of-any-prefix", "<image q:href='x.png' xmlns:q='http://www.w3.org/1999/xlink'/>"},
      {"image-that-is-svg", "<image href='data:image/svg+xml,&lt;svg/&gt;'/>"},
      {"use-of-another-file", "<use href='other.svg#a'/>"},
      {"use-of-data", "<use href='data:image/svg+xml,&lt;svg id=\"a\"/&gt;#a'/>"},
      {"filter-of-another-file", "<filter><feImage href='x.svg#a'/></filter>"},
      {"base", "<g xml:base='http://x.invalid/'><use href='#a'/></g>"},
      {"source", "<g src='http://x.invalid'/>"},
      {"fill-of-another-file", "<g fill='url(http://x.invalid/#a)'/>"},
      {"fill-of-another-file-in-quotes", "<g fill='url( \"x.svg#a\")'/>"},
      {"fill-with-an-escape", "<g fill='u\\72l(x.svg#a)'/>"},
      {"fill-with-two-escapes", "<g fill='\\55\\52L(x.svg#a)'/>"},
      {"style-with-an-escape", "<g style='fill:\\75 rl(x.svg#a)'/>"},
      {"style-with-a-reference-to-a-character", "<g style='fill:ur&#108;(x.svg#a)'/>"},
      {"animation-of-a-link", "<a><set attributeName='href' to='javascript:x()'/></a>"},
      {"animation-of-an-old-link", "<a><animate values='x' attributeName='xlink:href'/></a>"},
      {"animation-of-a-handler", "<g><set attributeName='onclick' to='x()'/></g>"},
      {"animation-to-an-address", "<g><set attributeName='fill' to='url(x.svg#a)'/></g>"}};
  return all;
}

}  // namespace

std::map<std::string, std::string> active_svgs() {
  std::map<std::string, std::string> all;
  for (const Bodies* bodies : {&elements(), &attributes()})
    for (const auto& [name, body] : *bodies) all[name] = svg_of(body);
  all["style-sheet"] = "<?xml-stylesheet href='x.css' type='text/css'?>" + svg_of("<g/>");
  all["style-sheet-in-capitals"] = "<?XML-Stylesheet href='x.xsl'?>" + svg_of("<g/>");
  all["entity"] = "<!DOCTYPE svg [<!ENTITY a 'b'>]>" + svg_of("<text>&a;</text>");
  all["entity-of-a-file"] =
      "<!DOCTYPE svg [<!ENTITY a SYSTEM 'file:///etc/passwd'>]>" + svg_of("<text>&a;</text>");
  all["entity-of-parameters"] =
      "<!DOCTYPE svg [<!ENTITY % a SYSTEM 'x.dtd'> %a;]>" + svg_of("<g/>");
  return all;
}

std::map<std::string, std::string> inert_svgs() {
  return {
      {"metadata", svg_of("<metadata><dc:source>x</dc:source><dc:title>t</dc:title></metadata>")},
      {"editor", svg_of("<e:namedview pagecolor='#fff'/><g e:label='image(2).png'/>")},
      {"links", svg_of("<a href='https://example.org/a?b#c'/><a href='mailto:a@example.org'/>"
                       "<a href='other.html'/><a xlink:href='#a'/>")},
      {"parts",
       svg_of("<g id='a'/><use href='#a'/><g clip-path='url(#a)' style='fill:url(\"#a\")'/>")},
      {"images", svg_of("<image href='data:image/png;base64,AA=='/>"
                        "<image xlink:href=' data:image/jpeg;base64,AA=='/>")},
      {"fonts", svg_of("<style>@font-face{font-family:a;src:url(data:font/woff2;base64,AA)}"
                       "text{font-size:9px}</style>")},
      {"animation", svg_of("<g><animate attributeName='x' values='0;1'/></g>")},
      {"words", svg_of("<text aria-label='url of image(1)'>onclick script javascript:x()</text>")},
      {"instruction", "<?xpacket begin=''?>" + svg_of("<g/>")},
  };
}

}  // namespace mapproof::test
