#include "cosserat_cable/console/run_program.h"

#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>

namespace cosserat_cable {

bool RunProgram(const std::vector<std::string>& arguments) {
  const pid_t child = fork();
  if (child < 0) return false;
  if (child == 0) {
    std::vector<char*> argv;
    for (const std::string& argument : arguments)
      argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    execvp(argv[0], argv.data());
    std::perror(argv[0]);
    _exit(127);
  }
  int status = 0;
  return waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace cosserat_cable
