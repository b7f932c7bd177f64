#ifndef OUTDOOR_OMR_TEST_MESSAGES_OF_H
#define OUTDOOR_OMR_TEST_MESSAGES_OF_H

#include <stdexcept>
#include <string>

namespace omr
{
namespace test
{
/** What an exception says; empty: nothing was thrown. */
template <typename Exception = std::exception, typename Action>
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

}  // namespace test
}  // namespace omr

#endif
