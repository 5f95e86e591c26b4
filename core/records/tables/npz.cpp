#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <zip.h>

#include "core/base/errors.hpp"
#include "core/base/files/unpacker.hpp"
#include "core/base/text/csv.hpp"
#include "core/records/tables/npy.hpp"
#include "core/records/tables/respelling.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kLargestArray = std::size_t{1} << 31;

/// An archive of arrays.
class Archive {
 public:
  Archive(std::string_view bytes, const std::string& source)
      : source_(source), packed_bytes_(static_cast<double>(bytes.size())) {
    zip_error_t error;
    zip_error_init(&error);
    zip_source_t* buffer = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
    if (buffer != nullptr) archive_ = zip_open_from_source(buffer, ZIP_RDONLY, &error);
    const std::string what = zip_error_strerror(&error);
    zip_error_fini(&error);
    if (archive_ != nullptr) return;
    zip_source_free(buffer);
    throw IoError(source_, "the archive of NumPy arrays is damaged: " + what);
  }
  ~Archive() { zip_discard(archive_); }
  Archive(const Archive&) = delete;
  Archive& operator=(const Archive&) = delete;

  /// Names without ".npy", and bytes.
  std::vector<std::pair<std::string, std::string>> arrays() {
    std::vector<std::pair<std::string, std::string>> arrays;
    std::size_t total = 0;
    for (zip_int64_t i = 0; i < zip_get_num_entries(archive_, 0); ++i) {
      zip_stat_t facts;
      if (zip_stat_index(archive_, static_cast<zip_uint64_t>(i), 0, &facts) != 0) continue;
      std::string name = facts.name;
      if (!name.ends_with(".npy")) continue;
      total += facts.size;
      if (facts.size > kLargestArray || total > kLargestArray)
        throw IoError(source_, "its arrays unpack to more than 2 GiB");
      refuse_bomb(source_, packed_bytes_, static_cast<double>(total));
      arrays.emplace_back(name.substr(0, name.size() - 4),
                          entry(static_cast<zip_uint64_t>(i), facts.size));
    }
    return arrays;
  }

 private:
  /// What an entry holds, in memory that grows with it: an archive may state any size.
  std::string entry(zip_uint64_t index, zip_uint64_t size) {
    const auto close = [](zip_file_t* file) { zip_fclose(file); };
    const std::unique_ptr<zip_file_t, decltype(close)> file(zip_fopen_index(archive_, index, 0));
    std::array<char, std::size_t{1} << 14> block;
    std::string bytes;
    zip_int64_t got = file ? 1 : -1;
    while (got > 0 && bytes.size() <= size) {
      got = zip_fread(file.get(), block.data(), block.size());
      if (got > 0) bytes.append(block.data(), static_cast<std::size_t>(got));
    }
    if (got != 0 || bytes.size() != size)
      throw IoError(source_, "the archive of NumPy arrays is damaged");
    return bytes;
  }

  const std::string& source_;
  double packed_bytes_;
  zip_t* archive_ = nullptr;
};

struct NamedArray {
  std::string name;
  NpyArray array;
};

/// Arrays of one dimension and one length: the columns of a table.
std::string columns_csv(const std::vector<NamedArray>& arrays) {
  std::string text;
  for (const NamedArray& one : arrays) text += (text.empty() ? "" : ",") + csv_field(one.name);
  text += '\n';
  for (std::size_t row = 0; row < arrays[0].array.shape()[0]; ++row)
    for (std::size_t i = 0; i < arrays.size(); ++i) {
      arrays[i].array.append(text, row, 0);
      text += i + 1 == arrays.size() ? '\n' : ',';
    }
  return text;
}

}  // namespace

bool is_npz(std::string_view start) {
  constexpr std::size_t kFirstEntry = 300;
  return start.starts_with("PK\x03\x04") &&
         start.substr(0, kFirstEntry).find(".npy") != std::string_view::npos;
}

std::string npz_csv(std::string_view bytes, const std::string& source) {
  Archive archive(bytes, source);
  const auto files = archive.arrays();
  std::vector<NamedArray> arrays;
  for (const auto& [name, array] : files)
    arrays.push_back({name, NpyArray(array, fmt::format("{}: {}", source, printable(name)))});
  const auto is_table = [](const NamedArray& one) { return one.array.shape().size() == 2; };
  const auto tables = std::ranges::count_if(arrays, is_table);
  if (tables == 1) {
    std::string text;
    std::ranges::find_if(arrays, is_table)->array.append_rows(text, source);
    return text;
  }
  const bool are_columns =
      !arrays.empty() && std::ranges::all_of(arrays, [&](const NamedArray& one) {
        return one.array.shape().size() == 1 && one.array.shape() == arrays[0].array.shape();
      });
  if (are_columns) return columns_csv(arrays);
  std::vector<std::string> names;
  for (const NamedArray& one : arrays) names.push_back(printable(one.name));
  throw IoError(source, fmt::format("holds the arrays {}; one array of two dimensions is read, or "
                                    "columns of one length: numpy.save(\"table.npy\", array)",
                                    fmt::join(names, ", ")));
}

}  // namespace mapproof
