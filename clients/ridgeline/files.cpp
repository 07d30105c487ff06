#include "clients/ridgeline/files.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "core/base/error.hpp"
#include "jobs/parse.hpp"

namespace ridgeline::command {
namespace {

[[noreturn]] void fail(const std::string& path, const std::string& what, const std::string& why) {
  ErrorDetails details;
  details.value = path;
  throw Error(ErrorCode::BadFile, "cannot " + what + " " + path + ": " + why, details);
}

/// An open file descriptor.
class File {
public:
  explicit File(int descriptor) : descriptor_(descriptor) {}
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  ~File() { ::close(descriptor_); }
  int get() const { return descriptor_; }

private:
  int descriptor_;
};

std::string read_all(int descriptor, const std::string& path) {
  std::string text;
  std::array<char, 65536> buffer;
  for (;;) {
    const ssize_t count = ::read(descriptor, buffer.data(), buffer.size());
    if (count == 0) return text;
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail(path, "read", std::strerror(errno));
    text.append(buffer.data(), static_cast<std::size_t>(count));
    if (text.size() > jobs::max_document_bytes) {
      fail(path, "read",
           "it is longer than " + std::to_string(jobs::max_document_bytes) + " bytes");
    }
  }
}

void write_all(int descriptor, std::string_view text, const std::string& path) {
  while (!text.empty()) {
    const ssize_t count = ::write(descriptor, text.data(), text.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail(path, "write", std::strerror(errno));
    text.remove_prefix(static_cast<std::size_t>(count));
  }
}

void write_new(const std::string& path, std::string_view text, const std::string& name) {
  constexpr int mode = 0666;  // less the umask
  const File file(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, mode));
  if (file.get() < 0) fail(name, "write", std::strerror(errno));
  write_all(file.get(), text, name);
}

}  // namespace

std::string read_file(const std::string& path) {
  if (path == "-") return read_all(STDIN_FILENO, "standard input");
  const File file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.get() < 0) fail(path, "read", std::strerror(errno));
  return read_all(file.get(), path);
}

void write_file(const std::string& path, std::string_view text) {
  if (path.empty() || path == "-") return write_all(STDOUT_FILENO, text, "standard output");
  std::error_code ignored;  // a file that is not there yet is no error
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  const bool is_special =
      std::filesystem::exists(status) && !std::filesystem::is_regular_file(status);
  if (is_special) return write_new(path, text, path);
  const std::string draft = path + ".part";
  write_new(draft, text, path);
  if (::rename(draft.c_str(), path.c_str()) != 0) {
    const int error = errno;
    ::unlink(draft.c_str());
    fail(path, "write", std::strerror(error));
  }
}

}  // namespace ridgeline::command
