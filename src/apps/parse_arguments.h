// How every tool takes its command line.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace cosserat_cable {

/// Parses; false where the program is to end with `code`.
inline bool Parse(CLI::App* app, int argc, char** argv, int* code) {
  // roslaunch appends __name:=... and __log:=... to every program, also to those that need no
  // master.
  std::vector<std::string> arguments;
  for (int i = argc - 1; i > 0; --i) {  // CLI11 takes them in reverse
    const std::string argument = argv[i];
    const bool remapping = argument.rfind("__", 0) == 0 && argument.find(":=") != std::string::npos;
    if (!remapping) arguments.push_back(argument);
  }
  try {
    app->parse(arguments);
    return true;
  } catch (const CLI::ParseError& error) {
    *code = app->exit(error) == 0 ? 0 : 2;
    return false;
  }
}

}  // namespace cosserat_cable
