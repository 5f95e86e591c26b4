#include "reports/history/store/database.hpp"

#include <cmath>
#include <system_error>

#include <fmt/format.h>
#include <sqlite3.h>

#include "core/base/files/files.hpp"
#include "core/base/files/paths.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/out_of_memory.hpp"

namespace mapproof {
namespace {

constexpr int kBusyMilliseconds = 10'000;
/// Bytes of a text, or of a row: a command line has at most 2 MiB on Linux.
constexpr int kLongestValue = 1 << 22;
/// Bytes that SQLite may take in this process. It needs 2 MiB; a damaged file of 2 kB may ask for
/// 2 GB.
constexpr sqlite3_int64 kMostMemory = 64 << 20;

/// SQLite reports a write that fails for want of room as either.
bool is_full(int code) {
  return (code & 0xFF) == SQLITE_FULL || code == SQLITE_IOERR_WRITE || code == SQLITE_IOERR_FSYNC ||
         code == SQLITE_IOERR_TRUNCATE;
}

bool is_damage(int code) {
  return (code & 0xFF) == SQLITE_CORRUPT || (code & 0xFF) == SQLITE_NOTADB;
}

bool is_out_of_memory(int code) {
  return (code & 0xFF) == SQLITE_NOMEM || code == SQLITE_IOERR_NOMEM;
}

/// The path for SQLite, behind the links of its folder, so that the file alone may not be one.
/// @throws IoError if the file is a link, or anything that SQLite would wait for.
std::string unlinked_path(const std::filesystem::path& path) {
  namespace fs = std::filesystem;
  if (path == ":memory:") return path.string();
  std::error_code error;
  if (fs::symlink_status(path, error).type() == fs::file_type::symlink)
    throw IoError(path.string(), "is a symbolic link; put the file itself there");
  if (fs::exists(path, error)) require_file(path);
  return (real_path(path.parent_path().empty() ? "." : path.parent_path()) / path.filename())
      .string();
}

/// A history that somebody hands over runs nothing: no trigger, no view, no function of a schema.
void refuse_code_in_schema(sqlite3* handle) {
  for (const int option : {SQLITE_DBCONFIG_ENABLE_TRIGGER, SQLITE_DBCONFIG_ENABLE_VIEW,
                           SQLITE_DBCONFIG_TRUSTED_SCHEMA})
    sqlite3_db_config(handle, option, 0, nullptr);
  sqlite3_db_config(handle, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_limit(handle, SQLITE_LIMIT_LENGTH, kLongestValue);
}

}  // namespace

Statement::Statement(Database& database, std::string_view sql) : database_(&database) {
  sqlite3_stmt* statement = nullptr;
  const int code = sqlite3_prepare_v2(database.handle(), sql.data(), static_cast<int>(sql.size()),
                                      &statement, nullptr);
  statement_.reset(statement);
  if (code != SQLITE_OK) database.fail();
}

void Statement::Finalizer::operator()(sqlite3_stmt* statement) const {
  sqlite3_finalize(statement);
}

Statement& Statement::bind(std::int64_t value) {
  if (sqlite3_bind_int64(statement_.get(), ++bound_, value) != SQLITE_OK) database_->fail();
  return *this;
}

Statement& Statement::bind(double value) {
  if (std::isnan(value)) return bind_null();
  if (sqlite3_bind_double(statement_.get(), ++bound_, value) != SQLITE_OK) database_->fail();
  return *this;
}

Statement& Statement::bind(std::string_view value) {
  if (sqlite3_bind_text64(statement_.get(), ++bound_, value.data(), value.size(), SQLITE_TRANSIENT,
                          SQLITE_UTF8) != SQLITE_OK)
    database_->fail();
  return *this;
}

Statement& Statement::bind_null() {
  if (sqlite3_bind_null(statement_.get(), ++bound_) != SQLITE_OK) database_->fail();
  return *this;
}

bool Statement::step() {
  const int code = sqlite3_step(statement_.get());
  if (code == SQLITE_ROW) return true;
  if (code != SQLITE_DONE) database_->fail();
  sqlite3_reset(statement_.get());
  bound_ = 0;
  return false;
}

void Statement::run() {
  while (step()) {
  }
}

std::int64_t Statement::integer(int column) const {
  return sqlite3_column_int64(statement_.get(), column);
}

double Statement::real(int column) const {
  return is_null(column) ? kNaN : sqlite3_column_double(statement_.get(), column);
}

std::string Statement::text(int column) const {
  if (is_null(column)) return "";
  const unsigned char* bytes = sqlite3_column_text(statement_.get(), column);
  if (bytes == nullptr) database_->fail();
  return {reinterpret_cast<const char*>(bytes),
          static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column))};
}

