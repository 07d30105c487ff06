#include "service/sqlite.hpp"

#include <utility>

#include "core/base/error.hpp"

namespace ridgeline::service::sqlite {
namespace {

std::string reason(int code, sqlite3* handle) {
  switch (code & 0xff) {
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return "another process has held it for more than " +
             std::to_string(Connection::patience_ms / 1000) + " s";
    case SQLITE_FULL: return "the disk is full";
    case SQLITE_READONLY: return "it cannot be written";
    case SQLITE_CANTOPEN: return "it cannot be opened";
    case SQLITE_NOTADB: return "it is not a library file";
    case SQLITE_CORRUPT: return "it is damaged";
    default: return handle != nullptr ? sqlite3_errmsg(handle) : sqlite3_errstr(code);
  }
}

[[noreturn]] void fail(const std::string& file, int code, sqlite3* handle) {
  throw Error(ErrorCode::Storage,
              "library " + file + ": " + reason(code, handle) + " (" + sqlite3_errstr(code) + ")",
              {.field = "",
               .value = file,
               .limit = "a readable and writable library file",
               .parameter = {},
               .target = {}});
}

}  // namespace

Connection::Connection(const std::string& file, Access access) : file_(file) {
  const int flags =
      access == Access::Read ? SQLITE_OPEN_READONLY : SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
  const int code = sqlite3_open_v2(file.c_str(), &handle_, flags | SQLITE_OPEN_FULLMUTEX, nullptr);
  if (code != SQLITE_OK) {
    sqlite3* handle = std::exchange(handle_, nullptr);
    sqlite3_close(handle);
    sqlite::fail(file_, code, nullptr);
  }
  sqlite3_extended_result_codes(handle_, 1);
  sqlite3_busy_timeout(handle_, patience_ms);
}

Connection::Connection(Connection&& other) noexcept
    : file_(std::move(other.file_)), handle_(std::exchange(other.handle_, nullptr)) {}

Connection& Connection::operator=(Connection&& other) noexcept {
  std::swap(file_, other.file_);
  std::swap(handle_, other.handle_);
  return *this;
}

Connection::~Connection() {
  sqlite3_close(handle_);
}

void Connection::run(const char* sql) {
  const int code = sqlite3_exec(handle_, sql, nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) fail(code);
}

void Connection::fail(int code) const {
  sqlite::fail(file_, code, handle_);
}

Statement::Statement(const Connection& connection, const char* sql) : connection_(connection) {
  const int code = sqlite3_prepare_v2(connection.get(), sql, -1, &handle_, nullptr);
  if (code != SQLITE_OK) connection.fail(code);
}

Statement& Statement::bind(std::string_view text) {
  const char* begin = text.empty() ? "" : text.data();  // a null pointer would bind NULL
  const int code =
      sqlite3_bind_text64(handle_, ++bound_, begin, text.size(), SQLITE_TRANSIENT, SQLITE_UTF8);
  if (code != SQLITE_OK) connection_.fail(code);
  return *this;
}

Statement& Statement::bind(std::int64_t number) {
  const int code = sqlite3_bind_int64(handle_, ++bound_, number);
  if (code != SQLITE_OK) connection_.fail(code);
  return *this;
}

Statement& Statement::bind(std::optional<std::int64_t> number) {
  if (number) return bind(*number);
  const int code = sqlite3_bind_null(handle_, ++bound_);
  if (code != SQLITE_OK) connection_.fail(code);
  return *this;
}

bool Statement::step() {
  const int code = sqlite3_step(handle_);
  if (code != SQLITE_ROW && code != SQLITE_DONE) connection_.fail(code);
  return code == SQLITE_ROW;
}

void Statement::run() {
  while (step()) {
  }
  sqlite3_reset(handle_);
  bound_ = 0;
}

std::string Statement::text(int column) const {
  const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(handle_, column));
  return text == nullptr
             ? std::string()
             : std::string(text, static_cast<std::size_t>(sqlite3_column_bytes(handle_, column)));
}

std::int64_t Statement::number(int column) const {
  return sqlite3_column_int64(handle_, column);
}

bool Statement::is_null(int column) const {
  return sqlite3_column_type(handle_, column) == SQLITE_NULL;
}

}  // namespace ridgeline::service::sqlite
