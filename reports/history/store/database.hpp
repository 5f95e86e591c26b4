#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/errors.hpp"

struct sqlite3;
struct sqlite3_stmt;

namespace mapproof {

class Database;

/// The bytes of the file are not those of a database, or not those of a whole one.
class DamagedFile : public IoError {
 public:
  DamagedFile(const std::string& path, const std::string& damage)
      : IoError(path, "is damaged: " + damage), damage_(damage) {}

  const std::string& damage() const { return damage_; }

 private:
  std::string damage_;
};

/// One statement of SQL, its values bound one after the other, its rows read column by column.
class Statement {
 public:
  Statement(Database& database, std::string_view sql);

  /// The next value to bind. NaN is bound as NULL.
  Statement& bind(std::int64_t value);
  Statement& bind(int value) { return bind(static_cast<std::int64_t>(value)); }
  Statement& bind(double value);
  Statement& bind(std::string_view value);
  Statement& bind_null();

  /// Steps to the next row. @return Whether there is one. @throws IoError.
  bool step();
  /// For a statement without rows: runs it and makes it ready to be bound again. @throws IoError.
  void run();

  /// Columns of the row, counted from 0. NULL is 0, NaN, "". @throws OutOfMemory of a text.
  std::int64_t integer(int column) const;
  double real(int column) const;
  std::string text(int column) const;
  bool is_null(int column) const;

 private:
  struct Finalizer {
    void operator()(sqlite3_stmt* statement) const;
  };
  Database* database_;
  std::unique_ptr<sqlite3_stmt, Finalizer> statement_;
  int bound_ = 0;
};

/// An SQLite file. Every failure is an IoError that names the file; a full disk has its own
/// message.
class Database {
 public:
  enum class Access { kRead, kWrite, kCreate };

  /// Opens the file; only kCreate makes one that is not there. Waits up to ten seconds for another
  /// process that writes. A rollback journal is kept, not a write-ahead log: the store is then one
  /// file between two nightly runs, on any file system, and a nightly run is a single transaction.
  /// @throws DamagedFile if it is not a database or not a whole one; IoError if it cannot be
  /// opened;
  ///         OutOfMemory, as all below do, if SQLite ran out of memory, or says so of a damaged
  ///         file.
  Database(const std::filesystem::path& path, Access access);
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  /// Statements without values and rows. @throws IoError.
  void execute(const std::string& sql);

  /// What SQLite's own check finds wrong with the file; empty if nothing.
  /// @throws IoError if the file cannot be read, which implies nothing about its contents.
  std::string damage();

  std::int64_t last_row() const;
  const std::filesystem::path& path() const { return path_; }
  sqlite3* handle() const { return handle_; }

  /// @throws IoError that names the last failure; DamagedFile if it is the file's bytes.
  [[noreturn]] void fail() const;

 private:
  std::filesystem::path path_;
  sqlite3* handle_ = nullptr;
};

/// All or nothing: rolled back unless committed.
class Transaction {
 public:
  explicit Transaction(Database& database);
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  void commit();

 private:
  Database* database_;
};

}  // namespace mapproof
