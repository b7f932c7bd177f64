#include "caught.h"

#include <exception>

namespace omr
{
std::string caught(const std::function<void()>& action)
{
  try
  {
    action();
    return "";
  }
  catch (const std::exception& error)
  {
    const std::string text = error.what();
    return text.empty() ? "error without a text" : text;
  }
  catch (...)
  {
    return "unknown error";
  }
}

}  // namespace omr
