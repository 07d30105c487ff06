#include <CLI/CLI.hpp>
#include <iostream>

#include "clients/manual/manual.hpp"

namespace ridgeline::manual {

void add_manual_option(CLI::App& app, const About& about) {
  const auto print = [&app, about](const std::string& form) {
    const Syntax program = syntax_of(app);
    if (form == "man") {
      std::cout << man_page(program, about);
    } else {
      std::cout << (form == "bash" ? bash_completion(program) : zsh_completion(program));
    }
    throw CLI::Success();
  };
  app.add_option_function<std::string>("--manual", print, "Print manual page or completion")
      ->check(CLI::IsMember({"man", "bash", "zsh"}))
      ->trigger_on_parse()
      ->group("");
}

}  // namespace ridgeline::manual
