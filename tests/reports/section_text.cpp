#include "tests/reports/section_text.hpp"

#include <stdexcept>

namespace mapproof::test {

const Table& table_named(const Section& section, std::string_view id) {
  for (const Block& block : section.blocks)
    if (const auto* table = std::get_if<Table>(&block); table != nullptr && table->id == id)
      return *table;
  throw std::runtime_error("no table " + std::string(id));
}

std::string words(const Section& section) {
  std::string text;
  const auto add = [&](const Paragraph& paragraph) {
    for (const Phrase& phrase : paragraph.phrases) text += phrase.text;
    text += '\n';
  };
  for (const Block& block : section.blocks) {
    if (const auto* paragraph = std::get_if<Paragraph>(&block)) add(*paragraph);
    if (const auto* callout = std::get_if<Callout>(&block)) {
      text += callout->title + ": ";
      add(callout->text);
    }
    if (const auto* bullets = std::get_if<BulletList>(&block))
      for (const Paragraph& item : bullets->items) add(item);
  }
  return text;
}

bool contains_text(const Section& section, const std::string& what) {
  return words(section).find(what) != std::string::npos;
}

}  // namespace mapproof::test
