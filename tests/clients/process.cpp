#include "tests/clients/process.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <sstream>
#include <stdexcept>

extern char** environ;

namespace ridgeline::tests {
namespace {

void require(bool ok, const char* what) {
  if (!ok) throw std::runtime_error(what);
}

/// This environment with a home where no library is.
std::vector<std::string> environment(const std::string& home) {
  std::vector<std::string> variables = {"HOME=" + home, "XDG_DATA_HOME=" + home};
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const std::string text = *variable;
    if (!text.starts_with("HOME=") && !text.starts_with("XDG_DATA_HOME=") &&
        !text.starts_with("RIDGELINE_"))
      variables.push_back(text);
  }
  return variables;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> result;
  for (std::string& text : texts) result.push_back(text.data());
  result.push_back(nullptr);
  return result;
}

}  // namespace

std::string read(const std::string& path) {
  const std::ifstream stream(path, std::ios::binary);
  require(stream.good(), "a file to read");
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

Finished ridgeline(const std::vector<std::string>& arguments, const std::string& in) {
  return run(RIDGELINE_COMMAND, arguments, in);
}

Finished run(const std::string& program, const std::vector<std::string>& arguments,
             const std::string& in) {
  const TemporaryFolder folder;
  const std::string in_file = folder.write("in", in);
  std::vector<std::string> texts = {"ridgeline"};
  texts.insert(texts.end(), arguments.begin(), arguments.end());
  std::vector<std::string> variables = environment(folder.file(""));

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  constexpr int mode = 0600;
  posix_spawn_file_actions_addopen(&actions, 0, in_file.c_str(), O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 1, folder.file("out").c_str(), O_WRONLY | O_CREAT,
                                   mode);
  posix_spawn_file_actions_addopen(&actions, 2, folder.file("err").c_str(), O_WRONLY | O_CREAT,
                                   mode);
  pid_t pid = 0;
  const int error = ::posix_spawn(&pid, program.c_str(), &actions, nullptr, pointers(texts).data(),
                                  pointers(variables).data());
  posix_spawn_file_actions_destroy(&actions);
  require(error == 0, "posix_spawn");
  int status = 0;
  require(::waitpid(pid, &status, 0) == pid, "waitpid");
  constexpr int killed = 128;
  return {WIFEXITED(status) ? WEXITSTATUS(status) : killed + WTERMSIG(status),
          read(folder.file("out")), read(folder.file("err"))};
}

}  // namespace ridgeline::tests
