#ifndef OUTDOOR_OMR_TEST_MESSAGES_OF_H
#define OUTDOOR_OMR_TEST_MESSAGES_OF_H

#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>
#include <string>

namespace omr
{
namespace test
{
/** What std::invalid_argument, or another exception, says; empty: nothing was thrown. */
template <typename Exception, typename Action>
std::string messageOf(const Action& action)
{
  try
  {
    action();
  }
  catch (const Exception& error)
  {
    return error.what();
  }
  return "";
}

/** Writes a file of the test's own folder. @return its path. */
inline std::string writeFile(const std::string& name, const std::string& text)
{
  std::string path = testing::TempDir() + "outdoor_omr_" + name;
  std::ofstream(path) << text;
  return path;
}

}  // namespace test
}  // namespace omr

#endif
