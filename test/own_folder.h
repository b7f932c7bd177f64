#ifndef OUTDOOR_OMR_TEST_OWN_FOLDER_H
#define OUTDOOR_OMR_TEST_OWN_FOLDER_H

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace omr
{
namespace test
{
/** A folder for the files of one process: those of another user, or of another checkout that is tested at the same
 * time, are elsewhere. It goes with the process. */
class OwnFolder
{
 public:
  OwnFolder() : path_(testing::TempDir() + "outdoor_omr_XXXXXX")
  {
    if (mkdtemp(&path_[0]) == nullptr)
    {
      throw std::runtime_error("cannot make a folder " + path_);
    }
  }

  OwnFolder(const OwnFolder&) = delete;
  OwnFolder& operator=(const OwnFolder&) = delete;

  ~OwnFolder()
  {
    std::error_code ignored;
    if (getpid() == owner_)  // no child of a death test
    {
      std::filesystem::remove_all(path_, ignored);
    }
  }

  std::string pathOf(const std::string& name) const
  {
    return path_ + "/" + name;
  }

 private:
  const pid_t owner_ = getpid();
  std::string path_;
};

/** The path of a file of the process' own folder. */
inline std::string ownPath(const std::string& name)
{
  static const OwnFolder folder;
  return folder.pathOf(name);
}

/** Writes a file; one that cannot be written fails the test. */
inline void writeTo(const std::string& path, const std::string& text)
{
  std::ofstream file(path);
  file << text;
  file.close();
  EXPECT_TRUE(file) << "cannot write " << path;
}

/** Writes a file of the process' own folder. @return its path. */
inline std::string writeFile(const std::string& name, const std::string& text)
{
  std::string path = ownPath(name);
  writeTo(path, text);
  return path;
}

}  // namespace test
}  // namespace omr

#endif
