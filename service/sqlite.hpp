#pragma once

#include <sqlite3.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

/// Owners for the resources of the SQLite C API, and its errors as Error{Storage}.
namespace ridgeline::service::sqlite {

/// One connection to a file, or ":memory:". Waits up to `patience` for other processes.
class Connection {
public:
  enum class Access { ReadWrite, Read };
  Connection(const std::string& file, Access access);
  Connection(Connection&& other) noexcept;
  Connection& operator=(Connection&& other) noexcept;
  ~Connection();

  void run(const char* sql);  ///< throws Error{Storage}
  [[noreturn]] void fail(int code) const;
  const std::string& file() const noexcept { return file_; }
  sqlite3* get() const noexcept { return handle_; }

  static constexpr int patience_ms = 5000;

private:
  std::string file_;
  sqlite3* handle_ = nullptr;
};

/// One prepared statement: bind, then step row by row; or run() when it gives none.
class Statement {
public:
  Statement(const Connection& connection, const char* sql);
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;
  ~Statement() { sqlite3_finalize(handle_); }

  Statement& bind(std::string_view text);
  Statement& bind(std::int64_t number);
  Statement& bind(std::optional<std::int64_t> number);
  bool step();  ///< is there a row? Throws Error{Storage}
  void run();   ///< steps to the end and makes it ready to bind again

  std::string text(int column) const;
  std::int64_t number(int column) const;
  bool is_null(int column) const;

private:
  const Connection& connection_;
  sqlite3_stmt* handle_ = nullptr;
  int bound_ = 0;
};

/// Everything between construction and commit() holds or nothing does.
class Transaction {
public:
  explicit Transaction(Connection& connection) : connection_(connection) {
    connection_.run("BEGIN IMMEDIATE");
  }
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  ~Transaction() {
    if (!done_) sqlite3_exec(connection_.get(), "ROLLBACK", nullptr, nullptr, nullptr);
  }
  void commit() {
    connection_.run("COMMIT");
    done_ = true;
  }

private:
  Connection& connection_;
  bool done_ = false;
};

}  // namespace ridgeline::service::sqlite
