// SPDX-License-Identifier: GPL-3.0-or-later
// Run by the build: writes the manual and the completion of `sphverify` below FOLDER, as they are installed
// below share.
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "harness/cli/commands.hpp"
#include "harness/cli/shell/shell_files.hpp"

namespace {

void write(std::filesystem::path const& path, std::string const& text) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream file(path, std::ios::binary);
  file << text << std::flush;
  if (!file) throw std::runtime_error(path.string() + ": cannot be written");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: {} FOLDER\n", argv[0]);
    return 2;
  }
  try {
    std::filesystem::path const folder = argv[1];
    auto const app = sphverify::command_line("sphverify");
    write(folder / "man/man1/sphverify.1", sphverify::manual_page(*app));
    CLI::App const& program = *app;
    for (CLI::App const* command : program.get_subcommands({}))
      write(folder / fmt::format("man/man1/sphverify-{}.1", command->get_name()),
            sphverify::manual_page(*command));
    write(folder / "bash-completion/completions/sphverify", sphverify::bash_completion(*app));
    write(folder / "zsh/site-functions/_sphverify", sphverify::zsh_completion(*app));
    return 0;
  } catch (std::exception const& error) {
    fmt::print(stderr, "{}: {}\n", argv[0], error.what());
    return 3;
  }
}