bool Statement::is_null(int column) const {
  return sqlite3_column_type(statement_.get(), column) == SQLITE_NULL;
}

Database::Database(const std::filesystem::path& path, Access access) : path_(path) {
  const std::string real = unlinked_path(path);
  sqlite3_hard_heap_limit64(kMostMemory);
  const int flags = SQLITE_OPEN_NOFOLLOW | SQLITE_OPEN_READWRITE |
                    (access == Access::kCreate ? SQLITE_OPEN_CREATE : 0);
  // A reader opens for writing too, where it may: a killed writer's journal has to be rolled back.
  int code = sqlite3_open_v2(real.c_str(), &handle_, flags, nullptr);
  if (code != SQLITE_OK && access == Access::kRead) {
    sqlite3_close(handle_);
    code = sqlite3_open_v2(real.c_str(), &handle_, SQLITE_OPEN_NOFOLLOW | SQLITE_OPEN_READONLY,
                           nullptr);
  }
  try {
    if (code != SQLITE_OK) fail();
    sqlite3_extended_result_codes(handle_, 1);
    sqlite3_busy_timeout(handle_, kBusyMilliseconds);
    refuse_code_in_schema(handle_);
    execute("PRAGMA journal_mode = DELETE; PRAGMA synchronous = EXTRA; PRAGMA foreign_keys = ON;");
  } catch (...) {
    sqlite3_close(handle_);
    throw;
  }
}

Database::~Database() { sqlite3_close(handle_); }

void Database::execute(const std::string& sql) {
  if (sqlite3_exec(handle_, sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) fail();
}

std::string Database::damage() {
  try {
    Statement check(*this, "PRAGMA integrity_check(1)");
    if (!check.step()) return "its check returns nothing";
    std::string answer = check.text(0);
    if (answer != "ok") return answer;
    Statement keys(*this, "PRAGMA foreign_key_check");
    return keys.step() ? "a row of " + keys.text(0) + " belongs to none of " + keys.text(2) : "";
  } catch (const DamagedFile& error) {
    return error.damage();
  }
}

std::int64_t Database::last_row() const { return sqlite3_last_insert_rowid(handle_); }

void Database::fail() const {
  if (handle_ == nullptr) throw OutOfMemory(path_.string());
  const int code = sqlite3_extended_errcode(handle_);
  if (is_out_of_memory(code))
    throw OutOfMemory(path_.string(), "; SQLite says so of some damaged files, too");
  if (is_full(code))
    throw IoError(path_.string(), "cannot be written: the disk is full; what it held is untouched");
  if ((code & 0xFF) == SQLITE_BUSY) throw IoError(path_.string(), "is in use by another process");
  if (is_damage(code)) throw DamagedFile(path_.string(), sqlite3_errmsg(handle_));
  if ((code & 0xFF) == SQLITE_TOOBIG)
    throw DamagedFile(path_.string(),
                      fmt::format("a text in it has more than {} bytes", kLongestValue));
  throw IoError(path_.string(), sqlite3_errmsg(handle_));
}

Transaction::Transaction(Database& database) : database_(&database) {
  database.execute("BEGIN IMMEDIATE");
}

Transaction::~Transaction() {
  // Fails if SQLite has rolled back by itself, which is as good.
  if (database_ != nullptr)
    sqlite3_exec(database_->handle(), "ROLLBACK", nullptr, nullptr, nullptr);
}

void Transaction::commit() {
  database_->execute("COMMIT");
  database_ = nullptr;
}

}  // namespace mapproof
