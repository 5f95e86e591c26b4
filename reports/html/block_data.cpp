#include "reports/html/block_data.hpp"

#include <array>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "core/base/words.hpp"
#include "reports/html/escape.hpp"
#include "reports/html/table_data.hpp"
#include "reports/model/format.hpp"

namespace mapproof {
namespace {

using kainjow::mustache::data;
using kainjow::mustache::list;

/// Longer texts scroll in a box of their own.
constexpr std::size_t kLong = 200;

data phrase_data(const Phrase& phrase, const HtmlOptions& options) {
  data out;
  const bool is_file = phrase.emphasis == Emphasis::kFile;
  out.set("text", is_file ? link_words(phrase.text, options) : phrase.text);
  out.set("plain", phrase.emphasis == Emphasis::kPlain);
  out.set("strong", phrase.emphasis == Emphasis::kStrong);
  out.set("code", phrase.emphasis == Emphasis::kCode);
  out.set("file", is_file);
  out.set("link", is_file ? file_link(phrase.text) : "");
  out.set("data", phrase.emphasis == Emphasis::kData);
  out.set("long", phrase.text.size() > kLong);
  return out;
}

}  // namespace

data phrases_data(const Paragraph& paragraph, const HtmlOptions& options) {
  list phrases;
  for (const Phrase& phrase : paragraph.phrases) phrases.push_back(phrase_data(phrase, options));
  return phrases;
}

namespace {

/// Makes the data of each kind of block, under the name of its template.
class BlockVisitor {
 public:
  BlockVisitor(const FigureContext& drawn, const HtmlOptions& options)
      : drawn_(drawn), options_(options) {
    for (const char* kind : {"paragraph", "bullet_list", "highlights", "callout", "table", "figure",
                             "gallery", "key_values", "status_list"})
      block_.set(kind, false);
  }

  data take() { return std::move(block_); }

  void operator()(const Paragraph& paragraph) {
    data out;
    out.set("phrases", phrases_data(paragraph, options_));
    block_.set("paragraph", out);
  }

  void operator()(const BulletList& bullets) {
    list items;
    for (const Paragraph& item : bullets.items)
      items.push_back(data("phrases", phrases_data(item, options_)));
    block_.set("bullet_list", data("items", items));
  }

  void operator()(const Highlights& highlights) {
    list items;
    for (const Highlights::Item& item : highlights.items) {
      data out;
      out.set("label", item.label);
      out.set("value", item.value);
      out.set("detail", item.detail);
      items.push_back(std::move(out));
    }
    block_.set("highlights", data("items", items));
  }

  void operator()(const Callout& callout) {
    data out;
    out.set("title", callout.title);
    out.set("warning", callout.tone == Callout::Tone::kWarning);
    out.set("phrases", phrases_data(callout.text, options_));
    block_.set("callout", out);
  }

  void operator()(const Table& table) { block_.set("table", table_data(table, options_)); }

  void operator()(const FigureBlock& figure) {
    block_.set("figure", figure_data(figure, drawn_, options_));
  }

  void operator()(const Gallery& gallery) {
    list figures;
    for (const FigureBlock& figure : gallery.figures)
      figures.push_back(figure_data(figure, drawn_, options_));
    block_.set("gallery", data("figures", figures));
  }

  void operator()(const KeyValues& pairs) {
    list items;
    for (const KeyValues::Item& item : pairs.items) {
      data out = phrase_data(item.value, options_);
      out.set("key", item.key);
      items.push_back(std::move(out));
    }
    block_.set("key_values", data("items", items));
  }

  void operator()(const StatusList& statuses) {
    list items;
    for (const StatusList::Item& item : statuses.items) items.push_back(status_data(item));
    block_.set("status_list", data("items", items));
  }

 private:
  static data status_data(const StatusList::Item& item) {
    data out;
    out.set("code", item.code);
    out.set("meaning", item.meaning);
    out.set("where", item.where);
    out.set("failed", item.failed);
    const double share = item.of > 0 ? 100.0 * item.count / item.of : 0.0;
    out.set("count", fmt::format("{} of {} ({} %)", item.count, counted(item.of, "map"),
                                 format_number(share, share < 1.0 ? 1 : 0)));
    list places;
    for (const StatusList::Place& place : item.places) {
      data entry;
      entry.set("record", place.record_id);
      entry.set("detail", place.detail);
      entry.set("long", place.detail.size() > kLong);
      places.push_back(std::move(entry));
    }
    out.set("any_places", !item.places.empty());
    out.set("places", places);
    const int more = item.count - static_cast<int>(item.places.size());
    out.set("more", more > 0 ? data(fmt::format("and {} more", more)) : data(false));
    return out;
  }

  const FigureContext& drawn_;
  const HtmlOptions& options_;
  data block_;
};

}  // namespace

data block_data(const Block& block, const FigureContext& drawn, const HtmlOptions& options) {
  BlockVisitor visitor(drawn, options);
  std::visit(visitor, block);
  return visitor.take();
}

}  // namespace mapproof
