#include <stdexcept>

#include "core/base/files/files.hpp"
#include "tests/reports/diff/value_cases.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;

using Change = std::function<void(const fs::path& folder)>;

void truncate(const fs::path& file) {
  const auto size = fs::file_size(file);
  fs::resize_file(file, size / 2);
}

void swap(const fs::path& a, const fs::path& b) {
  const std::string first = read_file(a), second = read_file(b);
  write_file(a, second);
  write_file(b, first);
}

struct Files {
  std::vector<ValueCase> cases = {};

  /// A change that nothing else is said of.
  void add(const std::string& name, const std::string& id, Verdict verdict,
           std::vector<std::string> cause, const Change& change) {
    add_among_others(name, id, verdict, std::move(cause), change);
    cases.back().alone = true;
  }

  void add_among_others(const std::string& name, const std::string& id, Verdict verdict,
                        std::vector<std::string> cause, const Change& change) {
    cases.push_back({.name = name,
                     .id = id,
                     .verdict = verdict,
                     .cause = std::move(cause),
                     .passes = false,
                     .change = change,
                     .alone = false});
  }
};

void add_damage(Files& files, const std::string& id) {
  for (const std::string extension : {".figure.json", ".png", ".svg"}) {
    const std::string name = id + extension;
    const auto file = [name](const fs::path& folder) { return folder / "figures" / name; };
    files.add(name + " truncated", id, Verdict::kUnreadable, {},
              [file](const fs::path& folder) { truncate(file(folder)); });
    files.add(name + " emptied", id, Verdict::kUnreadable, {},
              [file](const fs::path& folder) { fs::resize_file(file(folder), 0); });
    files.add(name + " replaced by rubbish", id, Verdict::kUnreadable, {},
              [file](const fs::path& folder) { write_file(file(folder), "no image at all\n"); });
    files.add(name + " deleted", id, Verdict::kMissing, {"is missing"},
              [file](const fs::path& folder) { fs::remove(file(folder)); });
  }
}

void add_whole(Files& files, const std::string& id, const std::string& other) {
  const auto each = [](const fs::path& folder, const auto& use) {
    for (const char* extension : {".figure.json", ".png", ".svg"})
      use(folder / "figures", extension);
  };
  files.add(id + " deleted", id, Verdict::kMissing, {"is not in the current"},
            [=](const fs::path& folder) {
              each(folder, [&](const fs::path& in, const std::string& extension) {
                fs::remove(in / (id + extension));
              });
            });
  files.add(id + " added again", "new-one", Verdict::kNew, {"is not in the baseline"},
            [=](const fs::path& folder) {
              each(folder, [&](const fs::path& in, const std::string& extension) {
                fs::copy_file(in / (id + extension), in / ("new-one" + extension));
              });
            });
  const Change rename = [=](const fs::path& folder) {
    each(folder, [&](const fs::path& in, const std::string& extension) {
      fs::rename(in / (id + extension), in / ("renamed" + extension));
    });
  };
  files.add_among_others(id + " renamed", id, Verdict::kMissing,
                         {"the current has it as renamed: renamed"}, rename);
  files.add_among_others(id + " renamed, as the other", "renamed", Verdict::kNew,
                         {"the baseline has it as " + id + ": renamed"}, rename);
  files.add_among_others(
      id + ".png swapped", id, Verdict::kChanged,
      {"its png is that of " + other + " in the baseline: swapped"}, [=](const fs::path& folder) {
        swap(folder / "figures" / (id + ".png"), folder / "figures" / (other + ".png"));
      });
  files.add_among_others(id + " swapped", id, Verdict::kChanged,
                         {"its value, png and svg are those of " + other, "swapped"},
                         [=](const fs::path& folder) {
                           each(folder, [&](const fs::path& in, const std::string& extension) {
                             swap(in / (id + extension), in / (other + extension));
                           });
                         });
  files.add(
      id + ".png replaced by that of " + other, id, Verdict::kChanged,
      {"its png is that of " + other + " in the baseline: swapped"}, [=](const fs::path& folder) {
        fs::copy_file(folder / "figures" / (other + ".png"), folder / "figures" / (id + ".png"),
                      fs::copy_options::overwrite_existing);
      });
}

void add_records(Files& files) {
  for (const std::string name : {"runs/layout-3-pose-1.json", "maps/layout-5-pose-1.json"}) {
    files.add(name + " truncated", "records", Verdict::kUnreadable, {name},
              [=](const fs::path& folder) { truncate(folder / name); });
    files.add(name + " emptied", "records", Verdict::kUnreadable, {name},
              [=](const fs::path& folder) { fs::resize_file(folder / name, 0); });
  }
  files.add("a run deleted", "records", Verdict::kMissing, {"missing run:", "layout-3-pose-1"},
            [](const fs::path& folder) { fs::remove(folder / "runs/layout-3-pose-1.json"); });
  files.add("study.json truncated", "records", Verdict::kUnreadable, {"study.json"},
            [](const fs::path& folder) { truncate(folder / "study.json"); });
  files.add("study.json deleted", "records", Verdict::kMissing, {"no records"},
            [](const fs::path& folder) { fs::remove(folder / "study.json"); });
  files.add("two runs swapped", "records", Verdict::kUnreadable, {"states that it is layout-4"},
            [](const fs::path& folder) {
              swap(folder / "runs/layout-3-pose-1.json", folder / "runs/layout-4-pose-1.json");
            });
}

}  // namespace

std::vector<ValueCase> file_cases() {
  Files files;
  for (const char* id : {"map-lpca", "map-isomap", "mpe-curve"}) add_damage(files, id);
  add_whole(files, "map-lpca", "map-isomap");
  add_whole(files, "map-isomap", "mpe-curve");
  add_records(files);
  return std::move(files.cases);
}

}  // namespace mapproof::test
