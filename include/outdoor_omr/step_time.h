#ifndef OUTDOOR_OMR_STEP_TIME_H
#define OUTDOOR_OMR_STEP_TIME_H

#include <string>

namespace omr
{
/** How long one step of the detector took. */
struct StepTime
{
  std::string step;
  double milliseconds = 0;
};

}  // namespace omr

#endif
