#include "tests/reports/browser.hpp"

#include <array>
#include <cstdio>
#include <memory>

#include <fmt/format.h>

#include "core/base/files/files.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;

std::string output_of(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(::popen(command.c_str(), "r"), ::pclose);
  std::string out;
  std::array<char, 65536> block{};
  while (pipe) {
    const std::size_t count = std::fread(block.data(), 1, block.size(), pipe.get());
    if (count == 0) break;
    out.append(block.data(), count);
  }
  return out;
}

/// A JSON string that may stand within a script element.
std::string json(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\' || c == '<' || byte < 0x20)
      out += fmt::format("\\u{:04x}", byte);
    else
      out += c;
  }
  return out + '"';
}

std::string json(const std::vector<std::string>& texts) {
  std::string out;
  for (const std::string& text : texts) out += (out.empty() ? "" : ",") + json(text);
  return "[" + out + "]";
}

std::string harness(const std::vector<std::string>& texts,
                    const std::vector<std::string>& attributes, const std::string& checks,
                    const std::string& fragment) {
  return "<!DOCTYPE html><meta charset=\"utf-8\"><iframe src=\"report.html" + fragment +
         "\" width=\"1400\" "
         "height=\"900\"></iframe><pre id=\"findings\"></pre>"
         "<script type=\"application/json\" id=\"expected\">{\"texts\":" +
         json(texts) + ",\"attributes\":" + json(attributes) + "}</script><script>" +
         read_file(MAPPROOF_SOURCE_DIR "/tests/reports/" + checks) + "</script>";
}

std::map<std::string, std::string> findings(const std::string& dom) {
  std::map<std::string, std::string> found;
  static constexpr std::string_view kBegin = "<pre id=\"findings\">";
  std::size_t at = dom.find(kBegin);
  if (at == std::string::npos) return found;
  at += kBegin.size();
  const std::size_t end = dom.find("</pre>", at);
  while (at < end && end != std::string::npos) {
    const std::size_t stop = std::min(dom.find('\n', at), end);
    const std::string line = dom.substr(at, stop - at);
    const std::size_t equals = line.find('=');
    if (equals != std::string::npos) found[line.substr(0, equals)] = line.substr(equals + 1);
    at = stop + 1;
  }
  return found;
}

/// What Chromium prints when it opens a file of the folder.
std::string output_of_chromium(const TemporaryFolder& folder, const std::string& options,
                               const std::string& file) {
  return output_of(fmt::format(
      "timeout 60 '{}' --headless --no-sandbox --disable-gpu --disable-quic --no-first-run "
      "--disable-background-networking --disable-component-update --disable-sync "
      "--user-data-dir='{}' {} 'file://{}' 2>/dev/null",
      chromium().value_or(""), (folder.path() / "profile").string(), options,
      (folder.path() / file).string()));
}

}  // namespace

std::optional<std::string> chromium() {
  for (const char* name : {"chromium", "chromium-browser", "google-chrome"}) {
    std::string path = output_of(fmt::format("command -v {} 2>/dev/null", name));
    if (path.empty()) continue;
    path.erase(path.find_last_not_of('\n') + 1);
    return path;
  }
  return std::nullopt;
}

std::map<std::string, std::string> browse(const std::string& page,
                                          const std::vector<std::string>& texts,
                                          const std::vector<std::string>& attributes,
                                          const std::string& checks, const std::string& fragment) {
  // On a busy machine the virtual time may be over before the page's own tasks had their turn: then
  // nothing was found out, neither for the page nor against it.
  constexpr int kMostAttempts = 6;
  std::map<std::string, std::string> found;
  for (int attempt = 0; attempt < kMostAttempts; ++attempt) {
    const TemporaryFolder folder;
    write_file(folder.path() / "report.html", page);
    write_file(folder.path() / "harness.html", harness(texts, attributes, checks, fragment));
    // The harness reads into the frame, which two local files may not do by default.
    found = findings(output_of_chromium(
        folder, "--allow-file-access-from-files --virtual-time-budget=60000 --dump-dom",
        "harness.html"));
    if (found.contains("done") || found.contains("error")) break;
  }
  return found;
}

std::string printed_text(const std::string& page) {
  const TemporaryFolder folder;
  write_file(folder.path() / "report.html", page);
  const std::string pdf = folder / "report.pdf";
  output_of_chromium(folder, fmt::format("--no-pdf-header-footer --print-to-pdf='{}'", pdf),
                     "report.html");
  return output_of(fmt::format("pdftotext -layout '{}' - 2>/dev/null", pdf));
}

}  // namespace mapproof::test
