#include "kernel_cache.h"

#include <dlfcn.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>
#include <mutex>
#include <string>

#include "kernel_sources.h"

namespace omr
{
namespace
{
/** The program's file; the folders are the same in a build and where it is installed. Empty if unknown. */
std::string compilerFile()
{
  Dl_info info;
  if (dladdr(reinterpret_cast<const void*>(&fillKernelCache), &info) == 0 || info.dli_fname == nullptr)
  {
    return "";
  }
  const std::string library = info.dli_fname;
  const std::size_t slash = library.rfind('/');
  return slash == std::string::npos ? "" : library.substr(0, slash) + "/outdoor_omr/omr_compile";
}

/** Whether the device's driver keeps built kernels on the disk, for any process. */
bool keepsKernels(const Device& device)
{
  const char* cache = std::getenv("POCL_KERNEL_CACHE");
  return device.isCpu() && device.description.find("Portable Computing Language") == 0 &&
         (cache == nullptr || std::string(cache) != "0");
}

/** Where PoCL keeps them; empty if unknown. */
std::string cacheFolder()
{
  const auto variable = [](const char* name) {
    const char* value = std::getenv(name);
    return std::string(value == nullptr ? "" : value);
  };
  if (!variable("POCL_CACHE_DIR").empty())
  {
    return variable("POCL_CACHE_DIR");
  }
  if (!variable("XDG_CACHE_HOME").empty())
  {
    return variable("XDG_CACHE_HOME") + "/pocl/kcache";
  }
  return variable("HOME").empty() ? "" : variable("HOME") + "/.cache/pocl/kcache";
}

/** A file of that folder that says that these kernels were built for the device: it goes where they go. Empty if the
 * folder is unknown. */
std::string stampFile(const Device& device)
{
  std::string key =
      device.description + device.device.getInfo<CL_DEVICE_VERSION>() + device.device.getInfo<CL_DRIVER_VERSION>();
  for (std::size_t i = 0; i < KERNEL_SOURCE_COUNT; ++i)
  {
    key += KERNEL_SOURCES[i];
  }
  const std::string folder = cacheFolder();
  return folder.empty() ? "" : folder + "/outdoor_omr." + std::to_string(std::hash<std::string>()(key));
}

/** Runs a program to its end. @return whether it ended well */
bool run(std::string file, std::string argument)
{
  char* const arguments[] = {file.data(), argument.data(), nullptr};
  pid_t child = 0;
  if (posix_spawn(&child, file.c_str(), nullptr, nullptr, arguments, environ) != 0)
  {
    return false;
  }
  int status = 0;
  pid_t ended = 0;
  do
  {
    ended = waitpid(child, &status, 0);
  } while (ended < 0 && errno == EINTR);
  return ended == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}
}  // namespace

bool fillKernelCache(const Device& device)
{
  static std::mutex lock;
  static std::map<std::string, bool> filled;
  const std::lock_guard<std::mutex> guard(lock);
  const auto known = filled.find(device.description);
  if (known != filled.end())
  {
    return known->second;
  }
  bool& is_filled = filled[device.description];
  const std::string compiler = compilerFile();
  if (!keepsKernels(device) || access(compiler.c_str(), X_OK) != 0)
  {
    return false;
  }
  // To run the program takes .2 s, even if there is nothing to build.
  const std::string stamp = stampFile(device);
  is_filled = access(stamp.c_str(), F_OK) == 0;
  if (!is_filled && run(compiler, device.description))
  {
    is_filled = true;
    std::ofstream{stamp};  // if it cannot be written, the program is run again
  }
  return is_filled;
}

}  // namespace omr
