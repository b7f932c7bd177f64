#ifndef OUTDOOR_OMR_TEST_CHILD_PROCESS_H
#define OUTDOOR_OMR_TEST_CHILD_PROCESS_H

#include <spawn.h>
#include <sys/wait.h>
#include <csignal>
#include <stdexcept>
#include <string>
#include <vector>

extern char** environ;

namespace ros_test
{
/** A program that runs while this lives. */
class ChildProcess
{
 public:
  explicit ChildProcess(std::vector<std::string> command)
  {
    std::vector<char*> arguments;
    for (std::string& word : command)
    {
      arguments.push_back(&word[0]);
    }
    arguments.push_back(nullptr);
    if (posix_spawnp(&id_, arguments[0], nullptr, nullptr, arguments.data(), environ) != 0)
    {
      throw std::runtime_error("cannot start " + command[0]);
    }
  }

  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  ~ChildProcess()
  {
    if (!ended_)
    {
      kill(id_, SIGKILL);
      wait();
    }
  }

  /** Waits for its end. @return its exit status, or 128 + the signal that ended it, as a shell says it. */
  int wait()
  {
    int status = 0;
    waitpid(id_, &status, 0);
    ended_ = true;
    return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
  }

  /** Asks it to end, as Ctrl-C does. @return as wait(). */
  int interrupt()
  {
    kill(id_, SIGINT);
    return wait();
  }

 private:
  pid_t id_ = 0;
  bool ended_ = false;
};

}  // namespace ros_test

#endif
